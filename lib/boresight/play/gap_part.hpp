// The room that an insert has in its seat, as parts that do not hang on one another: what the envelope rung looks for the worst
// place in.
#pragma once

#include "boresight/play/play_motion.hpp"

namespace boresight {

// A cylinder about the joint's axis (a disc where `axial` is 0, a line where `radial` is), a ball, two cones with one base about it, or an octahedron
// with its tips on the part's three axes.
struct GapPart {
  enum class Shape { cylinder, ball, double_cone, octahedron };
  Eigen::Matrix<double, kMostOffsets, 3> offset;  // the joint's offsets per unit of x y z inside the part
  double
      radial = 0.0,
      axial =
          0.0;  // the part's radius and half length [m]; a ball's radius is `radial`, so are an octahedron's tips on x and z
  Shape shape = Shape::cylinder;
};

}  // namespace boresight
