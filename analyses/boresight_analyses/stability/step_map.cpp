#include "boresight_analyses/stability/step_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

constexpr int kRows = 13;
constexpr double kStopped = std::numeric_limits<double>::infinity();
constexpr double kNotTried = std::numeric_limits<double>::quiet_NaN();

double stiffest(const Mechanism& mechanism, const Parameters& parameters) {
  double omega = 0.0;
  for (const ContactFrequency& c : analyse_contacts(mechanism, parameters))
    omega = std::max(omega, c.angular_frequency);
  return omega;
}

}  // namespace

StepMap map_steps(const std::shared_ptr<const Mechanism>& mechanism, const FollowedMotion& followed,
                  const IndexChoice& index, const std::function<bool()>& advance) {
  StepMap map;
  map.rung = followed.rung->name();
  map.index = index.title();
  const double own = stiffest(*mechanism, mechanism->parameters());
  // From a thirtieth of a radian of the middle column's vibration per step to well beyond the stable ones.
  for (int i = 0; i < kRows; ++i) map.step.push_back(0.05 / own * std::pow(240.0, i / (kRows - 1.0)));
  map.error.assign(kRows, {});
  for (int column = 0; column < kStepMapColumns; ++column) {
    if (!advance()) break;
    Parameters parameters = mechanism->parameters();
    const double scale = std::pow(64.0, 2.0 * column / (kStepMapColumns - 1.0) - 1.0);
    for (ClearanceParameters& c : parameters.clearance) c.contact.stiffness_scale *= scale;
    map.frequency.push_back(stiffest(*mechanism, parameters));
    std::vector<double> value(kRows, kNotTried);
    double refused = 0.0;
    for (int i = 0; i < kRows; ++i) {
      if (followed.until / map.step[i] > 2e5) continue;
      try {
        value[i] = index.of(followed.rung->run(parameters, followed.options(map.step[i])).index);
      } catch (const ComputationError& stop) {
        value[i] = kStopped;
        if (refused == 0.0) refused = map.step[i];
        if (map.first_stop.empty()) map.first_stop = stop.what();
      }
    }
    map.refused_above.push_back(refused);
    // The column's reference: the median of its three smallest steps.
    std::vector<double> finest;
    for (double v : value)
      if (std::isfinite(v) && finest.size() < 3) finest.push_back(v);
    std::sort(finest.begin(), finest.end());
    const double reference = finest.empty() ? kNotTried : finest[finest.size() / 2];
    map.scatter.push_back(finest.size() < 2 || reference == 0.0
                              ? kNotTried
                              : 0.5 * (finest.back() - finest.front()) / std::abs(reference));
    for (int i = 0; i < kRows; ++i)
      map.error[i].push_back(std::isfinite(value[i]) ? std::abs(value[i] / reference - 1.0) : value[i]);
  }
  return map;
}

}  // namespace boresight
