// The ideal joints' reactions on the journals, which contact replaces on the average. They do the work of r on the coordinates:
//
//     B^T f = -r        f: forces and couples on all offsets, B: offsets per coordinate
//
// Where redundant joints tie offsets together, many f do. The least is taken, couples over half a sleeve: it does not hang on which of
// the offsets are coordinates, which is the drawing's choice.
#pragma once

#include <vector>

#include "boresight/math/orthogonal_factors.hpp"
#include "boresight/mechanism/offset_layout.hpp"
#include "boresight/play/play_motion.hpp"

namespace boresight {

class SharedReactions {
 public:
  // B: layout.size() x n, factored once for all loads of a pose.
  SharedReactions(const OffsetLayout& layout, const Parameters& parameters, MatX B);

  // r: n [N, N m]. Returns for each clearance the loads on its offsets, in the order of OffsetLayout (kMostOffsets, the slopes zero where
  // the journal does not tilt), sleeve axes.
  // near: loads on all offsets, as long [N, N m]: of the many, those that differ least from these; empty: the least.
  std::vector<PlayOffsets> of(const VecX& r, const VecX& near = VecX()) const;

 private:
  OffsetLayout layout_;
  MatX B_;
  VecX length_;  // that makes forces of the loads on all offsets; 0: none is carried there
  Eigen::CompleteOrthogonalDecomposition<MatX> least_;
};

}  // namespace boresight
