// Sensitivity of the index: Sobol' indices of the groups over the whole scatter, and around its middle one parameter at a
// time: derivatives and swings (the tornado).
#pragma once

#include <functional>
#include <optional>

#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/runs/sampling.hpp"
#include "boresight_analyses/sensitivity/sensitivity_plan.hpp"
#include "boresight_analyses/sensitivity/sobol_indices.hpp"

namespace boresight {

struct GroupSensitivity {
  std::string name;
  ReportedInterval first, total;
  bool undersampled = false;
};

struct GlobalSensitivity {
  std::vector<GroupSensitivity> groups;  // in the order of the plan
  ReportedInterval interactions;
  double mean = 0.0, sd = 0.0;  // of the index [SI]
  std::int64_t rows = 0, failed_rows = 0;
  std::uint64_t failed_runs = 0;
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

// From a store that holds all runs. None if too few rows are without a failed run.
std::optional<GlobalSensitivity> global_sensitivity(const SensitivityPlan& plan, const SampleStore& store);

}  // namespace boresight
