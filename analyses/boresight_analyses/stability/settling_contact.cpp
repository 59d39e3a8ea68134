#include "boresight_analyses/stability/settling_contact.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/integrate/explicit_method.hpp"
#include "boresight/integrate/rosenbrock_method.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace {

template <typename Method>
Settling follow(Method method, SettlingContact& contact, double height, double duration, double tolerance) {
  VecX y(2);
  y << height, 0.0;
  const double omega = contact.angular_frequency(), depth = contact.rest_depth();
  IntegrationOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerances = Eigen::Vector2d(tolerance * depth, tolerance * depth * omega);
  options.event_floor = 2.0 * contact.minimum_impact_speed * contact.mass / contact.load;
  Integrator<Method> integrator(std::move(method), 1);
  Settling result;
  result.method = integrator.method().name();
  double settled_time = 0.0;
  long settled_steps = 0;
  const IntegrationSummary summary = integrator.run(contact, 0.0, duration, y, options, [&](const auto& step) {
    if (contact.settled_at < 0.0) return;
    const double h = step.end() - step.start();
    settled_time += h;
    ++settled_steps;
    result.largest_step_settled = std::max(result.largest_step_settled, h * omega);
  });
  result.completed = summary.completed();
  result.why_not = summary.message;
  result.steps = summary.steps;
  result.rejected = summary.rejected();
  result.evaluations = summary.cost.evaluations;
  result.contacts = summary.closings;
  result.settled_at = contact.settled_at;
  result.smallest_step = summary.smallest_step;
  if (settled_steps > 0) result.mean_step_settled = settled_time / static_cast<double>(settled_steps) * omega;
  result.end_depth = -y[0];
  return result;
}

}  // namespace

SettlingContact SettlingContact::of(const Mechanism& mechanism, const Parameters& parameters, int clearance,
                                    const ContactFrequency& found) {
  const MechanismDescription& m = mechanism.description();
  const JointPlay joint(m.clearances[clearance], m.joints[m.clearances[clearance].joint].type,
                        parameters.clearance[clearance]);
  SettlingContact contact;
  contact.mass = found.effective_mass;
  contact.load = found.typical_load > 0.0 ? found.typical_load : 9.81 * found.effective_mass;
  contact.law = joint.normal_law();
  contact.minimum_impact_speed = contact.impact_speed = joint.minimum_impact_speed;
  return contact;
}

double SettlingContact::rest_depth() const { return law.depth_under(load); }

double SettlingContact::angular_frequency() const { return std::sqrt(law.elastic_slope(rest_depth()) / mass); }

void SettlingContact::derivative(double, const VecX& y, VecX& dy) const {
  dy[0] = y[1];
  dy[1] = ((touching ? law.force(-y[0], -y[1], impact_speed) : 0.0) - load) / mass;
}

AfterEvent SettlingContact::on_event(const GapEvent& event, VecX& y) {
  touching = event.crossing == Crossing::closing || event.crossing == Crossing::lasting;
  if (touching) impact_speed = std::max(minimum_impact_speed, -y[1]);
  if (touching && settled_at < 0.0) settled_at = event.t;
  if (!touching) settled_at = -1.0;
  return AfterEvent::crossed;
}

Settling stabilise(SettlingContact contact, double height, double duration, double tolerance, bool explicit_pair) {
  if (explicit_pair) return follow(ExplicitMethod(dormand_prince54(), 2), contact, height, duration, tolerance);
  return follow(RosenbrockMethod(rodas4(), 2), contact, height, duration, tolerance);
}

}  // namespace boresight
