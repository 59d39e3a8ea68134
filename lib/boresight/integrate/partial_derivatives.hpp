// df/dy and df/dt of a problem: its own where it gives them, else by forward differences.
//
// The increment of y_i is sqrt(eps max(1e-5, |y_i|)), that of RADAU5 and RODAS (Hairer and Wanner 1996, section IV.8):
// at a joint with a tenth of a millimetre of clearance it is 1e-10 m, a thousandth of the penetration under a load of
// 10 N.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/integrate/method.hpp"

namespace boresight {

inline double difference_increment(double value) {
  return std::sqrt(std::numeric_limits<double>::epsilon() * std::max(1e-5, std::abs(value)));
}

// df/dy at (t, y) by forward differences; f0: the right-hand side there. shifted, f: work space of y's size.
template <System S>
void jacobian_by_differences(const S& system, double t, const VecX& y, const VecX& f0, VecX& shifted, VecX& f,
                             MatX& J) {
  shifted = y;
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    shifted[i] = y[i] + difference_increment(y[i]);
    system.derivative(t, shifted, f);
    J.col(i) = (f - f0) / (shifted[i] - y[i]);
    shifted[i] = y[i];
  }
}

class PartialDerivatives {
 public:
  explicit PartialDerivatives(Eigen::Index size) : jacobian(size, size), time(VecX::Zero(size)), y_(time), f_(time) {}

  // f0: the right-hand side at (t, y).
  template <System S>
  void evaluate(const S& system, double t, const VecX& y, const VecX& f0, MethodCost& cost) {
    evaluate_jacobian(system, t, y, f0, cost);
    if constexpr (GivesTimeDerivative<S>) {
      system.time_derivative(t, y, time);
    } else if constexpr (!Autonomous<S>) {
      const double later = t + difference_increment(t);
      system.derivative(later, y, f_);
      ++cost.evaluations;
      time = (f_ - f0) / (later - t);
    }
  }

  template <System S>
  void evaluate_jacobian(const S& system, double t, const VecX& y, const VecX& f0, MethodCost& cost) {
    ++cost.jacobians;
    if constexpr (GivesJacobian<S>) {
      system.jacobian(t, y, jacobian);
    } else {
      jacobian_by_differences(system, t, y, f0, y_, f_, jacobian);
      cost.evaluations += y.size();
    }
  }

  MatX jacobian;
  VecX time;

 private:
  VecX y_, f_;
};

}  // namespace boresight
