#include "boresight_analyses/stability/contact_oscillator.hpp"

#include <cmath>
#include <vector>

#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight_analyses/stability/amplification.hpp"

namespace boresight {

double measured_growth(const ExplicitTable& method, const ContactOscillator& contact, double h) {
  constexpr int kSteps = 12;
  ExplicitRungeKutta runge_kutta(method, 2);
  const auto derivative = [&](double t, const VecX& y, VecX& dy) { contact.derivative(t, y, dy); };
  const double omega = std::sqrt(contact.stiffness / contact.mass);
  VecX y(2);
  y << 1e-6, 0.3e-6 * omega;  // both parts of the motion
  std::vector<double> displacement = {y[0]};
  for (int n = 0; n < kSteps; ++n) {
    derivative(n * h, y, runge_kutta.first_slope());
    runge_kutta.step(n * h, h, y, derivative);
    displacement.push_back(y[0]);
  }
  return measured_growth(displacement);
}

}  // namespace boresight
