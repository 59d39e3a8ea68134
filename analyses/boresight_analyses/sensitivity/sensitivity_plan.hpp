// What a sensitivity study is to do, as the [sensitivity] table of a study file says it:
//
//   [sensitivity]
//   samples = 4096               # rows; a row costs as many runs as there are groups, and two
//   seed = 1
//   design = "sobol"             # scrambled nets, intervals over replicates; or "random", intervals by bootstrap
//   replicates = 16              # sobol: nets; samples = replicates * a power of two
//   confidence = 0.95
//   groups = { contact = ["clearance.F1.contact.restitution", "clearance.F1.friction.coefficient"] }
//
// What scatters stands in [[random]], as for montecarlo. A parameter in no group is a group by itself; parameters that are
// correlated belong in one group, as the variance they make cannot be told apart.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/random/sampling_design.hpp"
#include "boresight_analyses/sensitivity/sobol_rows.hpp"
#include "boresight_analyses/study/study.hpp"

namespace boresight {

struct SensitivityPlan {
  std::uint64_t rows = 0;
  SamplingOptions design;  // of 2 d coordinates: the points a and b of a row
  double confidence = 0.95;
  RandomInputs inputs;
  ParameterGroups groups;          // indices into inputs.parameters
  std::vector<std::string> names;  // of the groups

  std::uint64_t runs_per_row() const { return groups.size() + 2; }
  std::uint64_t runs() const { return rows * runs_per_row(); }
  // The values (SI) of run `number`: row number / runs_per_row(), in the order a, b, groups. From any thread.
  void values(std::uint64_t number, std::span<double> values) const;
  // What decides the value of a run but for mechanism and rung: equal texts are equal runs.
  std::string text(const Study& study) const;

  std::shared_ptr<const SamplingDesign> points;
};

// Throws InputError. `accepts`: see read_random_inputs.
SensitivityPlan read_sensitivity_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism,
                                      const std::function<void(const Setting&)>& accepts);

}  // namespace boresight
