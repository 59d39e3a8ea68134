#include "boresight/scene/deviation_coordinates.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/math/singular_values.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/rank_analysis.hpp"

namespace boresight {
namespace {

// Share of a row in motions that no row chosen before sees, from which on a joint's own offsets are coordinates before those
// of other joints.
constexpr double kPlainlyIndependent = 0.1;
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

}  // namespace

DeviationCoordinates::DeviationCoordinates(const Mechanism& mechanism, const IdealMotion& ideal)
    : mechanism_(mechanism),
      ideal_(ideal),
      layout_(mechanism),
      closed_(mechanism, {.clearance = ClearanceRows::closed, .drives = true}),
      open_(mechanism, {.clearance = ClearanceRows::open, .drives = true}),
      moved_(closed_),
      weight_(kinematic_weight(mechanism)),
      length_(mechanism.characteristic_length()),
      scale_(6 * mechanism.bodies()),
      laws_(mechanism.joints()),
      b_(closed_.block_vector()),
      u_(closed_.body_vector()),
      residual_(b_),
      du_(u_) {
  for (int b = 0; b < mechanism.bodies(); ++b) scale_.segment<6>(6 * b) = weight_[b].diagonal().cwiseSqrt();
  for (int c = 0; c < mechanism.clearances(); ++c)
    rows_.emplace_back(mechanism, mechanism.description().clearances[c].joint, ClearanceRows::released, false);
  for (int j = 0; j < mechanism.joints(); ++j) rows_.emplace_back(mechanism, j, ClearanceRows::free, false);

  // At an instant of no symmetry.
  ideal_.state(generic_instant(0.0, ideal_.duration()), state_);
  ideal_.drive_laws(state_.t, laws_);
  closed_.evaluate(state_.bodies, laws_);
  sparse_ = closed_.row_count() == 6 * mechanism.bodies() && closed_.factor(weight_);
  source_.assign(layout_.size(), kDependent);
  if (sparse_) {
    for (int c = 0; c < layout_.clearances(); ++c)
      for (int k = 0; k < layout_.joint(c).count(); ++k)
        if (layout_.joint(c).released(k)) {
          source_[layout_.joint(c).first + k] = static_cast<int>(chosen_.size());
          chosen_.push_back({c, layout_.joint(c).released_row(k)});
        }
  } else {
    open_.evaluate(state_.bodies, laws_);
    const MatX kept = scaled_rows(open_.dense_jacobian(), length_);
    std::vector<MatX> rows;
    for (const JointConstraint& c : rows_) rows.push_back(scaled_rows(stacked_rows(c, state_.bodies), length_));
    if (kept.rows() == 0) {
      choose(rows, MatX::Identity(kept.cols(), kept.cols()));
    } else {
      const Eigen::BDCSVD<MatX> svd(kept, Eigen::ComputeFullV);
      const Eigen::Index rank = (svd.singularValues().array() > kRankTolerance * svd.singularValues()[0]).count();
      choose(rows, svd.matrixV().rightCols(kept.cols() - rank));
    }
  }
  count_ = static_cast<int>(chosen_.size());
  unit_ = VecX::Ones(count_);
  for (int z = 0; z < count_; ++z) {
    const MatX row = stacked_rows(rows_[chosen_[z].constraint], state_.bodies).row(chosen_[z].row);
    for (int b = 0; b < mechanism.bodies(); ++b)
      if (row.middleCols<3>(6 * b).cwiseAbs().maxCoeff() > 0.0) unit_[z] = length_;
  }
  for (int c = 0; c < layout_.clearances(); ++c)
    if (layout_.joint(c).slides) source_[layout_.joint(c).first + 1] = kSlides;
  for (int s : source_) has_dependent_ = has_dependent_ || s == kDependent;
}

// Rows that tell the motions of the null space apart, the one that sees most of what is left first; offsets before joints.
void DeviationCoordinates::choose(const std::vector<MatX>& rows, const MatX& null_space) {
  struct Candidate {
    int constraint, row;
    VecX seen;  // the row's share in each motion left, less what chosen rows see already
  };
  const int freedoms = static_cast<int>(null_space.cols());
  const auto take = [&](int first, int last) {
    std::vector<Candidate> candidates;
    for (int k = first; k < last; ++k)
      for (Eigen::Index i = 0; i < rows[k].rows(); ++i)
        candidates.push_back(
            {k, static_cast<int>(i), null_space.transpose() * rows[k].row(i).transpose().normalized()});
    return candidates;
  };
  MatX basis(freedoms, 0);
  const int clearances = layout_.clearances();
  // Adds rows that see something which those chosen before do not, the one that sees most of it first.
  const auto add = [&](std::vector<Candidate> candidates, double least) {
    while (basis.cols() < freedoms) {
      const Candidate* best = nullptr;
      double largest = least;
      for (Candidate& c : candidates) {
        const VecX rest = c.seen - basis * (basis.transpose() * c.seen);
        if (rest.norm() > largest) largest = rest.norm(), best = &c;
      }
      if (!best) break;
      VecX rest = best->seen - basis * (basis.transpose() * best->seen);
      rest -= basis * (basis.transpose() * rest);
      basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
      basis.rightCols(1) = rest.normalized();
      chosen_.push_back({best->constraint, best->row});
    }
  };
  for (int c = 0; c < clearances; ++c) add(take(c, c + 1), kPlainlyIndependent);
  add(take(0, clearances), kRankTolerance);
  const std::size_t offsets = chosen_.size();
  add(take(clearances, static_cast<int>(rows.size())), kRankTolerance);
  leftover_ = static_cast<int>(chosen_.size() - offsets);
  if (basis.cols() < freedoms)
    throw ComputationError("the mechanism can move in " + std::to_string(freedoms - basis.cols()) +
                           " way(s) that no coordinate of a joint describes; use the multibody rung");
  // Offsets in the order of the layout.
  std::stable_sort(chosen_.begin(), chosen_.end() - leftover_, [](const Chosen& a, const Chosen& b) {
    return a.constraint != b.constraint ? a.constraint < b.constraint : a.row < b.row;
  });
  for (std::size_t z = 0; z + leftover_ < chosen_.size(); ++z) {
    const OffsetLayout::Joint& joint = layout_.joint(chosen_[z].constraint);
    for (int k = 0; k < joint.count(); ++k)
      if (joint.released(k) && joint.released_row(k) == chosen_[z].row) source_[joint.first + k] = static_cast<int>(z);
  }
}

void DeviationCoordinates::throw_singular(double t) const {
  throw ComputationError("the perturbation of the ideal motion does not exist at t = " + std::to_string(t) +
                         " s: the pose is singular or near it; use the multibody rung");
}

void DeviationCoordinates::gain(double t, MatX& T) {
  ideal_.state(t, state_);
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
  for (int c = 0; c < layout_.clearances(); ++c) {
    const MatX rows = stacked_rows(rows_[c], state_.bodies), now = of_offsets[c] * T + rows * T_rate;
    const MatX bound = kCancelled * (speed * (rows.cwiseAbs() * T.cwiseAbs()) + rows.cwiseAbs() * T_rate.cwiseAbs());
    const OffsetLayout::Joint& joint = layout_.joint(c);
    for (int k = 0; k < joint.count(); ++k) {
      if (source_[joint.first + k] != kDependent) continue;
      const int i = joint.released_row(k);
      B_rate.row(joint.first + k) = (now.row(i).array().abs() > bound.row(i).array()).select(now.row(i), 0.0);
    }
  }
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
        const MatX rows = stacked_rows(rows_[c], state_.bodies), bound = kCancelled * (rows.cwiseAbs() * T.cwiseAbs());
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

}  // namespace boresight
