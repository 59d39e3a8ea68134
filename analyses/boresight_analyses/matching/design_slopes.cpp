#include "boresight_analyses/matching/design_slopes.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/contact_path.hpp"
#include "boresight_analyses/sensitivity/predictable_slopes.hpp"

namespace boresight {

std::string why_no_slopes(const MatchingPlan& plan) {
  if (plan.objective.measure != Measure::index)
    return "only the index has slopes, contact measures jump from impact to impact";
  if (plan.objective.over != Over::nominal) return "slopes are those of one motion, not of many that scatter";
  if (!plan.constraints.empty()) return "contact measures, which limits are put to, have no slopes";
  for (const DesignVariable& v : plan.variables)
    for (const std::string& path : v.paths)
      if (!is_contact_path(path))
        return "slopes are those by numbers of a clearance's contacts, and " + path + " is none";
  for (const DesignVariable& v : plan.variables)
    if (!(v.from > 0.0)) return "slopes are those by numbers above zero, and " + v.name() + " may be zero";
  return "";
}

DesignSlopes::DesignSlopes(std::shared_ptr<const Mechanism> mechanism, const MatchingPlan& plan, IndexChoice index,
                           const RunOptions& run)
    : mechanism_(std::move(mechanism)), plan_(plan), index_(std::move(index)), start_offset_(run.start_offset) {}

std::optional<std::vector<double>> DesignSlopes::at(const std::vector<double>& design, std::string& why) const {
  try {
    const auto parameters_at = [&](const std::vector<double>& v) { return plan_.parameters_with(*mechanism_, v); };
    const std::vector<double> by = predictable_slopes(mechanism_, parameters_at, design, index_, start_offset_).by;
    if (std::all_of(by.begin(), by.end(), [](double slope) { return std::isfinite(slope); })) return by;
    why = "the derivatives of the motion overflow";
  } catch (const ComputationError& failure) {
    why = failure.what();
  }
  return std::nullopt;
}

}  // namespace boresight
