#include "boresight/mechanism/constraint_system.hpp"

#include <cmath>
#include <map>

#include "boresight/mechanism/multiplier_solve.hpp"

namespace boresight {
namespace {

// The turn that a body has to go back by: of a small one its sine, which is zero again at half a turn; of a large one its vector.
Vec3 turn_of(const Mat3& R) {
  if (R.trace() < 1.0) {
    const Eigen::AngleAxisd turn(R);
    return turn.angle() * turn.axis();
  }
  return 0.5 * Vec3(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
}

}  // namespace

ConstraintSystem::ConstraintSystem(const Mechanism& mechanism, Rows rows)
    : bodies_(mechanism.bodies()), prescribed_(rows.prescribed_body) {
  for (int j = 0; j < mechanism.joints(); ++j) {
    JointConstraint constraint(mechanism, j, rows.clearance, rows.drives);
    if (constraint.count() == 0) continue;
    row_count_ += constraint.count();
    joints_.push_back(constraint);
  }
  const int n = static_cast<int>(joints_.size()) + (prescribed_ == kGround ? 0 : 1);
  if (prescribed_ != kGround) row_count_ += 6;
  rows_.resize(n);
  if (prescribed_ != kGround) rows_.back().other = Mat6::Identity();

  const auto body_of = [&](int block, bool other) {
    if (block == static_cast<int>(joints_.size())) return other ? prescribed_ : kGround;
    return other ? joints_[block].other_body() : joints_[block].reference_body();
  };
  std::map<BlockCholesky::Pair, int> pair_index;
  std::vector<BlockCholesky::Pair> pairs;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < row; ++column)
      for (bool row_other : {false, true})
        for (bool column_other : {false, true}) {
          const int body = body_of(row, row_other);
          if (body == kGround || body != body_of(column, column_other)) continue;
          const auto [it, fresh] = pair_index.try_emplace({row, column}, static_cast<int>(pairs.size()));
          if (fresh) pairs.push_back({row, column});
          couplings_.push_back({it->second, row, column, body, row_other, column_other});
        }
  cholesky_ = BlockCholesky(pairs, n);
  W_.resize(bodies_);
  JW_reference_.assign(n, Mat6::Zero());
  JW_other_.assign(n, Mat6::Zero());
  residual_.resize(n);
  work_blocks_.resize(n);
  work_bodies_.resize(bodies_);
}

int ConstraintSystem::rows_in(int block) const {
  return block < static_cast<int>(joints_.size()) ? joints_[block].count() : 6;
}

void ConstraintSystem::evaluate(const std::vector<BodyMotion>& bodies, const std::vector<TimeValue>& laws) {
  for (std::size_t k = 0; k < joints_.size(); ++k) joints_[k].evaluate(bodies, laws[joints_[k].joint()], rows_[k]);
  if (prescribed_ == kGround) return;
  const BodyMotion& body = bodies[prescribed_];
  JointRows& rows = rows_.back();
  rows.value << body.p - pose_.p, turn_of(body.R * pose_.R.transpose());
  rows.rate << body.v - pose_.v, body.w - pose_.w;
  rows.gamma << pose_.a, pose_.alpha;
}

bool ConstraintSystem::factor(const std::vector<Mat6>& W) {
  cholesky_.set_zero();
  for (int b = 0; b < bodies_; ++b) W_[b] = W[b];
  for (int k = 0; k < blocks(); ++k) {
    const bool joint = k < static_cast<int>(joints_.size());
    const int reference = joint ? joints_[k].reference_body() : kGround;
    const int other = joint ? joints_[k].other_body() : prescribed_;
    Mat6& diagonal = cholesky_.diagonal(k);
    if (reference != kGround) {
      JW_reference_[k].noalias() = rows_[k].reference * W[reference];
      diagonal.noalias() += JW_reference_[k] * rows_[k].reference.transpose();
    }
    if (other != kGround) {
      JW_other_[k].noalias() = rows_[k].other * W[other];
      diagonal.noalias() += JW_other_[k] * rows_[k].other.transpose();
    }
    if (redundant_) diagonal.diagonal() *= 1.0 + kRegularisation;
    for (int i = rows_in(k); i < 6; ++i) diagonal(i, i) = 1.0;
  }
  Mat6 block;
  for (const BlockCoupling& m : couplings_) {
    const Mat6& left = m.row_other ? JW_other_[m.row] : JW_reference_[m.row];
    const Mat6& right = m.column_other ? rows_[m.column].other : rows_[m.column].reference;
    block.noalias() = left * right.transpose();
    cholesky_.add_off_diagonal(m.pair, block);
  }
  return cholesky_.factor(redundant_ ? 0.0 : 1e-13);
}

void ConstraintSystem::multiply(const std::vector<Vec6>& u, std::vector<Vec6>& Ju) const {
  for (int k = 0; k < blocks(); ++k) {
    const bool joint = k < static_cast<int>(joints_.size());
    const int reference = joint ? joints_[k].reference_body() : kGround;
    const int other = joint ? joints_[k].other_body() : prescribed_;
    Ju[k].setZero();
    if (reference != kGround) Ju[k].noalias() += rows_[k].reference * u[reference];
    if (other != kGround) Ju[k].noalias() += rows_[k].other * u[other];
  }
}

void ConstraintSystem::multiply_transposed(const std::vector<Vec6>& lambda, std::vector<Vec6>& u) const {
  for (Vec6& x : u) x.setZero();
  for (int k = 0; k < blocks(); ++k) {
    const bool joint = k < static_cast<int>(joints_.size());
    const int reference = joint ? joints_[k].reference_body() : kGround;
    const int other = joint ? joints_[k].other_body() : prescribed_;
    if (reference != kGround) u[reference].noalias() += rows_[k].reference.transpose() * lambda[k];
    if (other != kGround) u[other].noalias() += rows_[k].other.transpose() * lambda[k];
  }
}

void ConstraintSystem::solve(std::vector<Vec6>& lambda) const {
  for (int k = 0; k < blocks(); ++k)
    for (int i = rows_in(k); i < 6; ++i) lambda[k][i] = 0.0;
  solve_multipliers(cholesky_, redundant_, lambda, residual_, work_blocks_, [&](const std::vector<Vec6>& found) {
    multiply_transposed(found, work_bodies_);
    for (int b = 0; b < bodies_; ++b) work_bodies_[b] = W_[b] * work_bodies_[b];
    multiply(work_bodies_, work_blocks_);
    for (int k = 0; k < blocks(); ++k) work_blocks_[k] = residual_[k] - work_blocks_[k];
  });
}

void ConstraintSystem::least_motion(std::vector<Vec6>& b, std::vector<Vec6>& u) const {
  solve(b);
  multiply_transposed(b, u);
  for (int k = 0; k < bodies_; ++k) u[k] = Vec6(W_[k] * u[k]);
}

double ConstraintSystem::violation() const {
  double largest = 0.0;
  for (const JointRows& rows : rows_) largest = std::max(largest, rows.value.lpNorm<Eigen::Infinity>());
  return largest;
}

double ConstraintSystem::violation(double length) const {
  double largest = 0.0;
  for (int k = 0; k < blocks(); ++k)
    for (int i = 0; i < rows_in(k); ++i) {
      const bool distance = k < static_cast<int>(joints_.size()) ? joints_[k].is_distance(i) : i < 3;
      const double value = std::abs(rows_[k].value[i]);
      // A value that is not a number must not be overlooked.
      if (!(value <= largest * (distance ? length : 1.0))) largest = distance ? value / length : value;
    }
  return largest;
}

MatX ConstraintSystem::dense_jacobian() const {
  MatX J = MatX::Zero(row_count_, 6 * bodies_);
  int row = 0;
  for (int k = 0; k < blocks(); ++k) {
    const int n = rows_in(k);
    const bool joint = k < static_cast<int>(joints_.size());
    const int reference = joint ? joints_[k].reference_body() : kGround;
    const int other = joint ? joints_[k].other_body() : prescribed_;
    if (reference != kGround) J.block(row, 6 * reference, n, 6) += rows_[k].reference.topRows(n);
    if (other != kGround) J.block(row, 6 * other, n, 6) += rows_[k].other.topRows(n);
    row += n;
  }
  return J;
}

}  // namespace boresight
