// What a sensitivity study is to do, as the [sensitivity] table of a study file says it:
//
//   [sensitivity]
//   samples = 4096               # rows; a row costs as many runs as there are groups, and two
//   method = "sobol"             # or "morris" (levels, negligible): g + 1 runs a row; "shapley" (orders): 2^g or g + 1
//   seed = 1
//   design = "sobol"             # scrambled nets, intervals over replicates; or "random", intervals by bootstrap
//   replicates = 16              # sobol: nets; samples = replicates * a power of two
//   confidence = 0.95
//   groups = { contact = ["clearance.F1.contact.restitution", "clearance.F1.friction.coefficient"] }
//
// What scatters stands in [[random]], as for montecarlo. A parameter in no group is a group by itself; parameters that are
// correlated belong in one group, as the variance they make cannot be told apart but by Shapley effects.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/random/sampling_design.hpp"
#include "boresight_analyses/sensitivity/morris_effects.hpp"
#include "boresight_analyses/sensitivity/shapley_effects.hpp"
#include "boresight_analyses/sensitivity/sobol_rows.hpp"
#include "boresight_analyses/study/study.hpp"

namespace boresight {

enum class SensitivityMethod { sobol, morris, shapley };
const char* to_string(SensitivityMethod method);

// More groups than this are better screened first: Sobol' indices of them cost many runs, most of them on what does nothing.
inline constexpr std::size_t kManyGroups = 10;

struct SensitivityPlan {
  SensitivityMethod method = SensitivityMethod::sobol;
  std::uint64_t rows = 0;
  SamplingOptions design;    // of 2 d coordinates, the points a and b of a row; morris: of d, where it begins
  double negligible = 0.05;  // morris: share of the largest mu_star
  double confidence = 0.95;
  RandomInputs inputs;
  ParameterGroups groups;          // indices into inputs.parameters
  std::vector<std::string> names;  // of the groups

  std::uint64_t runs_per_row() const;
  std::uint64_t runs() const { return rows * runs_per_row(); }
  // The values (SI) of run `number`: row number / runs_per_row(); sobol in the order a, b, groups, morris along the trajectory,
  // shapley as ShapleyRows counts. From any thread.
  void values(std::uint64_t number, std::span<double> values) const;
  // What decides the value of a run but for mechanism and rung: equal texts are equal runs.
  std::string text(const Study& study) const;

  std::shared_ptr<const SamplingDesign> points;
  std::shared_ptr<const MorrisTrajectories> trajectories;  // of morris
  std::shared_ptr<const ShapleyRows> shapley;              // of shapley

 private:
  std::vector<double> sobol_coordinates(std::uint64_t row, std::uint64_t slot) const;
};

// Throws InputError. `accepts`: see read_random_inputs.
SensitivityPlan read_sensitivity_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism,
                                      const std::function<void(const Setting&)>& accepts);

}  // namespace boresight
