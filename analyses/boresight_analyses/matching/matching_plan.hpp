// What a matching study is to find, as the [match] table of a study file says it:
//
//   [match]
//   minimise = "index"                 # or free_flight_share, impacts_per_second, peak_acceleration
//   over = "nominal"                   # or mean, quantile, worst: over the study's [[random]] parameters
//   probability = 0.95                 # of the quantile
//   samples = 32                       # per design, where parameters scatter
//   seed = 1
//   evaluations = 60                   # the most of the search of the whole box, and of each descent
//   tolerance = 0.01                   # of the variables, as a share of their ranges
//   global = "auto"                    # none, direct-l, crs2, mlsl, isres
//   local = "auto"                     # none, cobyla, bobyqa, slsqp, mma
//   map = 9                            # points per side of the objective's map; 0: none
//   front = 5                          # points sought on the front of accuracy against stability; 0: none
//   confirm = 64                       # samples with which the winner is confirmed
//   [[match.variable]]                 # see optimise/design_variable.hpp
//   [[match.constraint]]
//   measure = "free_flight_share"
//   at_most = 0.05                     # with its unit, where it has one; `over` and `probability` as above
#pragma once

#include <cstdint>
#include <optional>

#include "boresight_analyses/optimise/design_variable.hpp"
#include "boresight_analyses/optimise/measure.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/study/study.hpp"

namespace boresight {

struct MatchingConstraint {
  MeasureChoice measure;
  double at_most = 0.0;   // SI
  std::string unit = {};  // in which at_most is written: "arcsec"; "" for a pure number
};

struct MatchingPlan {
  std::vector<DesignVariable> variables;
  MeasureChoice objective;
  std::vector<MatchingConstraint> constraints;
  std::optional<RandomInputs> inputs;  // none where all is nominal
  std::size_t samples = 1, confirm = 1;
  std::uint64_t seed = 1;
  int evaluations = 60;
  double tolerance = 0.01;
  std::string global = "auto", local = "auto";
  int map = 9, front = 5;

  bool wants_gradients() const { return local == "slsqp" || local == "mma"; }

  // The designs that descents begin from: the k-th start of every variable, the middle where it has none.
  std::vector<std::vector<double>> starts() const;
  Parameters parameters_with(const Mechanism& mechanism, std::span<const double> design_then_random) const;
  // What decides the outcomes of a design, but for mechanism and rung.
  std::string sample_text(const Study& study) const;
};

// Throws InputError. `accepts`: see read_random_inputs; accepts_all: see check_corners().
MatchingPlan read_matching_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism,
                                const AcceptsSetting& accepts, const AcceptsSettings& accepts_all = {});

// Of the objective or a constraint: what lanes do not say.
bool asks_peak_acceleration(const MatchingPlan& plan);

}  // namespace boresight
