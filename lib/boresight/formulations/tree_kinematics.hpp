// Bodies from joint coordinates: poses, velocities, and what their accelerations are made of, outward along the tree.
//
// With O a point of one's choice, a_k the axis of free speed u_k (zero for a slide) and m_k the velocity that u_k = 1 gives
// the body-fixed point at O, a body at p moves with
//   w = sum a_k u_k + (the drives' part)        v = sum (m_k + a_k x (p - O)) u_k + (the drives' part),
// summed over the speeds between it and the ground, and its acceleration is the same sum with udot_k in place of u_k, plus a
// bias: all that remains for udot = 0, the prescribed accelerations of the drives included. Everything in world axes, so
// that joint axes and inertias need no change of frame along the way; O is the root joint's point, one per tree, so that a
// mechanism far from the world's origin loses no digits.
// Source: Featherstone (2008), Rigid Body Dynamics Algorithms, chapters 2 to 4 (his spatial vectors, at one common point).
//
// State y: positions of all tree joints, then their speeds (SpanningTree). A ball's positions are the quaternion w x y z of
// the body's joint frame in the parent's, its speeds the relative angular velocity in axes of the latter.
#pragma once

#include <vector>

#include "boresight/math/time_function.hpp"
#include "boresight/mechanism/body_motion.hpp"
#include "boresight/mechanism/spanning_tree.hpp"

namespace boresight {

// What one free speed does: a_k and m_k above.
struct SpeedAxis {
  Vec3 turn = Vec3::Zero(), move = Vec3::Zero();
};

class TreeKinematics {
 public:
  explicit TreeKinematics(const SpanningTree& tree);

  int state_size() const { return tree_.positions() + tree_.speeds(); }

  // laws: one per joint of the mechanism, used where it is driven.
  void evaluate(const VecX& y, const std::vector<TimeValue>& laws);
  // Of the last evaluate(), per body or per speed.
  const std::vector<BodyMotion>& bodies() const { return bodies_; }
  const std::vector<BodyAcceleration>& bias() const { return bias_; }
  const std::vector<SpeedAxis>& axes() const { return axes_; }
  const Vec3& reference(int body) const { return reference_[body]; }  // O of its tree

  // Accelerations of all bodies, from those of the free speeds.
  void accelerations(const VecX& speed_rate, std::vector<BodyAcceleration>& out) const;

  // The state in which the bodies are where, and move as, they do (as far as the tree's joints allow).
  void read(const std::vector<BodyMotion>& bodies, VecX& y) const;
  // Head of dy: rates of the positions.
  void position_rates(const VecX& y, VecX& dy) const;
  // Head of y: moved by speeds times time, all small.
  void displace(const VecX& step, VecX& y) const;
  void normalise(VecX& y) const;

 private:
  const SpanningTree& tree_;
  std::vector<Mat3> R_JB_;  // per tree joint: of `to`, transposed
  std::vector<BodyMotion> bodies_;
  std::vector<BodyAcceleration> bias_;
  std::vector<SpeedAxis> axes_;
  std::vector<Vec3> reference_;
  mutable std::vector<SpeedAxis> sum_;  // per body: of axis times acceleration, from the ground to it
};

}  // namespace boresight
