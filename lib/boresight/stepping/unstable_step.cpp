#include "boresight/stepping/unstable_step.hpp"

#include <cmath>
#include <cstdio>

#include "boresight/integrate/explicit_runge_kutta.hpp"

namespace boresight {
namespace {

std::string message(const Mechanism& mechanism, const StiffestContact& contact, double t, double h) {
  const std::string joint =
      mechanism.description().joints[mechanism.description().clearances[contact.clearance].joint].name;
  char where[120], what[240];  // names are as long as they are
  std::snprintf(where, sizeof where, "step too large: at t = %.6g s the %s contact of ", t, to_string(contact.place));
  std::snprintf(what, sizeof what,
                " vibrates at %.4g rad/s, and RK4 with h = %.4g s is unstable there; the largest stable step is %.3g s",
                contact.angular_frequency, h, classical_rk4().real_limit / contact.angular_frequency);
  return where + joint + what;
}

std::string message(const std::string& sign, double t, double h) {
  char text[320];
  std::snprintf(text, sizeof text,
                "step too large: with h = %.4g s the motion blows up before t = %.6g s (%s); take a smaller step", h, t,
                sign.c_str());
  return text;
}

std::string message_of_springs(double t, double of_springs, double h) {
  char text[320];
  std::snprintf(
      text, sizeof text,
      "step too large: with h = %.4g s the motion blows up before t = %.6g s; springs and dampers alone leave "
      "RK4 stable up to a step of %.3g s",
      h, t, of_springs);
  return text;
}

}  // namespace

UnstableStep::UnstableStep(const Mechanism& mechanism, const StiffestContact& contact, double when, double h)
    : ComputationError(message(mechanism, contact, when, h)),
      t(when),
      largest_step(classical_rk4().real_limit / contact.angular_frequency) {}

UnstableStep::UnstableStep(const std::string& sign, double when, double h)
    : ComputationError(message(sign, when, h)), t(when) {}

UnstableStep::UnstableStep(const UnstableStep& blown_up, double of_springs, double h)
    : ComputationError(message_of_springs(blown_up.t, of_springs, h)), t(blown_up.t), largest_step(of_springs) {}

double step_on_grid(double step, double spacing) {
  return spacing > 0.0 ? spacing / std::ceil(spacing / step - 1e-9) : step;
}

}  // namespace boresight
