// Sensitivity of the index over the whole scatter, by the method of the plan: Sobol' indices, elementary effects or Shapley effects
// of the groups. (Around the middle, one parameter at a time: local_sensitivity.hpp.)
#pragma once

#include <functional>
#include <optional>

#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/runs/sampling.hpp"
#include "boresight_analyses/sensitivity/sensitivity_plan.hpp"
#include "boresight_analyses/sensitivity/sobol_indices.hpp"

namespace boresight {

// Of rows with a failed run nothing is taken.
struct RowCounts {
  std::int64_t rows = 0, failed_rows = 0;
  std::uint64_t failed_runs = 0;
};

struct GroupSensitivity {
  std::string name;
  ReportedInterval first, total;
  bool undersampled = false;
};

struct GlobalSensitivity : RowCounts {
  std::vector<GroupSensitivity> groups;  // in the order of the plan
  ReportedInterval interactions;
  double mean = 0.0, sd = 0.0;  // of the index [SI]
};

// Elementary effects, in the unit of the index per whole range of a parameter's probabilities.
struct ScreenedGroup {
  std::string name;
  ReportedInterval mu_star;
  std::optional<ReportedInterval> mu, sigma;  // none for groups of several parameters, which move each to its own side
  bool negligible = false;                    // by the plan's share of the largest mu_star
};
struct Screening : RowCounts {
  std::vector<ScreenedGroup> groups;  // in the order of the plan
  bool varies = false;                // the index is not the same in all runs, whether or not a move changes it
  double largest() const;             // mu_star
  std::size_t negligible() const;     // how many are
};

struct ShapleyGroup {
  std::string name;
  ReportedInterval effect;
  bool undersampled = false;  // an interval wider than kWideEffect
};
struct ShapleyDivision : RowCounts {
  static constexpr double kWideEffect = 0.2;
  std::vector<ShapleyGroup> groups;  // in the order of the plan
  double mean = 0.0, sd = 0.0;       // of the index [SI]
  // About how many rows make every interval kWideEffect wide: widths go with the square root of their number.
  double rows_that_settle() const;
};

struct SensitivityProgress {
  std::uint64_t done = 0, total = 0, begun_with = 0, failed = 0;
  double mean_so_far = 0.0;
};

struct SensitivityOptions {
  int jobs = 1;
  std::function<void(const SensitivityProgress&)> progress;
  std::function<bool()> interrupted;
};

// Computes the runs that the store lacks. Returns false if it was interrupted; the store then holds what there is.
bool compute_sensitivity_runs(const SampleModel& model, const SensitivityPlan& plan, SampleStore& store,
                              const SensitivityOptions& options);

// Of a plan with this method, from a store that holds all runs. None if too few rows are without a failed run.
std::optional<GlobalSensitivity> global_sensitivity(const SensitivityPlan& plan, const SampleStore& store);
std::optional<Screening> screening(const SensitivityPlan& plan, const SampleStore& store);
std::optional<ShapleyDivision> shapley_division(const SensitivityPlan& plan, const SampleStore& store);

}  // namespace boresight
