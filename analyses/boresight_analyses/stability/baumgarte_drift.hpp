// What Baumgarte's stabilisation does to the constraints of a real mechanism, step by step.
//
// The mechanism's own equations of motion (paper.cpp) are stepped by RK4 from a state whose
// constraints are violated by a displacement of one body of 1e-7 of the mechanism's length. The violation of
// one joint's row over the steps is the signal whose growth per step is measured. In theory it obeys Phi'' +
// 2 alpha Phi' + beta^2 Phi = 0 exactly.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/joint_rows.hpp"

namespace boresight {

class BaumgarteDrift {
 public:
  // The motion starts at the mechanism's ideal state at t = 0. Steps of about 1e-6 of the duration, over
  // which nothing else moves far. Throws ComputationError at a singular start.
  BaumgarteDrift(const Mechanism& mechanism, const IdealMotion& ideal);

  // Growth of the violation per step [-].
  double growth(double alpha_h, double beta_h) const;
  // Violation after every step, the start's first [m or rad].
  std::vector<double> violation(double alpha_h, double beta_h, int steps) const;
  // The same from a violated velocity instead, alpha and beta as they are [1/s]: the rate w [m/s or rad/s] at
  // the start is given back in start_rate. Steps of size h [s].
  std::vector<double> after_a_wrong_velocity(double alpha, double beta, double h, int steps, double& start_rate) const;

  const std::string& joint() const { return joint_name_; }  // whose row is watched
  double step() const { return h_; }                        // [s]

 private:
  std::vector<double> follow(const VecX& start, double alpha, double beta, double h, int steps) const;
  JointRows rows_at(const std::vector<BodyMotion>& bodies) const;

  const Mechanism& mechanism_;
  const IdealMotion& ideal_;
  IdealState start_;
  VecX on_the_constraints_;
  bool redundant_ = false;
  double h_ = 1e-6;
  std::unique_ptr<JointConstraint> watched_;
  int row_ = 0, body_ = 0;
  Vec3 direction_ = Vec3::UnitX();
  std::string joint_name_;
};

// How far a limit is from theory, relative; infinite where none was found near it.
inline double off_theory(double measured, double theory) {
  const double off = std::abs(measured / theory - 1.0);
  return std::isnan(off) ? std::numeric_limits<double>::infinity() : off;
}

struct BaumgarteLimit {
  double zeta = 0.0;                    // alpha / beta
  double theory = 0.0, measured = 0.0;  // largest stable beta h
};

// |R| over alpha h and beta h: rows along beta h.
struct BaumgarteMap {
  std::vector<double> alpha_h, beta_h;
  std::vector<std::vector<double>> measured, theory;
  double largest_difference = 0.0;  // |measured / theory - 1| where both are between 0.1 and 2
  std::vector<BaumgarteLimit> limits;
  std::string joint;
};

// `count` values along each axis, from 0.002 to 4. advance is called once per row and may return false to
// stop.
BaumgarteMap map_baumgarte(const BaumgarteDrift& drift, int count, const std::function<bool()>& advance);
BaumgarteLimit baumgarte_limit(const BaumgarteDrift& drift, double zeta);

}  // namespace boresight
