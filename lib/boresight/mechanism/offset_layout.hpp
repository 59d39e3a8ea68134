// The offsets of all joints with play in one vector, joint after joint: the x y z of the journal's or ball's centre in the axes of its
// seat [m], then, where a journal may tilt (axes = "free"), the slopes x z of its axis [-]. The y of a joint that
// slides along its axis keeps its place in the vector, though it is no offset.
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
      joint.slides = slides_along_axis(type);
      joint.spins = joint.tilts || !keeps_axis(type) ? 3 : 1;
      size_ += joint.count();
      joints_.push_back(joint);
    }
  }

  struct Joint {
    int first = 0;
    bool tilts = false;   // five offsets, else three
    bool slides = false;  // y is no offset
    int spins = 1;        // components of the relative spin that its contacts see: y, or x y z
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
