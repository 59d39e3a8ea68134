// Which joints carry the bodies and which ones close loops: the mechanism as trees rooted in the ground, plus cut joints.
//
// In joint coordinates a body's pose follows from those of the joints between it and the ground, which takes a tree.
// A mechanism with loops has more joints than a tree can hold, and those left over ("cut") become constraint rows.
// A tree joint is written as up to three slides along the axes of the joint frame of the body nearer the ground, then turns
// about the point reached:
//
//   joint                        slides   turns                         free speeds (one less where driven)
//   revolute                     -        about y                       1
//   prismatic                    y        -                             1
//   cylindrical                  y        about y                       2
//   planar                       x z      about y                       3
//   universal                    -        two axes, one in each body    2
//   spherical                    -        a quaternion                  3, and 4 positions
//   fixed                        -        -                             0
//   opened, axes parallel        x y z    about y                       4
//   opened prismatic, parallel   x y z    -                             3
//   opened, axes free; floating  x y z    a quaternion                  6, and 7 positions
//
// "Opened" is a joint whose clearance is modelled: it carries a body only where nothing else does. "Floating" is a body that
// no joint connects to the ground, not even through others.
// Source: Featherstone (2008), Rigid Body Dynamics Algorithms, chapter 4.
#pragma once

#include <array>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

struct TreeJoint {
  enum class Turns { none, about_axis, about_two_axes, ball };

  int joint = -1;                                      // of the mechanism; -1: the body floats
  int parent = kGround;                                // the body nearer the ground
  int body = 0;                                        // the body it carries
  JointFrame from, to;                                 // in parent, in body; they coincide at home
  std::array<bool, 3> slides = {false, false, false};  // along x, y, z of `from`
  Turns turns = Turns::none;
  // about_two_axes: the first is fixed in the parent, the second in the body; in axes of the joint, at home.
  Vec3 first_axis = Vec3::UnitY(), second_axis = Vec3::UnitY();
  // Its slide (prismatic) or turn (any other) is prescribed: drive_sign times the law of second seen from first.
  bool driven = false;
  double drive_sign = 1.0;

  // Its free numbers among those of all tree joints: slides first, then turns. A ball has four positions and three speeds.
  int first_position = 0, positions = 0;
  int first_speed = 0, speeds = 0;
  // How many of its positions are slides [m].
  int slide_positions() const { return slides[0] + slides[1] + slides[2] - (driven && turns == Turns::none ? 1 : 0); }
};

class SpanningTree {
 public:
  // with_clearance: joints with clearance are opened. Driven and fixed joints are cut only where they close a loop among
  // themselves, opened ones wherever they can be; otherwise the paths to the ground are kept short.
  SpanningTree(const Mechanism& mechanism, bool with_clearance);

  // One per body: parents before what they carry, and one branch after the other.
  const std::vector<TreeJoint>& joints() const { return joints_; }
  int bodies() const { return static_cast<int>(joints_.size()); }
  int positions() const { return positions_; }
  int speeds() const { return speeds_; }
  // The next free speed towards the ground, -1 if there is none. It is the smaller of the two.
  const std::vector<int>& speed_parent() const { return speed_parent_; }
  // Last free speed on the body's path from the ground; -1 if there is none.
  int last_speed(int body) const { return body == kGround ? -1 : last_speed_[body]; }

  // Joints of the mechanism that the tree does not enforce, or not wholly: their rows close the loops.
  const std::vector<int>& cut_joints() const { return cut_; }

 private:
  void choose(const Mechanism& mechanism, bool with_clearance);
  void order_by_branch();
  void number();

  std::vector<TreeJoint> joints_;
  std::vector<int> speed_parent_, last_speed_, cut_;
  int positions_ = 0, speeds_ = 0;
};

}  // namespace boresight
