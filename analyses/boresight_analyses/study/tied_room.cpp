#include "boresight_analyses/study/tied_room.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/math/dense_solves.hpp"
#include "boresight/math/singular_values.hpp"
#include "boresight/mechanism/rank_analysis.hpp"

namespace boresight {

TiedRoom::TiedRoom(const Mechanism& mechanism, const OffsetLayout& layout, const std::vector<JointPlay>& plays,
                   std::vector<bool> asked)
    : mechanism_(mechanism),
      layout_(layout),
      plays_(plays),
      asked_(std::move(asked)),
      joint_coordinates_(plays.size()) {}

void TiedRoom::take(const std::vector<BodyMotion>& bodies) {
  const double length = mechanism_.characteristic_length();
  ConstraintSystem open(mechanism_, {.clearance = ClearanceRows::open, .drives = true});
  open.evaluate(bodies, std::vector<TimeValue>(static_cast<std::size_t>(mechanism_.joints())));
  const MatX kept = scaled_rows(open.dense_jacobian(), length);
  MatX motions = MatX::Identity(kept.cols(), kept.cols());
  if (kept.rows() > 0) {
    const auto [sigma, V] = singular_decomposition(kept);
    const Eigen::Index rank = (sigma.array() > kRankTolerance * sigma[0]).count();
    motions = V.rightCols(kept.cols() - rank);
  }
  // Scaled ones move by lengths of the mechanism and turn by radians.
  for (Eigen::Index b = 0; b < motions.rows(); b += 6) motions.middleRows(b + 3, 3) /= length;
  moved_.setZero(layout_.size(), motions.cols());
  for (int c = 0; c < layout_.clearances(); ++c) {
    if (layout_.joint(c).twists)
      joint_coordinates_[static_cast<std::size_t>(c)].twist = twist_of_insert(mechanism_, c, bodies);
    const int of_joint = mechanism_.description().clearances[static_cast<std::size_t>(c)].joint;
    const MatX rows =
        stacked_rows(JointConstraint(mechanism_, of_joint, ClearanceRows::released, false), bodies) * motions;
    const OffsetLayout::Joint& joint = layout_.joint(c);
    for (int k = 0; k < joint.count(); ++k)
      if (joint.released(k)) moved_.row(joint.first + k) = rows.row(joint.released_row(k));
  }
}

PlayMotion<double> TiedRoom::motion_of(int clearance, const VecX& offsets) const {
  const OffsetLayout::Joint& joint = layout_.joint(clearance);
  PlayOffsets own = PlayOffsets::Zero();
  own.head(joint.count()) = offsets.segment(joint.first, joint.count());
  return at_rest_at(own, joint_coordinates_[static_cast<std::size_t>(clearance)]);
}

double TiedRoom::depth(int clearance, const VecX& offsets) const {
  const JointPlay& play = plays_[static_cast<std::size_t>(clearance)];
  ContactStates<double> contact;
  play.penetrations(motion_of(clearance, offsets), contact);
  double most = -1.0;
  for (const ContactPlace place : play.places())
    most = std::max(most, contact[static_cast<std::size_t>(place)].penetration);
  return most;
}

double TiedRoom::force(int clearance, const VecX& offsets) const {
  const JointPlay& play = plays_[static_cast<std::size_t>(clearance)];
  PlayWrench<double> wrench;
  play.wrench(motion_of(clearance, offsets), kSlowImpacts, wrench);
  double most = 0.0;
  for (const ContactPlace place : play.places())
    most = std::max(most, wrench.contact[static_cast<std::size_t>(place)].normal_force);
  return most;
}

VecX TiedRoom::depths(const VecX& offsets) const {
  std::vector<double> all;
  ContactStates<double> contact;
  for (int c = 0; c < layout_.clearances(); ++c) {
    if (!asked_[static_cast<std::size_t>(c)]) continue;
    const JointPlay& play = plays_[static_cast<std::size_t>(c)];
    play.penetrations(motion_of(c, offsets), contact);
    for (const ContactPlace place : play.places()) all.push_back(contact[static_cast<std::size_t>(place)].penetration);
  }
  return Eigen::Map<const VecX>(all.data(), static_cast<Eigen::Index>(all.size()));
}

bool TiedRoom::fits_unmoved(const VecX& shift) const {
  const VecX depth = depths(shift);
  return depth.size() == 0 || depth.maxCoeff() <= kRounding;
}

VecX TiedRoom::least_pressed(const VecX& shift) const {
  constexpr int kMost = 200;
  constexpr double kDifference = 1e-8;                                          // [m], of gaps of micrometres and more
  constexpr double kMostDamping = 1e9, kLeastDamping = 1e-8, kSettled = 1e-12;  // [-], [-], [m]
  const Eigen::Index n = moved_.cols();
  VecX u = VecX::Zero(n), offsets = shift, depth = depths(shift);
  const auto pressed = [](const VecX& p) { return VecX(p.cwiseMax(0.0)); };
  double damping = 1e-3;
  MatX J(depth.size(), n);
  bool moved = true;
  for (int step = 0; step < kMost && n > 0 && depth.size() > 0 && depth.maxCoeff() > kRounding; ++step) {
    const VecX now = pressed(depth);
    if (moved)
      for (Eigen::Index k = 0; k < n; ++k) {
        const VecX by = kDifference * moved_.col(k);
        J.col(k) = (depths(offsets + by) - depths(offsets - by)) / (2.0 * kDifference);
        for (Eigen::Index i = 0; i < depth.size(); ++i)
          if (depth[i] <= 0.0) J(i, k) = 0.0;
      }
    MatX H = J.transpose() * J;
    H.diagonal().array() += damping * std::max(H.diagonal().maxCoeff(), 1e-30);
    const VecX du = solve_symmetric(H, VecX(-J.transpose() * now));
    const VecX to = shift + moved_ * (u + du), there = depths(to);
    moved = pressed(there).squaredNorm() < now.squaredNorm();
    if (moved) {
      u += du;
      offsets = to;
      depth = there;
      damping = std::max(kLeastDamping, 0.1 * damping);
    } else {
      damping *= 10.0;
    }
    if (damping > kMostDamping || (moved && du.norm() < kSettled)) break;
  }
  return offsets;
}

bool TiedRoom::has_room(const VecX& shift) const { return fits_unmoved(least_pressed(shift)); }

double TiedRoom::share_with_room(const VecX& shift) const {
  if (has_room(shift)) return 1.0;
  constexpr int kHalvings = 20;
  double with = 0.0, without = 1.0;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (with + without);
    (has_room(middle * shift) ? with : without) = middle;
  }
  return with;
}

}  // namespace boresight
