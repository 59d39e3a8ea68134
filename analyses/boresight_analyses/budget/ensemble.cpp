#include "boresight_analyses/budget/ensemble.hpp"

#include <algorithm>

namespace boresight {

std::vector<double> sizes_of(const std::vector<Vec3>& values, const AxisOf& axis) {
  std::vector<double> sizes;
  sizes.reserve(values.size());
  for (const Vec3& v : values) sizes.push_back(axis.size(v));
  return sizes;
}

BudgetEnsemble::BudgetEnsemble(const BudgetPlan& plan, const BudgetRuns& runs, const SampleStore& store)
    : plan_(plan), runs_(runs), draws_(draws_of(plan.contributors, plan.correlations)) {
  const auto keep = [&](std::uint64_t number) {
    PointingHistory history = stored_history(store, number, plan);
    if (!history.error.empty()) histories_.emplace(number, std::move(history));
  };
  for (std::uint64_t member = 0; member < runs.rows(); ++member) keep(runs.drawn(member));
  store.read(runs.drawn(runs.rows()), [&](const SampleRecord& r) {
    if (histories_.contains(r.number)) model_errors_[r.number] = r.outcome.model_error;
  });
  for (std::uint64_t member = 0; member < runs.attribution(); ++member) {
    for (std::size_t g = 0; g < runs.groups(); ++g) keep(runs.held(member, g));
    for (std::size_t j = 0; j < runs.joints(); ++j) keep(runs.halved(member, j));
  }
}

const PointingHistory* BudgetEnsemble::mechanism(std::uint64_t member, const MemberVariant& variant) const {
  const std::uint64_t row = runs_.rows() == 1 ? 0 : member;
  std::uint64_t number = runs_.drawn(row);
  if (variant.held >= 0) number = runs_.held(row, static_cast<std::size_t>(variant.held));
  if (variant.halved >= 0) number = runs_.halved(row, static_cast<std::size_t>(variant.halved));
  const auto at = histories_.find(number);
  return at == histories_.end() ? nullptr : &at->second;
}

double BudgetEnsemble::model_error(std::uint64_t member) const {
  const auto at = model_errors_.find(runs_.drawn(runs_.rows() == 1 ? 0 : member));
  return at == model_errors_.end() || !std::isfinite(at->second) ? 0.0 : at->second;
}

PointingHistory BudgetEnsemble::external(std::uint64_t member, std::size_t contributor) const {
  const std::size_t samples = histories_.empty() ? 0 : histories_.begin()->second.error.size();
  return {plan_.sampling, course(plan_.contributors[contributor], plan_.seed, member, draws_[contributor],
                                 plan_.sampling, samples, plan_.windows)};
}

PointingHistory BudgetEnsemble::total(std::uint64_t member, const MemberVariant& variant) const {
  const PointingHistory* own = mechanism(member, variant);
  if (own == nullptr) return {plan_.sampling, {}};
  PointingHistory sum = *own;
  for (std::size_t i = 0; i < plan_.contributors.size(); ++i) {
    const PointingHistory added = external(member, i);
    for (std::size_t k = 0; k < std::min(sum.error.size(), added.error.size()); ++k) sum.error[k] += added.error[k];
  }
  return sum;
}

double missed_of(const BudgetEnsemble& ensemble, std::uint64_t member, double error, ErrorIndex index,
                 const Windows& windows, const AxisOf& axis) {
  if (!(error > 0.0)) return 0.0;
  const std::vector<double> own = sizes_of(index_values(index, *ensemble.mechanism(member), windows), axis);
  return own.empty() ? 0.0 : error * *std::max_element(own.begin(), own.end());
}

}  // namespace boresight
