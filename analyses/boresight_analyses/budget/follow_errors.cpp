#include "boresight_analyses/budget/follow_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/budget/budget_runs.hpp"
#include "boresight_analyses/study/error_parts.hpp"

namespace boresight {
namespace {

// Which errors have a value that no [[random]] table draws.
std::vector<bool> known_errors(const BudgetPlan& plan, const Mechanism& mechanism) {
  Parameters marked = mechanism.parameters();
  for (const RandomParameter& random : plan.inputs.parameters)
    for (const ParameterPath& place : random.places) place.set(marked, std::numeric_limits<double>::quiet_NaN());
  std::vector<bool> known;
  for (const double value : marked.error) known.push_back(std::isfinite(value) && value != 0.0);
  return known;
}

// Which errors the parameters draw that stand in a group of errors alone.
std::vector<std::set<std::size_t>> drawn_errors(const BudgetPlan& plan, const Mechanism& mechanism) {
  std::vector<std::set<std::size_t>> drawn(plan.inputs.parameters.size());
  for (std::size_t g = 0; g < plan.groups.members.size(); ++g) {
    if (!plan.is_of_errors(g)) continue;
    for (const int i : plan.groups.members[g]) {
      Parameters marked = mechanism.parameters();
      for (const ParameterPath& place : plan.inputs.parameters[static_cast<std::size_t>(i)].places)
        place.set(marked, std::numeric_limits<double>::quiet_NaN());
      for (std::size_t e = 0; e < marked.error.size(); ++e)
        if (std::isnan(marked.error[e])) drawn[static_cast<std::size_t>(i)].insert(e);
    }
  }
  return drawn;
}

std::size_t place_of(const MechanismDescription& mechanism, const std::string& name) {
  const auto at = std::find_if(mechanism.errors.begin(), mechanism.errors.end(),
                               [&](const ErrorDescription& error) { return error.name == name; });
  return static_cast<std::size_t>(at - mechanism.errors.begin());
}

// The columns on the grid of the histories, as the index counts them.
class ColumnsOnGrid {
 public:
  ColumnsOnGrid(const BudgetPlan& plan, const Mechanism& mechanism, PointingQuantity quantity,
                const std::set<std::size_t>& errors)
      : mechanism_(mechanism),
        quantity_(quantity),
        commanded_(ideal_motion(mechanism, mechanism.parameters())),
        columns_(mechanism, commanded_) {
    const std::size_t lead = lead_of(plan);
    for (std::size_t k = 0; k < lead + samples_of(plan); ++k) {
      time_.push_back(std::min(mechanism.duration(),
                               plan.start + (static_cast<double>(k) - static_cast<double>(lead)) * plan.sampling));
      const MatX gain = columns_.at(time_.back());
      for (const std::size_t error : errors) gain_[error].emplace_back(gain.col(static_cast<Eigen::Index>(error)));
    }
  }

  const std::vector<double>& time() const { return time_; }
  std::string refusal(std::size_t error) const { return columns_.refusal(error); }
  std::vector<Vec3> of(std::size_t error) const {
    std::vector<Vec3> history;
    for (std::size_t k = 0; k < time_.size(); ++k) {
      const BodyMotion body = commanded_.body(time_[k], mechanism_.boresight_body());
      history.push_back(linear_error_vector(quantity_, gain_.at(error)[k], {body.p, Quat(body.R)},
                                            mechanism_.pointing(), mechanism_.characteristic_length()));
    }
    return history;
  }

 private:
  const Mechanism& mechanism_;
  PointingQuantity quantity_;
  IdealMotion commanded_;
  ErrorColumns columns_;
  std::vector<double> time_;
  std::map<std::size_t, std::vector<Vec6>> gain_;  // per error
};

}  // namespace

std::vector<std::string> follow_errors(BudgetPlan& plan, const Mechanism& mechanism, PointingQuantity quantity) {
  std::vector<std::string> untold;
  const std::vector<bool> known = known_errors(plan, mechanism);
  std::set<std::size_t> errors;
  for (const Contributor& c : plan.contributors)
    if (c.of_error) errors.insert(place_of(mechanism.description(), c.of_error->error));
  const bool contributes = !errors.empty();
  for (std::size_t e = 0; e < known.size(); ++e)
    if (known[e]) errors.insert(e);
  const bool told = !errors.empty();
  const std::vector<std::set<std::size_t>> drawn = drawn_errors(plan, mechanism);
  for (const std::set<std::size_t>& of : drawn) errors.insert(of.begin(), of.end());
  plan.by_parameter.assign(drawn.size(), {});
  if (errors.empty()) return untold;
  std::optional<ColumnsOnGrid> columns;
  try {
    columns.emplace(plan, mechanism, quantity, errors);
  } catch (const ComputationError& refused) {
    if (contributes) throw;
    if (!told) return untold;
    return {"the parts of the known errors cannot be told: " + std::string(refused.what())};
  }
  for (Contributor& c : plan.contributors) {
    if (!c.of_error) continue;
    const std::size_t error = place_of(mechanism.description(), c.of_error->error);
    if (const std::string why = columns->refusal(error); !why.empty())
      throw ComputationError("the contributor \"" + c.name + "\" cannot be followed beside the members: " + why +
                             "; as [[random]] parameter its error is followed with them");
    std::vector<Vec3>&by_value = c.of_error->by_value, &by_course = c.of_error->by_course;
    by_value = columns->of(error);
    by_course.assign(by_value.size(), Vec3::Zero());
    for (std::size_t k = 0; c.of_error->course && k < by_course.size(); ++k)
      by_course[k] = c.of_error->course->at(columns->time()[k]).value * by_value[k];
    for (std::vector<Vec3>* part : {&by_value, &by_course}) pass_through(plan, *part);
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const bool followed = std::none_of(drawn[i].begin(), drawn[i].end(),
                                       [&](std::size_t error) { return !columns->refusal(error).empty(); });
    if (drawn[i].empty() || !followed) continue;
    std::vector<Vec3>& part = plan.by_parameter[i];
    for (const std::size_t error : drawn[i]) {
      const std::vector<Vec3> one = columns->of(error);
      part.resize(one.size(), Vec3::Zero());
      for (std::size_t k = 0; k < one.size(); ++k) part[k] += one[k];
    }
    pass_through(plan, part);
  }
  plan.known.clear();
  for (std::size_t e = 0; e < known.size(); ++e) {
    if (!known[e]) continue;
    if (std::string why = columns->refusal(e); !why.empty()) {
      untold.push_back("the part of a known error cannot be told: " + why);
      continue;
    }
    KnownError& part = plan.known.emplace_back();
    part.name = "error." + mechanism.description().errors[e].name;
    part.value = mechanism.parameters().error[e];
    part.history = {plan.sampling, columns->of(e)};
    for (Vec3& at : part.history.error) at *= part.value;
    pass_through(plan, part.history.error);
  }
  return untold;
}

}  // namespace boresight
