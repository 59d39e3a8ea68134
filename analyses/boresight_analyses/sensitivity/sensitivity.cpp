#include "boresight_analyses/sensitivity/sensitivity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "boresight_analyses/runs/stored_runs.hpp"
#include "boresight_analyses/statistics/running.hpp"

namespace boresight {
namespace {

struct StoredRows {
  std::vector<std::vector<double>> results;  // of the runs of each row, in their order; NaN where one failed
  std::uint64_t failed_runs = 0;
};

StoredRows rows_of(const SensitivityPlan& plan, const SampleStore& store) {
  constexpr double kFailed = std::numeric_limits<double>::quiet_NaN();
  const std::uint64_t width = plan.runs_per_row();
  StoredRows stored{.results = std::vector<std::vector<double>>(plan.rows, std::vector<double>(width, kFailed))};
  store.read(plan.runs(), [&](const SampleRecord& record) {
    const bool done = record.outcome.status == Outcome::Status::done;
    stored.failed_runs += !done;
    if (done) stored.results[record.number / width][record.number % width] = record.outcome.value;
  });
  return stored;
}

// What `effects` makes of the rows (each as `row_of` has it, from its number and results), independent or in replicates, as
// `reported_as` tells it; none where it throws for too few of them.
template <typename Result, typename RowOf, typename Effects, typename ReportedAs>
std::optional<Result> answered(const SensitivityPlan& plan, const SampleStore& store, const RowOf& row_of,
                               const Effects& effects, const ReportedAs& reported_as) {
  using Row = decltype(row_of(std::uint64_t{}, std::vector<double>{}));
  const StoredRows stored = rows_of(plan, store);
  std::vector<Row> rows;
  for (std::uint64_t k = 0; k < plan.rows; ++k) rows.push_back(row_of(k, stored.results[k]));
  const auto told = [&](const auto& found) {
    Result result = reported_as(found);
    result.rows = found.rows;
    result.failed_rows = found.failed_rows;
    result.failed_runs = stored.failed_runs;
    return result;
  };
  try {
    if (plan.design.kind == SamplingKind::random)
      return told(effects(rows, BootstrapOptions{.confidence = plan.confidence, .seed = plan.design.seed}));
    std::vector<std::vector<Row>> replicates(plan.design.replicates);
    for (std::uint64_t k = 0; k < plan.rows; ++k)
      replicates[plan.points->replicate_of(k)].push_back(std::move(rows[k]));
    return told(effects(replicates, plan.confidence));
  } catch (const std::invalid_argument&) {  // too few whole rows
    return std::nullopt;
  }
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
  return answered<GlobalSensitivity>(
      plan, store,
      [](std::uint64_t, const std::vector<double>& y) {
        return SobolRow{y[0], y[1], {y.begin() + 2, y.end()}};
      },
      [](const auto& rows, const auto& options) { return sobol_indices(rows, options); },
      [&](const auto& found) {
        GlobalSensitivity result;
        for (std::size_t g = 0; g < plan.groups.size(); ++g)
          result.groups.push_back({plan.names[g], reported(found.groups[g].first), reported(found.groups[g].total),
                                   found.groups[g].undersampled()});
        result.interactions = reported(found.interactions);
        result.mean = found.mean;
        result.sd = std::sqrt(std::max(0.0, found.variance));
        return result;
      });
}

std::optional<Screening> screening(const SensitivityPlan& plan, const SampleStore& store) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::optional<Screening> result = answered<Screening>(
      plan, store,
      [&](std::uint64_t row, const std::vector<double>& y) {
        Point start(plan.inputs.size());
        plan.points->point(row, start);
        for (const double value : y)
          if (std::isfinite(value)) least = std::min(least, value), most = std::max(most, value);
        return plan.trajectories->effects(row, start, y);
      },
      [](const auto& rows, const auto& options) { return morris_effects(rows, options); },
      [&](const auto& found) {
        Screening screened;
        for (std::size_t g = 0; g < plan.groups.size(); ++g) {
          screened.groups.push_back(
              {.name = plan.names[g], .mu_star = reported(found.groups[g].mu_star), .mu = {}, .sigma = {}});
          if (plan.groups[g].size() > 1) continue;
          screened.groups.back().mu = reported(found.groups[g].mu);
          screened.groups.back().sigma = reported(found.groups[g].sigma);
        }
        return screened;
      });
  if (!result) return result;
  result->varies = least < most;
  for (ScreenedGroup& group : result->groups)
    group.negligible = group.mu_star.high <= plan.negligible * result->largest();
  return result;
}

double Screening::largest() const {
  double most = 0.0;
  for (const ScreenedGroup& group : groups) most = std::max(most, group.mu_star.value);
  return most;
}

std::size_t Screening::negligible() const {
  return static_cast<std::size_t>(
      std::count_if(groups.begin(), groups.end(), [](const ScreenedGroup& group) { return group.negligible; }));
}

std::optional<ShapleyDivision> shapley_division(const SensitivityPlan& plan, const SampleStore& store) {
  return answered<ShapleyDivision>(
      plan, store,
      [&](std::uint64_t row, const std::vector<double>& y) {
        return ShapleyRow{plan.shapley->shares(row, y), y.front(), y.back()};
      },
      [](const auto& rows, const auto& options) { return shapley_effects(rows, options); },
      [&](const auto& found) {
        ShapleyDivision result;
        for (std::size_t g = 0; g < plan.groups.size(); ++g) {
          const ReportedInterval effect = reported(found.groups[g]);
          result.groups.push_back({plan.names[g], effect, effect.high - effect.low > ShapleyDivision::kWideEffect});
        }
        result.mean = found.mean;
        result.sd = std::sqrt(std::max(0.0, found.variance));
        return result;
      });
}

double ShapleyDivision::rows_that_settle() const {
  double widest = 0.0;
  for (const ShapleyGroup& group : groups) widest = std::max(widest, group.effect.high - group.effect.low);
  return double(rows) * std::pow(widest / kWideEffect, 2);
}

}  // namespace boresight
