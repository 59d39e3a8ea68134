#include "boresight/scene/deviation_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/multibody_advice.hpp"
#include "boresight/mechanism/rank_analysis.hpp"

namespace boresight {
namespace {

// What redundant rows may disagree by, scaled: the ideal motion closes its joints to 1e-12.
constexpr double kContradiction = 1e-9;
// Offsets of a ten-thousandth of the lengths, multiplied by more than this, are no small deviation any more.
constexpr double kLargestGain = 1e3;
// Of the parts of a sum: below this share of them it is zero. T closes the loops to 1e-13.
constexpr double kCancelled = 1e-10;
// How far bodies are moved for the change of the rows with the pose, in radians and characteristic lengths: rows are products of a few
// sines, whose fourth order leaves 1e-13 there, as rounding does.
constexpr double kMoved = 1e-3;
// The first and the second derivative in the middle of five equally spaced values; the value in the middle has no part in the first and
// -30/12 in the second (Fornberg 1988, Mathematics of Computation 51, Table 1).
struct Weight {
  double place, first, second;
};
constexpr Weight kDerivative[] = {{-2.0, 1.0 / 12.0, -1.0 / 12.0},
                                  {-1.0, -8.0 / 12.0, 16.0 / 12.0},
                                  {1.0, 8.0 / 12.0, 16.0 / 12.0},
                                  {2.0, -1.0 / 12.0, -1.0 / 12.0}};
constexpr double kMiddleOfSecond = -30.0 / 12.0;

// Of gains: each entry as large as the entries of its column may be: a zero among them is known to their rounding only.
MatX sizes_of_columns(const MatX& T, double length) {
  MatX size(T.rows(), T.cols());
  for (Eigen::Index j = 0; j < T.cols(); ++j) {
    double moved = 0.0;
    for (Eigen::Index b = 0; b < T.rows(); b += 6)
      moved = std::max({moved, T.col(j).segment<3>(b).cwiseAbs().maxCoeff(),
                        length * T.col(j).segment<3>(b + 3).cwiseAbs().maxCoeff()});
    for (Eigen::Index b = 0; b < T.rows(); b += 6) {
      size.col(j).segment<3>(b).setConstant(moved);
      size.col(j).segment<3>(b + 3).setConstant(moved / length);
    }
  }
  return size;
}

}  // namespace

DeviationCoordinates::DeviationCoordinates(const Mechanism& mechanism, const IdealMotion& ideal)
    : DeviationCoordinates(mechanism, ideal, choose_offsets(mechanism, ideal)) {}

DeviationCoordinates::DeviationCoordinates(const Mechanism& mechanism, const IdealMotion& ideal, OffsetChoice choice)
    : mechanism_(mechanism),
      ideal_(ideal),
      layout_(mechanism),
      closed_(mechanism, {.clearance = ClearanceRows::closed, .drives = true}),
      open_(mechanism, {.clearance = ClearanceRows::open, .drives = true}),
      moved_(closed_),
      sparse_(choice.all),
      weight_(kinematic_weight(mechanism)),
      length_(mechanism.characteristic_length()),
      scale_(6 * mechanism.bodies()),
      rows_(rows_that_may_be_chosen(mechanism)),
      chosen_(std::move(choice.chosen)),
      source_(std::move(choice.source)),
      has_dependent_(choice.has_dependent),
      count_(static_cast<int>(chosen_.size())),
      leftover_(choice.leftover),
      laws_(mechanism.joints()),
      b_(closed_.block_vector()),
      u_(closed_.body_vector()),
      residual_(b_),
      du_(u_) {
  for (int b = 0; b < mechanism.bodies(); ++b) scale_.segment<6>(6 * b) = weight_[b].diagonal().cwiseSqrt();
  ideal_.state(generic_instant(0.0, ideal_.duration()), state_);
  unit_ = VecX::Ones(count_);
  for (int z = 0; z < count_; ++z) {
    const MatX row = stacked_rows(rows_[chosen_[z].constraint], state_.bodies).row(chosen_[z].row);
    for (int b = 0; b < mechanism.bodies(); ++b)
      if (row.middleCols<3>(6 * b).cwiseAbs().maxCoeff() > 0.0) unit_[z] = length_;
  }
}

void DeviationCoordinates::throw_singular(double t) const {
  // A ball joint's turns have coordinates that end a part of a turn from where it is drawn, though nothing is singular there.
  throw ComputationError("the perturbation of the ideal motion does not exist at t = " + std::to_string(t) +
                         (leftover_ > 0 ? " s: the pose is singular or near it, or the coordinates of a freedom that "
                                          "nothing drives end there"
                                        : " s: the pose is singular or near it") +
                         kUseMultibody);
}

void DeviationCoordinates::gain(double t, MatX& T) {
  ideal_.state(t, state_);
  gain_here(T);
}

void DeviationCoordinates::gain(const IdealState& state, MatX& T) {
  state_ = state;
  gain_here(T);
}

void DeviationCoordinates::gain_here(MatX& T) {
  const double t = state_.t;
  ideal_.drive_laws(t, laws_);
  T.setZero(6 * mechanism_.bodies(), count_);
  if (sparse_) {
    closed_.evaluate(state_.bodies, laws_);
    if (!closed_.factor(weight_)) throw_singular(t);
    sparse_gain(T);
  } else {
    dense_gain(t, T);
  }
  if (count_ == 0) return;
  const double largest = (scale_.cwiseInverse().asDiagonal() * T * unit_.asDiagonal()).cwiseAbs().maxCoeff();
  if (!(largest < kLargestGain)) throw_singular(t);
}

// The bodies' least motion that changes the closed rows by b_: the only one, since the rows are as many as the bodies' freedoms.
void DeviationCoordinates::solve_closed(Eigen::Ref<VecX> motion) {
  goal_ = b_;
  closed_.least_motion(b_, u_);
  // One refinement: J W J^T squares the condition number.
  closed_.multiply(u_, residual_);
  for (std::size_t k = 0; k < goal_.size(); ++k) residual_[k] = goal_[k] - residual_[k];
  closed_.least_motion(residual_, du_);
  for (int body = 0; body < mechanism_.bodies(); ++body) motion.segment<6>(6 * body) = u_[body] + du_[body];
}

void DeviationCoordinates::sparse_gain(MatX& T) {
  for (int k = 0; k < closed_.blocks(); ++k) {
    const int c = mechanism_.clearance_of(closed_.joints()[k].joint());
    if (c < 0) continue;
    const OffsetLayout::Joint& joint = layout_.joint(c);
    for (int i = 0; i < joint.count(); ++i) {
      if (!joint.released(i)) continue;
      for (Vec6& x : b_) x.setZero();
      b_[k][joint.released_row(i)] = 1.0;  // a closed joint's rows: distances, then slopes, then the drive
      solve_closed(T.col(source_[joint.first + i]));
    }
  }
}

// Rows that hold, then those chosen, with lengths scaled.
MatX DeviationCoordinates::dense_rows(const std::vector<BodyMotion>& bodies) {
  open_.evaluate(bodies, laws_);
  const Eigen::Index held = open_.row_count();
  MatX all(held + count_, 6 * mechanism_.bodies());
  all.topRows(held) = open_.dense_jacobian();
  for (int z = 0; z < count_; ++z)
    all.row(held + z) = stacked_rows(rows_[chosen_[z].constraint], bodies).row(chosen_[z].row);
  return scaled_rows(std::move(all), length_);
}

void DeviationCoordinates::dense_gain(double t, MatX& T) {
  if (count_ == 0) return;
  all_ = dense_rows(state_.bodies);
  MatX right = MatX::Zero(all_.rows(), count_);
  right.bottomRows(count_).setIdentity();
  qr_.setThreshold(kRankTolerance);
  qr_.compute(all_);
  if (qr_.rank() < all_.cols()) throw_singular(t);
  MatX x = qr_.solve(right);
  x += qr_.solve(MatX(right - all_ * x));
  if ((right - all_ * x).cwiseAbs().maxCoeff() > kContradiction) throw_singular(t);
  T = scale_.asDiagonal() * x * unit_.cwiseInverse().asDiagonal();
}

// J T is the same at all times, so that J T' = -J' T and J T'' = -J'' T - 2 J' T': J' and J'' are how the rows change as the bodies move on.
void DeviationCoordinates::rates(const MatX& T, MatX& T_rate, MatX& T_second, MatX& B_rate) {
  T_rate.setZero(T.rows(), T.cols());
  T_second.setZero(has_dependent_ ? T.rows() : 0, has_dependent_ ? T.cols() : 0);
  B_rate.setZero(layout_.size(), count_);
  double speed = 0.0;
  for (std::size_t b = 0; b < state_.bodies.size(); ++b) {
    const BodyMotion& body = state_.bodies[b];
    speed = std::max({speed, body.w.norm(), body.v.norm() / length_});
    if (!has_dependent_) continue;
    const BodyAcceleration& a = state_.acceleration[b];
    speed = std::max({speed, std::sqrt(a.tail<3>().norm()), std::sqrt(a.head<3>().norm() / length_)});
  }
  speed_ = speed;
  if (count_ == 0 || speed == 0.0) return;
  const double step = kMoved / speed;
  const MatX x = scale_.cwiseInverse().asDiagonal() * T * unit_.asDiagonal();
  MatX J_rate, J_second;
  if (!sparse_) J_rate = MatX::Zero(all_.rows(), all_.cols());
  if (has_dependent_) J_second = kMiddleOfSecond / (step * step) * all_;
  std::vector<std::vector<Vec6>> blocks(sparse_ ? count_ : 0, closed_.block_vector());
  for (auto& of_one : blocks)
    for (Vec6& block : of_one) block.setZero();
  std::vector<MatX> of_offsets(static_cast<std::size_t>(layout_.clearances()));
  std::vector<BodyMotion> bodies;
  for (const Weight& w : kDerivative) {
    bodies = state_.bodies;
    const double after = w.place * step;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      Vec6 by;
      by << after * bodies[b].v, after * bodies[b].w;
      if (has_dependent_) by += 0.5 * after * after * state_.acceleration[b];
      displace(bodies[b], by);
    }
    const double weight = w.first / step;
    if (sparse_) {
      moved_.evaluate(bodies, laws_);
      for (int z = 0; z < count_; ++z) {
        for (int b = 0; b < mechanism_.bodies(); ++b) u_[b] = T.block<6, 1>(6 * b, z);
        moved_.multiply(u_, residual_);
        for (std::size_t k = 0; k < residual_.size(); ++k) blocks[z][k] -= weight * residual_[k];
      }
    } else {
      const MatX J = dense_rows(bodies);
      J_rate += weight * J;
      if (has_dependent_) J_second += w.second / (step * step) * J;
    }
    if (!has_dependent_) continue;
    for (int c = 0; c < layout_.clearances(); ++c) {
      const MatX part = weight * stacked_rows(rows_[c], bodies);
      of_offsets[c] = of_offsets[c].size() == 0 ? part : MatX(of_offsets[c] + part);
    }
  }
  if (sparse_) {
    for (int z = 0; z < count_; ++z) {
      b_ = blocks[z];
      solve_closed(T_rate.col(z));
    }
    return;
  }
  const auto solved = [&](const MatX& right) {
    const MatX once = qr_.solve(right);
    return MatX(once + qr_.solve(MatX(right - all_ * once)));
  };
  const auto in_units = [&](const MatX& scaled) {
    return MatX(scale_.asDiagonal() * scaled * unit_.cwiseInverse().asDiagonal());
  };
  const MatX x_rate = solved(-J_rate * x);
  T_rate = in_units(x_rate);
  if (!has_dependent_) return;
  T_second = in_units(solved(-J_second * x - 2.0 * J_rate * x_rate));
  const MatX sizes = sizes_of_columns(T, mechanism_.characteristic_length());
  for (int c = 0; c < layout_.clearances(); ++c) {
    const MatX rows = stacked_rows(rows_[c], state_.bodies), now = of_offsets[c] * T + rows * T_rate;
    const MatX bound = kCancelled * (speed * (rows.cwiseAbs() * sizes) + rows.cwiseAbs() * T_rate.cwiseAbs());
    const OffsetLayout::Joint& joint = layout_.joint(c);
    for (int k = 0; k < joint.count(); ++k) {
      if (source_[joint.first + k] != kDependent) continue;
      const int i = joint.released_row(k);
      B_rate.row(joint.first + k) = (now.row(i).array().abs() > bound.row(i).array()).select(now.row(i), 0.0);
    }
  }
}

MatX DeviationCoordinates::rounding_of_rates(const MatX& T) const {
  return kCancelled * speed_ * sizes_of_columns(T, length_);
}

MatX DeviationCoordinates::offsets_per_coordinate(const MatX& T) const {
  MatX B = MatX::Zero(layout_.size(), count_);
  for (int c = 0; c < layout_.clearances(); ++c) {
    const OffsetLayout::Joint& joint = layout_.joint(c);
    MatX released;
    for (int k = 0; k < joint.count(); ++k) {
      const int source = source_[joint.first + k];
      if (source >= 0) B(joint.first + k, source) = 1.0;
      if (source != kDependent) continue;
      if (released.size() == 0) {
        // What bodies' motions cancel to is rounding, and not an offset that moves: its rate would be noise.
        const MatX rows = stacked_rows(rows_[c], state_.bodies),
                   bound = kCancelled * (rows.cwiseAbs() * sizes_of_columns(T, mechanism_.characteristic_length()));
        released = rows * T;
        released = (released.array().abs() > bound.array()).select(released, 0.0);
      }
      B.row(joint.first + k) = released.row(joint.released_row(k));
    }
  }
  return B;
}

void DeviationCoordinates::coordinate_accelerations(const std::vector<BodyMotion>& bodies,
                                                    const std::vector<BodyAcceleration>& acceleration,
                                                    VecX& z_ddot) const {
  z_ddot.resize(count_);
  JointRows rows;
  for (int z = 0; z < count_; ++z) {
    const JointConstraint& constraint = rows_[chosen_[z].constraint];
    constraint.evaluate(bodies, {}, rows);
    const int i = chosen_[z].row;
    z_ddot[z] = -rows.gamma[i];
    if (const int b = constraint.reference_body(); b != kGround)
      z_ddot[z] += rows.reference.row(i).dot(acceleration[b]);
    if (const int b = constraint.other_body(); b != kGround) z_ddot[z] += rows.other.row(i).dot(acceleration[b]);
  }
}

void DeviationCoordinates::coordinate_rates(const std::vector<BodyMotion>& bodies, VecX& z_dot, VecX& z) const {
  z_dot.resize(count_);
  z.resize(count_);
  JointRows rows;
  for (int k = 0; k < count_; ++k) {
    rows_[chosen_[k].constraint].evaluate(bodies, {}, rows);
    z_dot[k] = rows.rate[chosen_[k].row];
    z[k] = rows.value[chosen_[k].row];
  }
}

DeviationCoordinates::Deviation DeviationCoordinates::deviation(
    const IdealState& ideal, const std::vector<BodyMotion>& bodies,
    const std::vector<BodyAcceleration>& acceleration) const {
  Deviation now, drawn;
  for (auto [of, motion] : {std::pair(&now, &bodies), std::pair(&drawn, &ideal.bodies)})
    coordinate_rates(*motion, of->z_dot, of->z);
  now.z_dot.tail(leftover_) -= drawn.z_dot.tail(leftover_);
  // Turns may be a full turn apart.
  for (int k = count_ - leftover_; k < count_; ++k)
    now.z[k] = std::remainder(now.z[k] - drawn.z[k], 2.0 * std::numbers::pi);
  if (acceleration.empty()) return now;
  coordinate_accelerations(bodies, acceleration, now.z_ddot);
  coordinate_accelerations(ideal.bodies, ideal.acceleration, drawn.z_ddot);
  now.z_ddot.tail(leftover_) -= drawn.z_ddot.tail(leftover_);
  return now;
}

}  // namespace boresight
