// Explicit Runge-Kutta methods for the Integrator: any table of explicit_tables.hpp, with its error estimate and dense
// output.
#pragma once

#include <algorithm>

#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/integrate/method.hpp"

namespace boresight {

class ExplicitMethod {
 public:
  ExplicitMethod(const ExplicitTable& table, Eigen::Index size)
      : runge_kutta_(table, size),
        start_(VecX::Zero(size)),
        proposed_(start_),
        error_(start_),
        end_slope_(start_),
        difference_(start_),
        ends_in_last_stage_(table.first_same_as_last()) {}

  const char* name() const { return table().name; }
  int order() const { return table().order; }
  int error_order() const { return table().embedded_order; }
  Eigen::Index size() const { return start_.size(); }
  const VecX& proposed() const { return proposed_; }
  const VecX& error() const { return error_; }
  const VecX& start_slope() const { return runge_kutta_.slope(0); }
  double stability_limit() const { return std::min(table().real_limit, table().imaginary_limit); }
  MethodCost& cost() { return cost_; }

  template <System S>
  void begin(const S& system, double t, const VecX& y) {
    system.derivative(t, y, runge_kutta_.first_slope());
    ++cost_.evaluations;
  }

  template <System S>
  Attempt attempt(const S& system, double t, double h, const VecX& y) {
    start_ = y;
    h_ = h;
    proposed_ = y;
    runge_kutta_.step(t, h, proposed_,
                      [&](double time, const VecX& stage, VecX& slope) { system.derivative(time, stage, slope); });
    cost_.evaluations += table().stages - 1;
    if (!table().b_embedded.empty()) {
      error_.setZero();
      for (int i = 0; i < table().stages; ++i)
        error_.noalias() += (h * (table().b[i] - table().b_embedded[i])) * runge_kutta_.slope(i);
    }
    return Attempt::done;
  }

  template <System S>
  void finish(const S& system, double t_end) {
    if (ends_in_last_stage_) {
      end_slope_ = runge_kutta_.slope(table().stages - 1);
    } else {
      system.derivative(t_end, proposed_, end_slope_);
      ++cost_.evaluations;
    }
  }

  void interpolate(double share, VecX& out) const {
    hermite(share, h_, start_, start_slope(), proposed_, end_slope_, out);
    const double bump = h_ * share * share * (1.0 - share) * (1.0 - share);
    for (std::size_t i = 0; i < table().d.size(); ++i)
      if (table().d[i] != 0.0) out.noalias() += (bump * table().d[i]) * runge_kutta_.slope(static_cast<int>(i));
  }

  void advance() { runge_kutta_.first_slope().swap(end_slope_); }

  double step_stiffness() const {
    const auto [i, j] = table().stiffness_stages;
    if (i == j) return 0.0;
    difference_.setZero();
    for (int l = 0; l < j; ++l) {
      const double weight = a(j, l) - (l < i ? a(i, l) : 0.0);
      if (weight != 0.0) difference_.noalias() += weight * runge_kutta_.slope(l);
    }
    const double apart = difference_.norm();
    return apart > 0.0 ? (runge_kutta_.slope(j) - runge_kutta_.slope(i)).norm() / (h_ * apart) : 0.0;
  }

 private:
  const ExplicitTable& table() const { return runge_kutta_.table(); }
  double a(int i, int j) const { return table().a[i * (i - 1) / 2 + j]; }

  ExplicitRungeKutta runge_kutta_;
  VecX start_, proposed_, error_, end_slope_;
  mutable VecX difference_;
  bool ends_in_last_stage_;
  double h_ = 0.0;
  MethodCost cost_;
};

}  // namespace boresight
