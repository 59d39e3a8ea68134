// What one run of a rung says, as numbers to compare and to send between processes.
#pragma once

#include <array>
#include <memory>
#include <string>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/rung.hpp"
#include "sandbox.hpp"

namespace boresight::gauntlet {

// The figures that rungs are compared by.
inline constexpr std::array<const char*, 8> kFigures = {"position max",      "position rms",     "boresight max",
                                                        "boresight rms",     "orientation max",  "orientation rms",
                                                        "line of sight max", "line of sight rms"};

struct Asked {
  std::string rung, integrator = {}, formulation = {};
  double step = 0.0;
  double start_offset = 0.0;
  double tolerance = 0.0;
  double rounding = 0.0;  // share by which gravity and the gaps are larger than drawn
  std::string label() const {
    return rung + (formulation.empty() ? "" : " " + formulation) + (integrator.empty() ? "" : " " + integrator);
  }
};

// One figure each of kFigures, what the run says of its error, and the first number that is not finite ("" if none).
struct Measured {
  std::array<double, kFigures.size()> figure{};
  std::array<double, kFigures.size()> model = {};  // what the rung states of its model, relative
  std::array<double, kFigures.size()>
      by_steps{};  // what further runs show that steps do, of each figure; zero until measured
  bool steps_measured = false, steps_refused = false;  // refused: the run says that they were not measured, and why
  double step = 0.0;                                   // mean [s]
  std::string taken;                                   // the integrator that took over, if one did
  double deepest = 0.0;                                // deepest penetration over the smallest play [-]
  std::string basis, start, not_finite;  // start: what the run says of how its journals start, if anything
  double cpu_seconds = 0.0;
};

// Asks a run to end that takes longer [s of CPU of this process]: throws then. One that does not hear it is a hang.
Json measure(const std::shared_ptr<const Mechanism>& mechanism, const Asked& asked, double most_seconds);
Measured measured(const Json& json);

// What the program would state of the steps' part of this run's error: "by_steps" per figure, or "why_not".
Json measure_steps(const std::shared_ptr<const Mechanism>& mechanism, const Asked& asked, double most_seconds);

// Total momentum of a mechanism that nothing holds, over its motion: the largest change over the sum of the bodies' parts.
Json momentum_change(const std::shared_ptr<const Mechanism>& mechanism, const Asked& asked);

// Energy of the mechanism without play, by both formulations: the largest change over the largest kinetic energy and the
// change that damping does not explain. Only for mechanisms that nothing drives and no load acts on.
Json energy_change(const std::shared_ptr<const Mechanism>& mechanism, int steps);

}  // namespace boresight::gauntlet
