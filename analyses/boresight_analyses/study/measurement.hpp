// What one way of computing a motion gives and costs: measured, not foreseen. The pilot that chooses a rung
// and the chart that shows them all measure alike.
//
// A motion with impacts scatters: each neighbouring step is as good as the first, and its index is another
// draw. So a way is run at neighbouring steps (or tolerances) and counts by its median and half the spread;
// of CPU times the least counts, for whatever else the machine does only adds.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/study/index_choice.hpp"

namespace boresight {

// One way of computing a motion: a rung, how its equations are written and integrated, and how finely.
struct RungSetup {
  std::string rung;
  std::string formulation = {}, stabilisation = {};  // multibody's; "" is the rung's own
  std::string integrator = {};                       // "" is the rung's own
  double step = 0.0;                                 // [s]; 0: the rung's own, or under error control
  double tolerance = 0.0;                            // of error control; 0: none, or the integrator's own
  bool lanes = false;  // perturbation, many samples a SIMD register (lane_sample_model.hpp)

  // The rungs that take no steps: everything else of a way means nothing to them.
  bool stepless() const { return rung == "envelope" || rung == "quasistatic"; }
  // The same, finer: half the step, or a tenth of the tolerance.
  RungSetup finer() const;
  // Without histories and events.
  RunOptions options() const;
  // "multibody, paper, baumgarte, rk4": all but how finely.
  std::string family() const;
};

// Of an index, rounding of a motion integrated in metres [m or rad].
inline constexpr double kNothing = 1e-9;
// The same of any index: a line of sight errs by a displacement over its target's distance, however far that is.
double nothing_of(const IndexChoice& index, const Mechanism& mechanism);
// How far the target is as the mechanism is drawn [m]; 0: none is sighted.
double distance_of_target(const Mechanism& mechanism);

struct Measurement {
  std::vector<double> values;  // of the index, in the order of the neighbours
  double value = 0.0;          // of the index: the median of the neighbours
  double half_spread = 0.0;    // of the neighbours
  double estimate = 0.0;       // what the rung itself thinks it is off by what it leaves out, relative, the largest
  double step = 0.0;           // of fixed steps, or the mean under error control [s]; 0 where there are none
  double cpu_seconds = 0.0;    // of one run, the least
  double spent_seconds = 0.0;  // of all runs
  std::string integrator;      // that took over from rk4 where none was asked for; "" if none did
  std::string refusal;         // why it could not be run; "" if it was
};

// How far a measured index is from a reference: |value - reference| + half the spread, relative. Indices that
// are zero on both (angles where axes stay parallel) agree.
double relative_error(const Measurement& measured, double reference, double nothing = kNothing);

struct MeasureOptions {
  IndexChoice index = {};
  int neighbours = 3;
  double most_seconds = 0.0;           // of CPU for one run, beyond which it is refused; 0: any
  std::function<bool()> advance = {};  // called before every run; return false to stop (throws MeasurementInterrupted)
};

struct MeasurementInterrupted {};

// rung: of the way's name, kept between calls for what it has precomputed. A way that fails (a singular pose,
// an unstable step, an option the rung does not have) is no error here: the refusal says why.
Measurement measure(const Rung& rung, const Parameters& parameters, const RungSetup& setup,
                    const MeasureOptions& options);

}  // namespace boresight
