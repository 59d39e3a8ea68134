#include "boresight_analyses/matching/design_slopes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/ideal_simulation.hpp"
#include "boresight/rungs/perturbation_system.hpp"
#include "boresight/rungs/predictability.hpp"
#include "boresight_analyses/sensitivity/index_slopes.hpp"

namespace boresight {

std::string why_no_slopes(const MatchingPlan& plan) {
  if (plan.objective.measure != Measure::index) return "only the index has slopes, contact measures jump from impact to impact";
  if (plan.objective.over != Over::nominal) return "slopes are those of one motion, not of many that scatter";
  if (!plan.constraints.empty()) return "contact measures, which limits are put to, have no slopes";
  for (const DesignVariable& v : plan.variables)
    for (const std::string& path : v.paths)
      if (path.rfind("clearance.", 0) != 0) return "slopes are those by numbers of a clearance's contacts, and " + path + " is none";
  for (const DesignVariable& v : plan.variables)
    if (!(v.from > 0.0)) return "slopes are those by numbers above zero, and " + v.name() + " may be zero";
  return "";
}

DesignSlopes::DesignSlopes(std::shared_ptr<const Mechanism> mechanism, const MatchingPlan& plan, IndexChoice index,
                           const RunOptions& run)
    : mechanism_(std::move(mechanism)), plan_(plan), index_(std::move(index)), start_offset_(run.start_offset) {}

std::optional<std::vector<double>> DesignSlopes::at(const std::vector<double>& design, std::string& why) const {
  try {
    const Parameters parameters = plan_.parameters_with(*mechanism_, design);
    const Predictability horizon = measure_predictability(mechanism_, parameters);
    if (!horizon.measured || horizon.parted) {
      char text[160];
      std::snprintf(text, sizeof text, "impacts part neighbouring motions after %.2g s of %.2g s, beyond which slopes say nothing",
                    horizon.horizon, mechanism_->duration());
      why = horizon.measured ? text : horizon.refusal;
      return std::nullopt;
    }
    const PreparedScene prepared(*mechanism_, ideal_motion(*mechanism_, parameters), parameters);
    const PerturbationSystem system(*mechanism_, parameters, prepared.tables(parameters), false);
    if (system.has_bristles()) {
      why = "bristles of LuGre friction carry no derivatives";
      return std::nullopt;
    }
    SlopeOptions options;
    options.tolerance = 1e-6;  // and the derivatives held to it, as in exact_slopes.cpp
    options.control_derivatives = true;
    options.start_state = VecX::Zero(2 * system.layout().n);
    options.start_state.head(system.layout().n).setConstant(start_offset_);
    const auto parameters_at = [&](const std::vector<double>& v) { return plan_.parameters_with(*mechanism_, v); };
    std::vector<double> by = index_slopes(*mechanism_, prepared, parameters_at, design, index_, options).by;
    if (std::all_of(by.begin(), by.end(), [](double slope) { return std::isfinite(slope); })) return by;
    why = "the derivatives of the motion overflow";
  } catch (const ComputationError& failure) {
    why = failure.what();
  }
  return std::nullopt;
}

}  // namespace boresight
