#include "boresight/statics/tied_gaps.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "boresight/math/orthogonal_factors.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/statics/worst_offset.hpp"

namespace boresight {
namespace {

// Rounds of the search: at the first instant, and at those that go on from the one before.
constexpr int kFirstRounds = 60, kRounds = 3;
// No multiplier weighs less than this share of the largest, in what it adds to the bound: it could not come back.
constexpr double kLeastWeight = 1e-4;
// How well L D = G has to hold: far above rounding, far below what a bound is read to.
constexpr double kFulfilled = 1e-6;
// No gap counts as narrower than this share of the widest.
constexpr double kNarrowest = 1e-6;

}  // namespace

void TiedGaps::take(const RestingBalance& balance, const std::vector<RestingPlay>& rest) {
  parts_.clear();
  groups_.clear();
  std::vector<MatX> D;
  std::vector<VecX> d;
  for (std::size_t c = 0; c < rest.size(); ++c) {
    const std::vector<GapPart> of_joint = balance.joints()[c].gap_parts(rest[c], balance.joint_coordinates(c));
    // The parts' coordinates by the offsets.
    MatX offsets(kMostOffsets, 3 * of_joint.size());
    for (std::size_t k = 0; k < of_joint.size(); ++k) {
      const int first = static_cast<int>(3 * (parts_.size() + k));
      const GapPart& part = of_joint[k];
      offsets.middleCols<3>(static_cast<Eigen::Index>(3 * k)) = part.offset;
      if (part.shape == GapPart::Shape::ball) {
        groups_.push_back({{first, first + 1, first + 2}, part.radial});
        continue;
      }
      // Halves of a double cone's two widths lie within it together, and thirds of an octahedron's three.
      const bool octahedron = part.shape == GapPart::Shape::octahedron;
      const double of_width = octahedron ? 1.0 / 3.0 : part.shape == GapPart::Shape::double_cone ? 0.5 : 1.0;
      if (octahedron) {
        groups_.push_back({{first}, of_width * part.radial});
        groups_.push_back({{first + 2}, of_width * part.radial});
      } else if (part.offset.col(0).any()) {
        groups_.push_back({{first, first + 2}, of_width * part.radial});
      }
      const bool slides = balance.slides_along_axis(c) && part.offset(1, 1) != 0.0;  // nothing limits that
      if (part.offset.col(1).any() && !slides) groups_.push_back({{first + 1}, of_width * part.axial});
    }
    Eigen::CompleteOrthogonalDecomposition<MatX> inverse(offsets);
    MatX gain = balance.offset_gain(c);
    if (balance.slides_along_axis(c)) gain.row(1).setZero();  // nothing limits that
    D.push_back(inverse.solve(gain));
    d.push_back(inverse.solve(VecX(balance.offset_shift(c))));
    parts_.insert(parts_.end(), of_joint.begin(), of_joint.end());
  }
  const auto rows = static_cast<Eigen::Index>(3 * parts_.size());
  D_.resize(rows, balance.unit().cols());
  d_.resize(rows);
  Eigen::Index at = 0;
  for (std::size_t c = 0; c < D.size(); at += D[c].rows(), ++c) {
    D_.middleRows(at, D[c].rows()) = D[c];
    d_.segment(at, d[c].size()) = d[c];
  }
  double widest = 0.0;
  for (const Group& group : groups_) widest = std::max(widest, group.width);
  out_of_width_ = VecX::Zero(rows);
  for (Group& group : groups_)
    for (int row : group.rows) out_of_width_[row] = 1.0 / std::max(group.width, kNarrowest * widest);
}

// Of all L with L D = G the one of least sum of squares, each divided by its weight.
TiedGaps::Gain TiedGaps::multipliers(const Gain& gain, const VecX& weight) const {
  const MatX WD = weight.asDiagonal() * D_;
  const MatX DWD = D_.transpose() * WD;
  const VecX scale = DWD.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LDLT<MatX> solver(scale.asDiagonal() * DWD * scale.asDiagonal());
  const auto solved = [&](const Gain& right) {
    const MatX scaled = scale.asDiagonal() * right.transpose();
    return Gain((WD * (scale.asDiagonal() * solver.solve(scaled))).transpose());
  };
  Gain L = solved(gain);
  L += solved(gain - L * D_);
  return L;
}

double TiedGaps::bound_by(const Gain& multipliers) const {
  double sum = (multipliers * d_).norm();
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Mat3 L = multipliers.middleCols<3>(static_cast<Eigen::Index>(3 * k));
    sum += (L * worst_offset(L, parts_[k])).norm();
  }
  return sum;
}

void TiedGaps::weigh(const Gain& multipliers, VecX& weight) const {
  std::vector<double> adds(groups_.size());
  double largest = 0.0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    double squares = 0.0;
    for (int row : groups_[g].rows) squares += multipliers.col(row).squaredNorm();
    adds[g] = std::sqrt(squares) / out_of_width_[groups_[g].rows.front()];
    largest = std::max(largest, adds[g]);
  }
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (int row : groups_[g].rows)
      weight[row] = std::max(adds[g], kLeastWeight * largest) * out_of_width_[row] * out_of_width_[row];
}

double TiedGaps::bound(const Gain& gain, int quantity) {
  VecX& weight = weight_[static_cast<std::size_t>(quantity)];
  if (gain.isZero(0.0)) {
    last_ = Gain::Zero(3, D_.rows());
    return 0.0;
  }
  const bool first = weight.size() != D_.rows();
  if (first) weight = out_of_width_.cwiseAbs2();
  double least = 0.0;
  for (int round = 0; round < (first ? kFirstRounds : kRounds); ++round) {
    const Gain L = multipliers(gain, weight);
    // No multipliers do where the deviation may go on without end; then there is no bound.
    if (!((gain - L * D_).norm() <= kFulfilled * gain.norm()))
      throw ComputationError(
          "redundant joints tie the offsets of clearance joints together, and their gaps do not limit where these may "
          "go; use multibody");
    const double now = bound_by(L);
    if (round == 0 || now < least) {
      least = now;
      last_ = L;
    }
    weigh(L, weight);
  }
  return least;
}

VecX TiedGaps::place(const Gain& gain, const Vec3& towards) const {
  // Each part where it adds most, all of them to the same side; then the deviation that comes nearest to these, shrunk into the gaps.
  VecX xi(D_.rows());
  Vec3 sum = towards;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const Mat3 L = last_.middleCols<3>(static_cast<Eigen::Index>(3 * k));
    const Vec3 place = worst_offset(L, parts_[k]), adds = L * place;
    const double side = sum.dot(adds) < 0.0 ? -1.0 : 1.0;
    xi.segment<3>(static_cast<Eigen::Index>(3 * k)) = side * place;
    sum += side * adds;
  }
  const MatX scaled = out_of_width_.asDiagonal() * D_;
  const Eigen::CompleteOrthogonalDecomposition<MatX> solver(scaled);
  const auto nearest = [&](const VecX& there) { return VecX(solver.solve(out_of_width_.cwiseProduct(there - d_))); };
  const VecX middle = nearest(VecX::Zero(xi.size()));
  VecX away = nearest(xi) - middle;
  if ((gain * away).dot(towards) < 0.0) away = -away;
  const VecX from = D_ * middle + d_, by = D_ * away;
  double share = 1.0;
  for (const Group& group : groups_) {
    double a = 0.0, b = 0.0, c = -group.width * group.width;
    for (int row : group.rows) {
      a += by[row] * by[row];
      b += from[row] * by[row];
      c += from[row] * from[row];
    }
    if (c >= 0.0)
      share = 0.0;
    else if (a > 0.0)
      share = std::min(share, (-b + std::sqrt(b * b - a * c)) / a);
  }
  return middle + share * away;
}

}  // namespace boresight
