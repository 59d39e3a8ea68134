// The offsets of all clearance joints in one vector, joint after joint: the journal centre's x y z in sleeve axes [m], then,
// where the journal may tilt (axes = "free"), the slopes x z of its axis [-]. A cylindrical joint's y keeps its place in the
// vector, though it slides freely and is no offset.
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
      joint.tilts = c.axes == JournalAxes::free;
      joint.slides = m.joints[c.joint].type == JointType::cylindrical;
      size_ += joint.count();
      joints_.push_back(joint);
    }
  }

  struct Joint {
    int first = 0;
    bool tilts = false;   // five offsets, else three
    bool slides = false;  // y is no offset
    int count() const { return tilts ? 5 : 3; }
    // Row of an offset among the released constraint rows of its joint (ClearanceRows::released); -1: not released.
    int released_row(int offset) const { return !slides ? offset : offset == 0 ? 0 : offset - 1; }
    bool released(int offset) const { return !(slides && offset == 1); }
  };

  int size() const { return size_; }
  int clearances() const { return static_cast<int>(joints_.size()); }
  const Joint& joint(int clearance) const { return joints_[clearance]; }

 private:
  std::vector<Joint> joints_;
  int size_ = 0;
};

}  // namespace boresight
