#include "boresight_analyses/sensitivity/sensitivity.hpp"

#include <cmath>
#include <limits>

#include "boresight_analyses/runs/stored_runs.hpp"
#include "boresight_analyses/statistics/running.hpp"

namespace boresight {
namespace {

template <typename Sampling>
GlobalSensitivity reported_sensitivity(const SobolIndices<Sampling>& indices, const SensitivityPlan& plan) {
  GlobalSensitivity result;
  for (std::size_t g = 0; g < plan.groups.size(); ++g) {
    const auto& group = indices.groups[g];
    result.groups.push_back({plan.names[g], reported(group.first), reported(group.total), group.undersampled()});
  }
  result.interactions = reported(indices.interactions);
  result.mean = indices.mean;
  result.sd = std::sqrt(std::max(0.0, indices.variance));
  result.rows = indices.rows;
  result.failed_rows = indices.failed_rows;
  return result;
}

}  // namespace

bool compute_sensitivity_runs(const SampleModel& model, const SensitivityPlan& plan, SampleStore& store,
                              const SensitivityOptions& options) {
  const std::vector<NumberRange> missing = store.missing(plan.runs());
  SensitivityProgress progress{.total = plan.runs()};
  for (const NumberRange& range : missing) progress.begun_with += range.size();
  progress.begun_with = progress.done = plan.runs() - progress.begun_with;
  RunningMoments moments;
  const auto landed = [&](std::span<const SampleRecord> records) {
    for (const SampleRecord& record : records) {
      ++progress.done;
      if (record.outcome.status == Outcome::Status::done)
        moments.add(record.outcome.value);
      else
        ++progress.failed;
    }
    progress.mean_so_far = moments.mean();
    if (options.progress) options.progress(progress);
  };
  return store_runs(model, plan.inputs.size(),
                    [&](std::uint64_t number, std::span<double> values) { plan.values(number, values); }, missing,
                    store, {.jobs = options.jobs, .landed = landed, .interrupted = options.interrupted});
}

std::optional<GlobalSensitivity> global_sensitivity(const SensitivityPlan& plan, const SampleStore& store) {
  constexpr double kFailed = std::numeric_limits<double>::quiet_NaN();
  const std::uint64_t width = plan.runs_per_row();
  std::vector<SobolRow> rows(plan.rows, {kFailed, kFailed, std::vector<double>(plan.groups.size(), kFailed)});
  std::uint64_t failed = 0;
  store.read(plan.runs(), [&](const SampleRecord& record) {
    SobolRow& row = rows[record.number / width];
    const std::uint64_t slot = record.number % width;
    const bool done = record.outcome.status == Outcome::Status::done;
    failed += !done;
    (slot == 0 ? row.a : slot == 1 ? row.b : row.exchanged[slot - 2]) = done ? record.outcome.value : kFailed;
  });
  std::optional<GlobalSensitivity> result;
  try {
    if (plan.design.kind == SamplingKind::random) {
      result =
          reported_sensitivity(sobol_indices(rows, {.confidence = plan.confidence, .seed = plan.design.seed}), plan);
    } else {
      std::vector<std::vector<SobolRow>> replicates(plan.design.replicates);
      for (std::uint64_t k = 0; k < plan.rows; ++k)
        replicates[plan.points->replicate_of(k)].push_back(std::move(rows[k]));
      result = reported_sensitivity(sobol_indices(replicates, plan.confidence), plan);
    }
    result->failed_runs = failed;
  } catch (const std::invalid_argument&) {  // too few whole rows
  }
  return result;
}

}  // namespace boresight
