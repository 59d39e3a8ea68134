#include "boresight_analyses/budget/jitter.hpp"

#include <algorithm>
#include <cmath>

#include "boresight_analyses/budget/ensemble.hpp"

namespace boresight {
namespace {

constexpr std::size_t kPoints = 15;  // of a curve, about

// Whole numbers of samples, about evenly in the logarithm.
std::vector<double> exposures(const BudgetPlan& plan) {
  const double least = 2.0, most = std::floor(plan.windows.observation_in(plan.duration) / plan.sampling);
  std::vector<double> out;
  for (std::size_t k = 0; k < kPoints; ++k) {
    const double samples = std::round(least * std::pow(most / least, static_cast<double>(k) / (kPoints - 1)));
    if (out.empty() || samples * plan.sampling > 1.01 * out.back()) out.push_back(samples * plan.sampling);
  }
  return out;
}

}  // namespace

std::vector<JitterCurve> jitter_curves(const BudgetPlan& plan, const std::vector<PointingHistory>& totals,
                                       std::size_t axes) {
  std::vector<JitterCurve> curves;
  for (const BudgetRequirement& r : plan.requirements) {
    const bool known = std::any_of(curves.begin(), curves.end(), [&](const JitterCurve& c) {
      return c.asked.axis == r.axis && c.asked.interpretation == r.interpretation &&
             c.asked.probability == r.probability;
    });
    if (r.exposure == 0.0 || known) continue;
    JitterCurve curve{.asked = r, .exposure = {}, .level = {}};
    for (const double exposure : exposures(plan)) {
      BudgetRequirement at = r;
      at.exposure = exposure;
      const Windows windows = plan.windows_of(at);
      if (!windows.missing_for(ErrorIndex::rpe, plan.duration).empty()) continue;
      std::vector<std::vector<double>> sizes;
      for (std::size_t member = 0; member < std::min(kMembersOfCurve, totals.size()); ++member)
        sizes.push_back(sizes_of(index_values(ErrorIndex::rpe, totals[member], windows), {r.axis, axes}));
      curve.exposure.push_back(exposure);
      curve.level.push_back(
          EnsembleInTime(std::move(sizes)).level(r.interpretation, r.probability, plan.confidence, plan.leave_out));
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace boresight
