// How stiff the contacts of one joint with play are where they stand, as columns n with tangent stiffness = sum n n^T over the
// joint's offsets (PlayOffsets).
#pragma once

#include <array>

#include "boresight/play/play_motion.hpp"

namespace boresight {

struct ContactTangent {
  struct Column {
    ContactPlace place;
    PlayOffsets n;  // what an insert cannot do is zero: a parallel journal's slopes
  };
  int count = 0;
  std::array<Column, 16> column;

  void add(ContactPlace place, const PlayOffsets& n) { column[static_cast<std::size_t>(count++)] = {place, n}; }
};

}  // namespace boresight
