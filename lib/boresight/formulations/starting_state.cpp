#include "boresight/formulations/starting_state.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/math/dense_solves.hpp"
#include "boresight/mechanism/constraint_system.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/rank_analysis.hpp"

namespace boresight {
namespace {

// What joints leave free and nothing drives: values, zero at home, and their rows in the stacked velocities of all bodies. Lengths in units
// of the mechanism's own, so that its size is of no account.
class FreeCoordinates {
 public:
  explicit FreeCoordinates(const Mechanism& mechanism) : mechanism_(mechanism) {
    for (int j = 0; j < mechanism.joints(); ++j) {
      const JointConstraint joint(mechanism, j, ClearanceRows::free, false);
      if (mechanism.description().joints[j].driven || joint.count() == 0) continue;
      first_.push_back(count_);
      count_ += joint.count();
      joints_.push_back(joint);
    }
  }

  void evaluate(const std::vector<BodyMotion>& bodies, VecX& value, MatX& row) const {
    value = VecX::Zero(count_);
    row = MatX::Zero(count_, 6 * mechanism_.bodies());
    JointRows rows;
    for (std::size_t k = 0; k < joints_.size(); ++k) {
      joints_[k].evaluate(bodies, {}, rows);
      const int n = joints_[k].count();
      for (int i = 0; i < n; ++i)
        value[first_[k] + i] = rows.value[i] / (joints_[k].is_distance(i) ? mechanism_.characteristic_length() : 1.0);
      if (const int b = joints_[k].reference_body(); b != kGround)
        row.block(first_[k], 6 * b, n, 6) = rows.reference.topRows(n);
      if (const int b = joints_[k].other_body(); b != kGround)
        row.block(first_[k], 6 * b, n, 6) = rows.other.topRows(n);
    }
    row = scaled_rows(std::move(row), mechanism_.characteristic_length());
  }

  // Which of them a rate is given of, and its sign there: the joint's second body seen from its first.
  int place(const InitialRateDescription& rate) const {
    for (std::size_t k = 0; k < joints_.size(); ++k)
      for (int i = 0; i < joints_[k].count(); ++i)
        if (joints_[k].joint() == rate.joint &&
            joints_[k].is_distance(i) == (rate.freedom == InitialRateDescription::Freedom::displacement))
          return first_[k] + i;
    return -1;
  }
  double sign(const InitialRateDescription& rate) const {
    const JointDescription& joint = mechanism_.description().joints[rate.joint];
    for (const JointConstraint& k : joints_)
      if (k.joint() == rate.joint) return k.reference_body() == joint.first ? 1.0 : -1.0;
    return 1.0;
  }

 private:
  const Mechanism& mechanism_;
  std::vector<JointConstraint> joints_;
  std::vector<int> first_;
  int count_ = 0;
};

// The u that satisfies A u = b, and of all these the one that brings C u nearest to c; of what neither tells, the least.
VecX nearest_motion(const MatX& A, const VecX& b, const MatX& C, const VecX& c) {
  if (A.rows() == 0) return C.rows() == 0 ? VecX::Zero(C.cols()) : solve_least(C, c, kRankTolerance);
  const MatX back = pseudo_inverse(A, kRankTolerance);
  const VecX u = back * b;
  if (C.rows() == 0) return u;
  const MatX left = MatX::Identity(A.cols(), A.cols()) - back * A;
  // The trace of a projection is how many directions it keeps; where A leaves none, what is here is rounding.
  if (!(left.trace() > 0.5)) return u;
  // What moves there may show in none of the coordinates, as a body that no joint holds does: what C says of it is rounding then.
  const MatX seen = C * left;
  const double share = seen.norm() / C.norm();
  if (!(share > kRankTolerance)) return u;
  return u + left * solve_least(seen, VecX(c - C * u), kRankTolerance / share);
}

// The constraints' values or rates with lengths in units of the mechanism's own.
VecX stacked(const ConstraintSystem& system, double length, Vec6 JointRows::*which) {
  VecX all(system.row_count());
  int row = 0;
  for (int k = 0; k < system.blocks(); ++k)
    for (int i = 0; i < system.joints()[k].count(); ++i)
      all[row++] = (system.rows(k).*which)[i] / (system.joints()[k].is_distance(i) ? length : 1.0);
  return all;
}

// Newton's steps to where joints close and free coordinates are nearest to home.
void close_joints(const Mechanism& mechanism, ConstraintSystem& system, const FreeCoordinates& free,
                  const std::vector<TimeValue>& laws, IdealState& state) {
  constexpr int kMostSteps = 30;
  constexpr double kSettled = 1e-14;  // of the characteristic length, or rad
  const double length = mechanism.characteristic_length();
  VecX q;
  MatX row;
  for (int step = 0; step < kMostSteps; ++step) {
    system.evaluate(state.bodies, laws);
    free.evaluate(state.bodies, q, row);
    if (system.violation(length) < kSettled && (q.size() == 0 || q.cwiseAbs().maxCoeff() < kSettled)) return;
    const VecX u = nearest_motion(scaled_rows(system.dense_jacobian(), length),
                                  VecX(-stacked(system, length, &JointRows::value)), row, VecX(-q));
    for (int b = 0; b < mechanism.bodies(); ++b) {
      Vec6 motion = u.segment<6>(6 * b);
      motion.head<3>() *= length;
      displace(state.bodies[b], motion);
    }
    if (u.cwiseAbs().maxCoeff() < kSettled) return;
  }
}

// Velocities there: constraints and given rates satisfied, everything else as slow as they allow.
void set_rates(const Mechanism& mechanism, ConstraintSystem& system, const FreeCoordinates& free,
               const std::vector<TimeValue>& laws, IdealState& state) {
  const double length = mechanism.characteristic_length();
  system.evaluate(state.bodies, laws);
  VecX q;
  MatX row;
  free.evaluate(state.bodies, q, row);
  const std::vector<InitialRateDescription>& rates = mechanism.description().initial_rates;
  const MatX J = scaled_rows(system.dense_jacobian(), length);
  MatX A(J.rows() + static_cast<Eigen::Index>(rates.size()), J.cols());
  VecX b = VecX::Zero(A.rows());
  A.topRows(J.rows()) = J;
  b.head(J.rows()) = -stacked(system, length, &JointRows::rate);
  Eigen::Index at = J.rows();
  for (const InitialRateDescription& rate : rates) {
    const bool moves = rate.freedom == InitialRateDescription::Freedom::displacement;
    const int place = free.place(rate);
    if (place < 0)
      throw InputError(rate.origin, "initial.rates", "a rate of what the joint does not leave free",
                       "rates of free joints");
    A.row(at) = free.sign(rate) * row.row(place);
    b[at++] = rate.rate / (moves ? length : 1.0);
  }
  for (BodyMotion& body : state.bodies) body.v = body.w = Vec3::Zero();
  if (b.isZero(0.0)) return;  // at rest
  const VecX u = nearest_motion(A, b, row, VecX::Zero(row.rows()));
  if ((A * u - b).norm() > 1e-8 * b.norm()) {
    if (!rates.empty() && constraint_rank(mechanism, system) == 6 * mechanism.bodies())
      throw InputError(rates.front().origin, "initial.rates",
                       "rates where the joints together leave nothing free to move",
                       "joints that leave some motion; axes meant to be parallel or to meet may differ by a little");
    throw InputError(rates.empty() ? mechanism.description().motion.origin : rates.front().origin,
                     rates.empty() ? "motion" : "initial.rates", "rates that contradict each other or the joints",
                     "rates that the joints allow together");
  }
  for (int k = 0; k < mechanism.bodies(); ++k) {
    state.bodies[k].v = length * u.segment<3>(6 * k);
    state.bodies[k].w = u.segment<3>(6 * k + 3);
  }
}

}  // namespace

IdealState home_state(const Mechanism& mechanism) {
  IdealState state;
  const MechanismDescription& m = mechanism.description();
  state.bodies.resize(m.bodies.size());
  state.acceleration.assign(m.bodies.size(), Vec6::Zero());
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    state.bodies[b].p = m.bodies[b].center_of_mass;
    state.bodies[b].R = m.bodies[b].axes;
  }
  return state;
}

IdealState starting_state(const Mechanism& mechanism, const std::vector<TimeValue>& laws) {
  // Drives that begin away from home are led there by steps that Newton's method follows.
  constexpr double kStride = 0.1;  // [rad], or of the characteristic length
  constexpr double kClosed = 1e-6;
  const double length = mechanism.characteristic_length();
  ConstraintSystem system(mechanism, {.clearance = ClearanceRows::closed});
  const FreeCoordinates free(mechanism);
  IdealState state = home_state(mechanism);
  double farthest = 0.0;
  for (const auto& [joint, law] : mechanism.description().motion.drives)
    farthest =
        std::max(farthest, std::abs(laws[joint].value) /
                               (mechanism.description().joints[joint].type == JointType::prismatic ? length : 1.0));
  const int strides = std::max(1, static_cast<int>(std::ceil(farthest / kStride)));
  for (int k = 1; k <= strides; ++k) {
    std::vector<TimeValue> part = laws;
    for (TimeValue& law : part) law.value *= static_cast<double>(k) / strides;
    close_joints(mechanism, system, free, part, state);
  }
  system.evaluate(state.bodies, laws);
  if (!(system.violation(length) <= kClosed))
    throw ComputationError(
        "the joints do not close at t = 0, with the drives where they begin and what is free as near to home as they "
        "allow");
  set_rates(mechanism, system, free, laws, state);
  return state;
}

}  // namespace boresight
