// The offsets of all joints with play in one vector, joint after joint: the x y z of the insert's centre (of the journal, ball or pad) in the
// axes of its seat [m], then, where it may tilt (axes = "free"), the slopes x z of its axis [-], then, in a rectangular guide, its roll [rad]. The directions in which a joint slides, y
// along its axis or x and z across it, keep their places in the vector, though they are no offsets.
#pragma once

#include <vector>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

class OffsetLayout {
 public:
  explicit OffsetLayout(const Mechanism& mechanism) {
    const MechanismDescription& m = mechanism.description();
    for (const ClearanceDescription& c : m.clearances) {
      Joint joint;
      joint.first = size_;
      const JointType type = m.joints[c.joint].type;
      joint.tilts = keeps_axis(type) && c.axes == JournalAxes::free;
      joint.rolls = rolls(c, type);
      joint.twists = twists(c, type);
      joint.slides = slides_along_axis(type) ? 1 : type == JointType::planar ? 2 : 0;
      joint.spins = joint.tilts || !keeps_axis(type) ? 3 : 1;
      size_ += joint.count();
      joints_.push_back(joint);
    }
  }

  struct Joint {
    int first = 0;
    bool tilts = false;   // five offsets, else three
    bool rolls = false;   // six
    bool twists = false;  // its contacts turn with the insert about the joint's axis, which is no offset
    int slides = 0;       // directions in which it slides, which are no offsets: one is y, two are x and z
    int spins = 1;        // components of the relative spin that its contacts see: y, or x y z
    int count() const { return rolls ? 6 : tilts ? 5 : 3; }
    // Row of an offset among the released constraint rows of its joint (ClearanceRows::released); -1: not released.
    int released_row(int offset) const {
      int row = 0;
      for (int k = 0; k < offset; ++k) row += released(k) ? 1 : 0;
      return row;
    }
    bool released(int offset) const { return slides == 0 || offset > 2 || (offset == 1) == (slides == 2); }
  };

  int size() const { return size_; }
  int clearances() const { return static_cast<int>(joints_.size()); }
  const Joint& joint(int clearance) const { return joints_[clearance]; }

 private:
  std::vector<Joint> joints_;
  int size_ = 0;
};

}  // namespace boresight
