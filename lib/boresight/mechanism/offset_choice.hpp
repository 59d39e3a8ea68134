// Which offsets of the joints with play are coordinates of what the opened mechanism can do, and which follow others or stay zero.
//
// Preferred are the released rows of the clearance joints, then coordinates of other joints (turns, slides), where the ideal mechanism has
// freedoms that nothing drives. Of joints that hang together the first gives its offsets, as many as are independent: that choice is good
// in every pose. Where redundant joints hold an offset that its clearance would release (a planar loop in space, the other bearing of a
// shaft), the offset is no coordinate.
#pragma once

#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/joint_rows.hpp"
#include "boresight/mechanism/offset_layout.hpp"

namespace boresight {

struct OffsetChoice {
  // Where an offset of OffsetLayout comes from: its coordinate, or one of these.
  static constexpr int kSlides = -1;     // it is no offset
  static constexpr int kDependent = -2;  // it follows from the coordinates

  struct Chosen {
    int constraint;  // of rows_that_may_be_chosen()
    int row;
  };
  std::vector<Chosen> chosen;  // a coordinate each, those that are no offsets last
  std::vector<int> source;     // per offset of OffsetLayout
  int leftover = 0;            // coordinates that are no offsets
  bool all = false;            // all rows, released ones included, are as many as the bodies' freedoms, and independent
  bool has_dependent = false;

  // Which released rows of a clearance are no coordinates.
  std::vector<bool> dependent_rows(const OffsetLayout& layout, int clearance) const;
};

// Released rows per clearance, then free rows per joint.
std::vector<JointConstraint> rows_that_may_be_chosen(const Mechanism& mechanism);

// Chosen at an instant of no symmetry. Throws ComputationError where no joint's coordinates describe what the mechanism can do.
OffsetChoice choose_offsets(const Mechanism& mechanism, const IdealMotion& ideal);

}  // namespace boresight
