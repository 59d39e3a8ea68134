#include "boresight/mechanism/error_influence.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/math/orthogonal_factors.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/rank_analysis.hpp"
#include "boresight/mechanism/strained_joints.hpp"

namespace boresight {
namespace {

// A column below this of what the error displaces its joint by is rounding: a journal turned about its own axis moves no body.
constexpr double kRounding = 1e-11;
// What redundant rows may disagree by, of what an error asks of them: the commanded motion closes its joints to 1e-12.
constexpr double kContradiction = 1e-8;

std::shared_ptr<const Mechanism> without_errors(const Mechanism& drawn, const IdealMotion& commanded) {
  Parameters none = drawn.parameters();
  std::fill(none.error.begin(), none.error.end(), 0.0);
  // Refers to what outlives it.
  return built_mechanism(drawn, none,
                         std::shared_ptr<const IdealMotion>(std::shared_ptr<const IdealMotion>(), &commanded));
}

}  // namespace

ErrorInfluence::ErrorInfluence(const Mechanism& mechanism, const IdealMotion& commanded)
    : held_(without_errors(mechanism, commanded)),
      mechanism_(*held_),
      commanded_(commanded),
      closed_(mechanism_, {.clearance = ClearanceRows::held, .drives = true}),
      weight_(kinematic_weight(mechanism)),
      scale_(6 * mechanism.bodies()),
      offsets_(mechanism_),
      block_of_(mechanism.joints(), -1),
      laws_(mechanism.joints()),
      right_(closed_.block_vector()),
      goal_(right_),
      motion_(closed_.body_vector()),
      residual_(right_),
      more_(motion_) {
  for (int b = 0; b < mechanism.bodies(); ++b) scale_.segment<6>(6 * b) = weight_[b].diagonal().cwiseSqrt();
  for (const ErrorDescription& error : mechanism.description().errors)
    frames_.push_back(frame_errors(mechanism.description(), error));
  for (int c = 0; shifts() && c < mechanism.clearances(); ++c)
    released_.emplace_back(mechanism_, mechanism.description().clearances[c].joint, ClearanceRows::released, false);
  released_rows_.resize(released_.size());
  for (int k = 0; k < closed_.blocks(); ++k) block_of_[closed_.joints()[k].joint()] = k;
  if (closed_.row_count() != 6 * mechanism.bodies()) return;
  commanded_.state(generic_instant(0.0, commanded_.duration()), state_);
  commanded_.drive_laws(state_.t, laws_);
  closed_.evaluate(state_.bodies, laws_);
  rows_tell_motion_ = constraint_rank(mechanism_, closed_) == closed_.row_count();
}

Vec6 ErrorInfluence::seen(const JointConstraint& constraint, const JointRows& rows, std::size_t e) const {
  const MechanismDescription& m = mechanism_.description();
  Vec6 change = Vec6::Zero();
  for (const FrameError& frame : frames_[e]) {
    if (frame.joint != constraint.joint()) continue;
    const JointDescription& joint = m.joints[frame.joint];
    const JointGeometry& geometry = mechanism_.geometry(frame.joint);
    const int body = frame.second ? joint.second : joint.first;
    const bool ground = body == kGround;
    const Mat3 R = ground ? Mat3(Mat3::Identity()) : state_.bodies[body].R;
    // The frame has turned with its body since home.
    const Mat3 turn = ground ? R : Mat3(R * m.bodies[body].axes.transpose());
    const Vec3 r = R * (frame.second ? geometry.second : geometry.first).p;
    const Vec3 translation = turn * frame.translation, rotation = turn * frame.rotation;
    Vec6 moved;
    moved << translation - rotation.cross(r), rotation;
    change += (body == constraint.other_body() ? rows.other : rows.reference) * moved;
  }
  return change;
}

// What the rows have to change by for one error, at the pose that the system was evaluated at.
void ErrorInfluence::right_side(std::size_t e, double t) {
  for (Vec6& rows : right_) rows.setZero();
  const MechanismDescription& m = mechanism_.description();
  const double length = mechanism_.characteristic_length();
  asked_ = 0.0;
  for (const FrameError& frame : frames_[e])
    asked_ = std::max(asked_, frame.translation.norm() / length + frame.rotation.norm());
  for (const FrameError& frame : frames_[e])
    if (const int k = block_of_[frame.joint]; k >= 0) right_[k] = -seen(closed_.joints()[k], closed_.rows(k), e);
  const ErrorDescription& error = m.errors[e];
  if (error.kind != ErrorDescription::Kind::drive) return;
  const int k = block_of_[error.joint];
  const double errs = error.law->at(laws_[error.joint], t).value;
  if (!std::isfinite(errs))
    throw ComputationError("the law of error." + error.name + " has no value at t = " + std::to_string(t) +
                           " s, where its drive is at " + std::to_string(laws_[error.joint].value) + " (rad or m)");
  right_[k][closed_.joints()[k].drive_row()] += closed_.joints()[k].drive_sign() * errs;
  asked_ = std::abs(errs) / (closed_.joints()[k].is_distance(closed_.joints()[k].drive_row()) ? length : 1.0);
}

void ErrorInfluence::drop_rounding(int e, MatX& G) const {
  if (G.col(e).cwiseQuotient(scale_).lpNorm<Eigen::Infinity>() <= kRounding * asked_) G.col(e).setZero();
}

void ErrorInfluence::at(double t, const std::vector<bool>& wanted, MatX& G) {
  commanded_.state(t, state_);
  commanded_.drive_laws(t, laws_);
  G.setZero(6 * mechanism_.bodies(), count());
  shift_.setZero(shifts() ? offsets_.size() : 0, count());
  for (std::size_t c = 0; c < released_.size(); ++c) released_[c].evaluate(state_.bodies, {}, released_rows_[c]);
  closed_.evaluate(state_.bodies, laws_);
  if (!rows_tell_motion_ || !closed_.factor(weight_)) return solve_dense(wanted, t, G);
  for (int e = 0; e < count(); ++e) {
    if (!wanted.empty() && !wanted[e]) continue;
    right_side(static_cast<std::size_t>(e), t);
    goal_ = right_;
    closed_.least_motion(right_, motion_);
    // One refinement: J W J^T squares the condition number.
    closed_.multiply(motion_, residual_);
    for (std::size_t k = 0; k < goal_.size(); ++k) residual_[k] = goal_[k] - residual_[k];
    closed_.least_motion(residual_, more_);
    for (int b = 0; b < mechanism_.bodies(); ++b) G.block<6, 1>(6 * b, e) = motion_[b] + more_[b];
    drop_rounding(e, G);
    add_shift(static_cast<std::size_t>(e), G);
  }
}

// Where an error leaves the offsets that are no coordinates.
void ErrorInfluence::add_shift(std::size_t e, const MatX& G) {
  const OffsetChoice* choice = mechanism_.offset_choice();
  for (std::size_t c = 0; c < released_.size(); ++c) {
    const JointConstraint& joint = released_[c];
    Vec6 moved = seen(joint, released_rows_[c], e);
    if (const int b = joint.reference_body(); b != kGround)
      moved += released_rows_[c].reference * G.block<6, 1>(6 * b, static_cast<Eigen::Index>(e));
    if (const int b = joint.other_body(); b != kGround)
      moved += released_rows_[c].other * G.block<6, 1>(6 * b, static_cast<Eigen::Index>(e));
    const OffsetLayout::Joint& layout = offsets_.joint(static_cast<int>(c));
    for (int k = 0; k < layout.count(); ++k)
      if (choice->source[layout.first + k] == OffsetChoice::kDependent)
        shift_(layout.first + k, static_cast<Eigen::Index>(e)) = moved[layout.released_row(k)];
  }
}

void ErrorInfluence::solve_dense(const std::vector<bool>& wanted, double t, MatX& G) {
  const double length = mechanism_.characteristic_length();
  const MatX J = closed_.dense_jacobian() * scale_.asDiagonal();
  // Rows of lengths and of angles alike in size.
  VecX unit = VecX::Ones(J.rows());
  std::vector<int> joint_of(static_cast<std::size_t>(J.rows()));
  Eigen::Index row = 0;
  for (int k = 0; k < closed_.blocks(); ++k)
    for (int i = 0; i < closed_.joints()[k].count(); ++i, ++row) {
      if (closed_.joints()[k].is_distance(i)) unit[row] = 1.0 / length;
      joint_of[static_cast<std::size_t>(row)] = closed_.joints()[k].joint();
    }
  Eigen::ColPivHouseholderQR<MatX> qr;
  qr.setThreshold(kRankTolerance);
  qr.compute(unit.asDiagonal() * J);
  if (qr.rank() < J.cols())
    throw ComputationError(
        "freedoms are left that nothing drives, or the pose is singular: what standing errors do to the pose then "
        "hangs on the "
        "whole motion, which the multibody rung follows");
  const std::vector<ErrorDescription>& errors = mechanism_.description().errors;
  for (int e = 0; e < count(); ++e) {
    if (!wanted.empty() && !wanted[e]) continue;
    right_side(static_cast<std::size_t>(e), t);
    VecX right(J.rows());
    row = 0;
    for (int k = 0; k < closed_.blocks(); ++k)
      for (int i = 0; i < closed_.joints()[k].count(); ++i, ++row) right[row] = unit[row] * right_[k][i];
    VecX x = qr.solve(right);
    x += qr.solve(VecX(right - unit.asDiagonal() * (J * x)));
    const VecX left = right - unit.asDiagonal() * (J * x);
    if (left.cwiseAbs().maxCoeff() > std::max(kContradiction * right.cwiseAbs().maxCoeff(), kRounding * asked_)) {
      std::vector<double> open(static_cast<std::size_t>(mechanism_.joints()), 0.0);
      for (std::size_t i = 0; i < joint_of.size(); ++i) {
        double& joint = open[static_cast<std::size_t>(joint_of[i])];
        joint = std::max(joint, std::abs(left[static_cast<Eigen::Index>(i)]));
      }
      throw ComputationError("error." + errors[e].name + " strains the mechanism, whose " +
                             strained_joints(mechanism_, open) +
                             " not close with it: there is no play for it, and nothing gives");
    }
    G.col(e) = scale_.asDiagonal() * x;
    drop_rounding(e, G);
    add_shift(static_cast<std::size_t>(e), G);
  }
}

}  // namespace boresight
