#include "boresight/contact_events/damped_contact.hpp"

#include <cstdio>
#include <utility>

#include "boresight/contact_events/contact_jacobian.hpp"
#include "boresight/math/eigenvalues.hpp"

namespace boresight {
namespace {

// Of the looks that met a contact: more than this share of them beyond the limit is a rule. And a contact that lasts for this share of the motion
// is no impact.
constexpr double kAsARule = 0.1;

using OffsetMatrix = Eigen::Matrix<double, kMostOffsets, kMostOffsets>;

// -d (force on the offsets) / d (their rates), of one joint. A tilting journal's slopes change with its spin, s' = w x y, and the contact's
// moment works on that.
OffsetMatrix damping(const JointPlay& joint, const PlayMotion<double>& motion, const ContactMemory& memory) {
  ContactJacobian J;
  contact_jacobian(joint, motion, memory.impact_speed, MomentAbout::insert, J);
  Eigen::Matrix<double, 6, kMostOffsets> by_rate;
  by_rate << J.col(3), J.col(4), J.col(5), J.col(11) - J.col(8), J.col(12) + J.col(6), J.col(7);
  OffsetMatrix D;
  D << by_rate.topRows<3>(), -by_rate.row(5), by_rate.row(3), by_rate.row(4);
  return -D;
}

}  // namespace

DampedContact most_damped_contact(const OffsetLayout& layout, const std::vector<JointPlay>& joints,
                                  const std::vector<PlayMotion<double>>& motion,
                                  const std::vector<ContactTracker>& trackers,
                                  const Eigen::Ref<const MatX>& compliance) {
  MatX D = MatX::Zero(layout.size(), layout.size());
  bool touching = false;
  for (int c = 0; c < layout.clearances(); ++c) {
    if (!trackers[c].touching()) continue;
    touching = true;
    const OffsetLayout::Joint& at = layout.joint(c);
    D.block(at.first, at.first, at.count(), at.count()) =
        damping(joints[c], motion[c], trackers[c].memory()).topLeftCorner(at.count(), at.count());
  }
  if (!touching) return {};
  const Eigen::EigenSolver<MatX> eigen(compliance * D);
  Eigen::Index fastest;
  DampedContact result;
  result.rate = eigen.eigenvalues().real().maxCoeff(&fastest);
  const VecX mode = D * eigen.eigenvectors().col(fastest).real();
  double largest = -1.0;
  for (int c = 0; c < layout.clearances(); ++c) {
    // A slope's moment over a length that makes it a force.
    const OffsetLayout::Joint& at = layout.joint(c);
    double share = mode.segment(at.first, 3).norm();
    if (at.tilts) share += mode.segment(at.first + 3, at.count() - 3).norm() / joints[c].lever();
    if (share > largest) {
      largest = share;
      result.clearance = c;
    }
  }
  return result;
}

DampingWatch::DampingWatch(const Mechanism& mechanism, double step, double limit)
    : mechanism_(mechanism), step_(step), limit_(limit) {}

void DampingWatch::look(double t, const OffsetLayout& layout, const std::vector<JointPlay>& joints,
                        const std::vector<PlayMotion<double>>& motion, const std::vector<ContactTracker>& trackers,
                        const Eigen::Ref<const MatX>& compliance) {
  // A journal that rests may part or press on by what rounding leaves: either way damping is what it is where nothing moves.
  std::vector<PlayMotion<double>> at_rest;
  if (t == 0.0) {
    at_rest = motion;
    for (PlayMotion<double>& m : at_rest) {
      m.e_dot.setZero();
      m.slope_rate.setZero();
    }
  }
  const DampedContact now = most_damped_contact(layout, joints, t == 0.0 ? at_rest : motion, trackers, compliance);
  const bool last_one = std::exchange(rests_beyond_, false);
  if (now.clearance < 0) return;
  ++looks_;
  if (!(now.rate * step_ > limit_)) return;
  ++beyond_;
  const double long_ago = t - kAsARule * mechanism_.duration();
  rests_beyond_ = long_ago >= 0.0 && trackers[static_cast<std::size_t>(now.clearance)].touching_since(long_ago);
  rested_ = rested_ || t == 0.0 || (last_one && rests_beyond_);
  if (now.rate > fastest_.rate) fastest_ = now;
}

bool DampingWatch::beyond() const { return surely_beyond(0); }

bool DampingWatch::surely_beyond(long looks_left) const {
  return rested_ || beyond_ > kAsARule * static_cast<double>(looks_ + looks_left);
}

std::string DampingWatch::warning() const {
  if (!beyond()) return "";
  const MechanismDescription& m = mechanism_.description();
  char text[320];
  std::snprintf(text, sizeof text,
                ": damping or friction of its contact sets in faster than steps of %.3g s follow (%.2g/s; RK4 "
                "follows %.2g/s), so that it "
                "chatters from step to step: contact forces and impacts are not to be relied on; --integrator "
                "rosenbrock follows it",
                step_, fastest_.rate, limit_ / step_);
  return m.joints[m.clearances[fastest_.clearance].joint].name + text;
}

}  // namespace boresight
