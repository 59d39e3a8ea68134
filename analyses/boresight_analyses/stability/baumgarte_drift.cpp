#include "boresight_analyses/stability/baumgarte_drift.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/formulations/formulation.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/constraint_system.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/rank_analysis.hpp"
#include "boresight_analyses/stability/amplification.hpp"

namespace boresight {
namespace {

constexpr int kPerBody = 13;        // of the paper formulation's state: p, q, v, w
constexpr double kInjected = 1e-7;  // of the characteristic length
constexpr int kSteps = 14;
constexpr double kFaint = 1e-4;  // of the largest violation: roundings are a ten-thousandth of that

}  // namespace

BaumgarteDrift::BaumgarteDrift(const Mechanism& mechanism, const IdealMotion& ideal)
    : mechanism_(mechanism), ideal_(ideal) {
  ideal.state(0.0, start_);
  make_paper_formulation(mechanism_, mechanism_.parameters(), &ideal_, {})->start(start_, on_the_constraints_);
  h_ = 1e-6 * mechanism.duration();
  std::vector<TimeValue> laws(mechanism.joints());
  ideal.drive_laws(0.0, laws);
  ConstraintSystem rows(mechanism, {.clearance = ClearanceRows::open});
  rows.evaluate(start_.bodies, laws);
  redundant_ = constraint_rank(mechanism, rows) < rows.row_count();
  // The displacement of one body along one axis that violates one row most, over all of them. Rows of driven
  // freedoms and of clearances are left out: the first move by their law, the second are open.
  double most = 0.0;
  for (int j = 0; j < mechanism.joints(); ++j) {
    JointConstraint joint(mechanism, j, ClearanceRows::open, false);
    if (joint.count() == 0) continue;
    const int body = joint.other_body() != kGround ? joint.other_body() : joint.reference_body();
    for (int axis = 0; axis < 3; ++axis) {
      JointRows at;
      std::vector<BodyMotion> moved = start_.bodies;
      moved[body].p[axis] += kInjected * mechanism.characteristic_length();
      joint.evaluate(moved, {}, at);
      Eigen::Index row;
      const double violated = at.value.head(joint.count()).cwiseAbs().maxCoeff(&row);
      if (violated <= 1.01 * most) continue;
      most = violated;
      watched_ = std::make_unique<JointConstraint>(joint);
      row_ = static_cast<int>(row);
      body_ = body;
      direction_ = Vec3::Unit(axis);
      joint_name_ = mechanism.description().joints[j].name;
    }
  }
  if (!watched_) throw ComputationError("no joint constrains a body: there is no constraint to stabilise");
}

JointRows BaumgarteDrift::rows_at(const std::vector<BodyMotion>& bodies) const {
  JointRows rows;
  watched_->evaluate(bodies, {}, rows);
  return rows;
}

std::vector<double> BaumgarteDrift::follow(const VecX& start, double alpha, double beta, double h, int steps) const {
  const auto formulation = make_paper_formulation(mechanism_, mechanism_.parameters(), &ideal_,
                                                  {true, Stabilisation::baumgarte, alpha, beta});
  std::vector<ContactMemory> memory(mechanism_.clearances());
  VecX y;
  if (redundant_) formulation->start(start_, y);  // finds that out for itself, by a rank analysis
  y = start;
  ExplicitRungeKutta method(classical_rk4(), y.size());
  const auto derivative = [&](double t, const VecX& s, VecX& ds) { formulation->derivative(t, s, memory, ds); };
  std::vector<double> violation;
  for (int n = 0;; ++n) {
    violation.push_back(rows_at(formulation->bodies(n * h, y)).value[row_]);
    // Beyond this the violation is no longer small against the mechanism, and the theory is of small ones.
    const bool large = !(std::abs(violation.back()) < 1e-4 * mechanism_.characteristic_length());
    if (n == steps || (large && n >= 3)) break;
    derivative(n * h, y, method.first_slope());
    method.step(n * h, h, y, derivative);
    formulation->stabilise((n + 1) * h, y);
    if (!y.allFinite()) break;
  }
  return violation;
}

std::vector<double> BaumgarteDrift::violation(double alpha_h, double beta_h, int steps) const {
  VecX y = on_the_constraints_;
  const double size = kInjected * mechanism_.characteristic_length();
  y.segment<3>(kPerBody * body_) += size * direction_;
  // Some velocity too, so that both roots have a part.
  y.segment<3>(kPerBody * body_ + 7) += 0.3 * size * std::max(alpha_h, beta_h) / h_ * direction_;
  return follow(y, alpha_h / h_, beta_h / h_, h_, steps);
}

double BaumgarteDrift::growth(double alpha_h, double beta_h) const {
  std::vector<double> signal = violation(alpha_h, beta_h, kSteps);
  // What has died away towards the roundings of the positions says nothing more.
  double most = 0.0;
  for (double v : signal) most = std::max(most, std::abs(v));
  const auto faint = [&](std::size_t n) { return std::hypot(signal[n], signal[n - 1]) < kFaint * most; };
  while (signal.size() > 4 && faint(signal.size() - 1)) signal.pop_back();
  return measured_growth(signal);
}

std::vector<double> BaumgarteDrift::after_a_wrong_velocity(double alpha, double beta, double h, int steps,
                                                           double& start_rate) const {
  const auto formulation = make_paper_formulation(mechanism_, mechanism_.parameters(), &ideal_, {});
  VecX y = on_the_constraints_;
  y.segment<3>(kPerBody * body_ + 7) += 1e-5 * mechanism_.characteristic_length() / mechanism_.duration() * direction_;
  start_rate = rows_at(formulation->bodies(0.0, y)).rate[row_];
  return follow(y, alpha, beta, h, steps);
}

BaumgarteLimit baumgarte_limit(const BaumgarteDrift& drift, double zeta) {
  BaumgarteLimit limit{zeta, theoretical_limit(coefficients(classical_rk4()), zeta), 0.0};
  limit.measured = measured_limit([&](double beta_h) { return drift.growth(zeta * beta_h, beta_h); }, limit.theory);
  return limit;
}

BaumgarteMap map_baumgarte(const BaumgarteDrift& drift, int count, const std::function<bool()>& advance) {
  BaumgarteMap map;
  map.joint = drift.joint();
  const MethodCoefficients rk4 = coefficients(classical_rk4());
  for (int i = 0; i < count; ++i) map.alpha_h.push_back(0.002 * std::pow(2000.0, i / (count - 1.0)));
  for (double beta_h : map.alpha_h) {
    if (!advance()) break;
    map.beta_h.push_back(beta_h);
    map.measured.emplace_back();
    map.theory.emplace_back();
    for (double alpha_h : map.alpha_h) {
      const double theory = theoretical_growth(rk4, alpha_h, beta_h), measured = drift.growth(alpha_h, beta_h);
      map.theory.back().push_back(theory);
      map.measured.back().push_back(measured);
      if (theory > 0.1 && theory < 2.0)
        map.largest_difference = std::max(map.largest_difference, std::abs(measured / theory - 1.0));
    }
  }
  return map;
}

}  // namespace boresight
