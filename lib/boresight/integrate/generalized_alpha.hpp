// Generalized-alpha for second-order systems, y = (q, v), q' = v, v' = a(t, q, v): second order, with a spectral radius
// at infinity that the user chooses, for multibody systems whose fast modes should die instead of ring.
//
//   q1 = q0 + h v0 + h^2 ((1/2 - beta) A0 + beta A1)                     v1 = v0 + h ((1 - gamma) A0 + gamma A1)
//   (1 - alpha_m) A1 + alpha_m A0 = a(t + (1 - alpha_f) h, (1 - alpha_f) q1 + alpha_f q0, (1 - alpha_f) v1 + alpha_f v0)
//   alpha_m = (2 rho - 1)/(rho + 1),    alpha_f = rho/(rho + 1)
//   gamma = 1/2 - alpha_m + alpha_f,    beta = (1 - alpha_m + alpha_f)^2 / 4
//
// Chung and Hulbert (1993), A time integration algorithm for structural dynamics with improved numerical dissipation:
// the generalized-alpha method, Journal of Applied Mechanics 60, 371-375: equations 2-5, 17, 20, 25. A is an
// algorithmic acceleration, not a(t1, q1, v1) but, to the second order, a at t1 + (alpha_m - alpha_f) h; so it starts,
// and so it is moved where the step changes, or the method would lose its order there (Jay and Negrut 2007, equation
// 13, for the start). Solved for A1 by Newton's method with dense partial derivatives of a, half the size of y, which
// are kept over steps as long as four iterations suffice.
//
// Error estimate (ours): against Simpson's rule over the true accelerations at both ends and in the middle,
//   v* = v0 + h (a0 + 4 am + a1)/6,   q* = q0 + h v0 + h^2 (a0 + 2 am)/6,
// each an order better than v1 and q1, and filtered by the iteration matrix so that what is stiff does not count
// (Shampine's filter, Hairer and Wanner 1996, equation IV.8.20). It costs two evaluations, one of which the next step
// uses.
#pragma once

#include <Eigen/LU>
#include <limits>

#include "boresight/integrate/partial_derivatives.hpp"

namespace boresight {

class GeneralizedAlpha {
 public:
  // rho: spectral radius at infinite frequency, 0 (annihilates in one step) to 1 (keeps energy). size: of y, even.
  GeneralizedAlpha(double rho, Eigen::Index size)
      : half_(size / 2),
        alpha_m_((2.0 * rho - 1.0) / (rho + 1.0)),
        alpha_f_(rho / (rho + 1.0)),
        gamma_(0.5 - alpha_m_ + alpha_f_),
        beta_(0.25 * (1.0 - alpha_m_ + alpha_f_) * (1.0 - alpha_m_ + alpha_f_)),
        partial_(size),
        matrix_(half_, half_),
        lu_(half_),
        accepted_(VecX::Zero(half_)),
        algorithmic_rate_(accepted_),
        algorithmic_(accepted_),
        algorithmic_end_(algorithmic_),
        residual_(algorithmic_),
        correction_(algorithmic_),
        start_(VecX::Zero(size)),
        proposed_(start_),
        error_(start_),
        start_slope_(start_),
        end_slope_(start_),
        state_(start_),
        slope_(start_) {}

  const char* name() const { return "generalized-alpha"; }
  int order() const { return 2; }
  int error_order() const { return 2; }
  Eigen::Index size() const { return start_.size(); }
  const VecX& proposed() const { return proposed_; }
  const VecX& error() const { return error_; }
  const VecX& start_slope() const { return start_slope_; }
  double step_stiffness() const { return 0.0; }
  double stability_limit() const { return std::numeric_limits<double>::infinity(); }
  MethodCost& cost() { return cost_; }

  template <System S>
  void begin(const S& system, double t, const VecX& y) {
    evaluate(system, t, y, start_slope_);
    // da/dt along the solution, by a forward difference.
    const double later = difference_increment(t);
    state_ = y + later * start_slope_;
    evaluate(system, t + later, state_, slope_);
    accepted_ = start_slope_.tail(half_);
    algorithmic_rate_ = (slope_.tail(half_) - accepted_) / later;
    h_accepted_ = 0.0;
    jacobian_known_ = false;
  }

  // df/dy at the state that the next attempt starts from, or of the steps before, where it is kept.
  template <System S>
  const MatX& jacobian(const S& system, double t, const VecX& y) {
    if (!jacobian_known_) partial_.evaluate_jacobian(system, t, y, start_slope_, cost_);
    jacobian_known_ = true;
    return partial_.jacobian;
  }

  template <System S>
  Attempt attempt(const S& system, double t, double h, const VecX& y) {
    start_ = y;
    // Each attempt starts from the end of the last accepted step.
    algorithmic_ = accepted_ + ((alpha_m_ - alpha_f_) * (h - h_accepted_)) * algorithmic_rate_;
    h_ = h;
    jacobian(system, t, y);
    // Known to the next attempt only if this one ends well: iterations that run away leave derivatives from anywhere.
    jacobian_known_ = false;
    if (!decompose()) return Attempt::singular_matrix;
    if (!solve(system, t)) return Attempt::no_convergence;
    jacobian_known_ = true;
    estimate_error(system, t);
    return Attempt::done;
  }

  template <System S>
  void finish(const S&, double) {}

  void interpolate(double share, VecX& out) const {
    hermite(share, h_, start_, start_slope_, proposed_, end_slope_, out);
  }

  // The state moved a little after the step was taken.
  template <System S>
  void refresh(const S& system, double t, const VecX& y) {
    system.derivative(t, y, start_slope_);
    ++cost_.evaluations;
  }

  void advance() {
    start_slope_.swap(end_slope_);
    accepted_ = algorithmic_end_;
    algorithmic_rate_ = (algorithmic_end_ - algorithmic_) / h_;
    h_accepted_ = h_;
  }

 private:
  // Newton's method takes two to four iterations where it converges at all.
  static constexpr int kIterations = 12, kIterationsPerJacobian = 4;
  static constexpr double kIterationTolerance = 1e-8;  // of the change of A1, relative to its size

  template <System S>
  void evaluate(const S& system, double t, const VecX& y, VecX& slope) {
    system.derivative(t, y, slope);
    ++cost_.evaluations;
  }

  bool decompose() {
    const double to_position = (1.0 - alpha_f_) * h_ * h_ * beta_, to_velocity = (1.0 - alpha_f_) * h_ * gamma_;
    matrix_ = -to_position * partial_.jacobian.bottomLeftCorner(half_, half_) -
              to_velocity * partial_.jacobian.bottomRightCorner(half_, half_);
    matrix_.diagonal().array() += 1.0 - alpha_m_;
    if (!matrix_.allFinite()) return false;
    lu_.compute(matrix_);
    ++cost_.decompositions;
    return lu_.matrixLU().diagonal().cwiseAbs().minCoeff() > 0.0;
  }

  // y1 from A1, into proposed_.
  void place() {
    const auto q0 = start_.head(half_), v0 = start_.tail(half_);
    proposed_.head(half_) = q0 + h_ * v0 + h_ * h_ * ((0.5 - beta_) * algorithmic_ + beta_ * algorithmic_end_);
    proposed_.tail(half_) = v0 + h_ * ((1.0 - gamma_) * algorithmic_ + gamma_ * algorithmic_end_);
  }

  template <System S>
  bool solve(const S& system, double t) {
    const double t_f = t + (1.0 - alpha_f_) * h_;
    algorithmic_end_ = algorithmic_;
    bool on_the_way = false;  // derivatives were taken where an iteration stood, which may be far from where it led
    for (int k = 0; k < kIterations; ++k) {
      ++cost_.iterations;
      place();
      state_ = (1.0 - alpha_f_) * proposed_ + alpha_f_ * start_;
      evaluate(system, t_f, state_, slope_);
      residual_ = slope_.tail(half_) - (1.0 - alpha_m_) * algorithmic_end_ - alpha_m_ * algorithmic_;
      if (!residual_.allFinite()) return false;
      if (k > 0 && k % kIterationsPerJacobian == 0) {
        partial_.evaluate_jacobian(system, t_f, state_, slope_, cost_);
        if (!decompose()) return false;
        on_the_way = true;
      }
      correction_ = lu_.solve(residual_);
      algorithmic_end_ += correction_;
      const double size = algorithmic_end_.norm() + algorithmic_.norm();
      if (correction_.norm() <= kIterationTolerance * size) {
        place();
        if (!on_the_way) return true;
        partial_.evaluate_jacobian(system, t_f, state_, slope_, cost_);  // the error is filtered by it
        return decompose();
      }
    }
    return false;
  }

  template <System S>
  void estimate_error(const S& system, double t) {
    evaluate(system, t + h_, proposed_, end_slope_);
    interpolate(0.5, state_);
    evaluate(system, t + 0.5 * h_, state_, slope_);
    const auto a0 = start_slope_.tail(half_), am = slope_.tail(half_), a1 = end_slope_.tail(half_);
    error_.head(half_) =
        proposed_.head(half_) - start_.head(half_) - h_ * start_.tail(half_) - (h_ * h_ / 6.0) * (a0 + 2.0 * am);
    error_.tail(half_) = proposed_.tail(half_) - start_.tail(half_) - (h_ / 6.0) * (a0 + 4.0 * am + a1);
    for (Eigen::Index first : {Eigen::Index{0}, half_}) {
      residual_ = (1.0 - alpha_m_) * error_.segment(first, half_);
      correction_ = lu_.solve(residual_);
      error_.segment(first, half_) = correction_;
    }
  }

  Eigen::Index half_;
  double alpha_m_, alpha_f_, gamma_, beta_;
  PartialDerivatives partial_;
  bool jacobian_known_ = false;
  MatX matrix_;
  Eigen::PartialPivLU<MatX> lu_;
  VecX accepted_, algorithmic_rate_;  // A at the start of the step and its slope there, for a step of h_accepted_
  VecX algorithmic_, algorithmic_end_, residual_, correction_;
  VecX start_, proposed_, error_, start_slope_, end_slope_, state_, slope_;
  double h_ = 0.0, h_accepted_ = 0.0;
  MethodCost cost_;
};

}  // namespace boresight
