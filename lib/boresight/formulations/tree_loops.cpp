#include "boresight/formulations/tree_loops.hpp"

#include <algorithm>

#include "boresight/mechanism/multiplier_solve.hpp"

namespace boresight {
namespace {

// Adds J of one body, moved to the point O of its tree, times the axes of `speeds`.
void add_columns(const Mat6& J, int body, const TreeKinematics& kinematics, const std::vector<int>& speeds,
                 std::vector<Vec6>& G) {
  if (speeds.empty()) return;
  // v of the body = v at O + w x r: the rows against w gain r x (rows against v).
  const Vec3 r = kinematics.bodies()[body].p - kinematics.reference(body);
  const Vec6 vx = J.col(0), vy = J.col(1), vz = J.col(2);
  const Vec6 wx = J.col(3) + r.y() * vz - r.z() * vy;
  const Vec6 wy = J.col(4) + r.z() * vx - r.x() * vz;
  const Vec6 wz = J.col(5) + r.x() * vy - r.y() * vx;
  for (int k : speeds) {
    const SpeedAxis& S = kinematics.axes()[k];
    G[k] = S.move.x() * vx + S.move.y() * vy + S.move.z() * vz + S.turn.x() * wx + S.turn.y() * wy + S.turn.z() * wz;
  }
}

}  // namespace

LoopRows::LoopRows(const Mechanism& mechanism, const SpanningTree& tree, int joint, ClearanceRows clearance,
                   bool with_drive)
    : constraint_(mechanism, joint, clearance, with_drive) {
  const std::vector<int>& parent = tree.speed_parent();
  int a = tree.last_speed(constraint_.reference_body()), b = tree.last_speed(constraint_.other_body());
  // A speed's parent is smaller than itself, so going down from the larger one meets at the nearest common one.
  while (a != b) {
    std::vector<int>& side = a > b ? reference_only_ : other_only_;
    int& from = a > b ? a : b;
    side.push_back(from);
    support_.push_back(from);
    from = parent[from];
  }
  for (int k = a; k >= 0; k = parent[k]) {
    common_.push_back(k);
    support_.push_back(k);
  }
}

void LoopRows::jacobian(const TreeKinematics& kinematics, std::vector<Vec6>& G) const {
  add_columns(rows_.reference, constraint_.reference_body(), kinematics, reference_only_, G);
  add_columns(rows_.other, constraint_.other_body(), kinematics, other_only_, G);
  for (int k : common_) G[k].setZero();
}

Vec6 LoopRows::bias(const TreeKinematics& kinematics) const {
  Vec6 sum = Vec6::Zero();
  if (const int b = constraint_.reference_body(); b != kGround) sum.noalias() += rows_.reference * kinematics.bias()[b];
  if (const int b = constraint_.other_body(); b != kGround) sum.noalias() += rows_.other * kinematics.bias()[b];
  return sum;
}

LoopClosure::LoopClosure(const Mechanism& mechanism, const SpanningTree& tree, const std::vector<MassProperties>& mass,
                         bool with_clearance) {
  for (int joint : tree.cut_joints()) {
    LoopRows rows(mechanism, tree, joint, with_clearance ? ClearanceRows::open : ClearanceRows::closed, true);
    if (rows.count() > 0) blocks_.push_back(std::move(rows));
  }
  const int n = blocks();
  std::vector<BlockCholesky::Pair> pairs;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < row; ++column) {
      BlockCoupling m{row, column, {}};
      std::set_intersection(blocks_[row].support().begin(), blocks_[row].support().end(),
                            blocks_[column].support().begin(), blocks_[column].support().end(),
                            std::back_inserter(m.speeds), std::greater<int>());
      if (m.speeds.empty()) continue;
      pairs.push_back({row, column});
      couplings_.push_back(std::move(m));
    }
  cholesky_ = BlockCholesky(pairs, n);
  Z_.assign(n, std::vector<Vec6>(tree.speeds(), Vec6::Zero()));
  right_ = residual_ = block_vector();
  motion_ = VecX::Zero(tree.speeds());
  for (const MassProperties& m : mass) {
    Vec6 mobility;
    mobility << Vec3::Constant(1.0 / m.mass), Vec3::Constant(3.0 / m.inertia.trace());
    mobility_.push_back(mobility);
  }
}

void LoopClosure::evaluate(const std::vector<BodyMotion>& bodies, const std::vector<TimeValue>& laws) {
  for (LoopRows& block : blocks_) block.evaluate(bodies, laws);
}

double LoopClosure::violation() const {
  double largest = 0.0;
  for (const LoopRows& block : blocks_)
    for (int i = 0; i < block.count(); ++i) largest = std::max(largest, std::abs(block.rows().value[i]));
  return largest;
}

double LoopClosure::violation(double length) const {
  double largest = 0.0;
  for (const LoopRows& block : blocks_)
    for (int i = 0; i < block.count(); ++i)
      largest = std::max(largest, std::abs(block.rows().value[i]) / (block.constraint().is_distance(i) ? length : 1.0));
  return largest;
}

bool LoopClosure::factor(const TreeKinematics& kinematics, const BranchCholesky& H) {
  cholesky_.set_zero();
  for (int k = 0; k < blocks(); ++k) {
    std::vector<Vec6>& Z = Z_[k];
    blocks_[k].jacobian(kinematics, Z);
    H.solve_transposed(blocks_[k].support(), Z.data());
    Mat6& diagonal = cholesky_.diagonal(k);
    for (int speed : blocks_[k].support()) diagonal.noalias() += Z[speed] * Z[speed].transpose();
    if (redundant_) regularise(k, diagonal);
    for (int i = blocks_[k].count(); i < 6; ++i) diagonal(i, i) = 1.0;
  }
  Mat6 block;
  for (std::size_t m = 0; m < couplings_.size(); ++m) {
    block.setZero();
    for (int speed : couplings_[m].speeds)
      block.noalias() += Z_[couplings_[m].row][speed] * Z_[couplings_[m].column][speed].transpose();
    cholesky_.add_off_diagonal(static_cast<int>(m), block);
  }
  return cholesky_.factor(redundant_ ? 0.0 : 1e-13);
}

// Relative to what the diagonal would be with both bodies free, which bounds it from above: a row that the tree already
// satisfies (the planes of a planar loop) has a diagonal of zero.
void LoopClosure::regularise(int block, Mat6& diagonal) const {
  const LoopRows& rows = blocks_[block];
  for (int i = 0; i < rows.count(); ++i) {
    double free = 0.0;
    if (const int b = rows.constraint().reference_body(); b != kGround)
      free += rows.rows().reference.row(i).transpose().cwiseAbs2().dot(mobility_[b]);
    if (const int b = rows.constraint().other_body(); b != kGround)
      free += rows.rows().other.row(i).transpose().cwiseAbs2().dot(mobility_[b]);
    diagonal(i, i) += kRegularisation * free;
  }
}

void LoopClosure::multiply(const VecX& x, std::vector<Vec6>& Zx) const {
  for (int k = 0; k < blocks(); ++k) {
    Zx[k].setZero();
    for (int speed : blocks_[k].support()) Zx[k] += Z_[k][speed] * x[speed];
  }
}

void LoopClosure::subtract_transposed(const std::vector<Vec6>& lambda, VecX& x) const {
  for (int k = 0; k < blocks(); ++k)
    for (int speed : blocks_[k].support()) x[speed] -= Z_[k][speed].dot(lambda[k]);
}

void LoopClosure::solve(std::vector<Vec6>& lambda) {
  solve_multipliers(cholesky_, redundant_, lambda, right_, residual_, [&](const std::vector<Vec6>& found) {
    motion_.setZero();
    subtract_transposed(found, motion_);
    multiply(motion_, residual_);
    for (int k = 0; k < blocks(); ++k) residual_[k] += right_[k];
  });
}

void LoopClosure::constrain(std::vector<Vec6>& d, VecX& x) {
  if (blocks_.empty()) return;
  multiply(x, residual_);
  for (int k = 0; k < blocks(); ++k)
    for (int i = 0; i < 6; ++i) d[k][i] = i < blocks_[k].count() ? residual_[k][i] - d[k][i] : 0.0;
  solve(d);
  subtract_transposed(d, x);
}

}  // namespace boresight
