// The ideal joints' reactions on the journals, which contact replaces on the average. They do the work of r on the coordinates:
//
//     B^T f = -r        f: forces and couples on all offsets, B: offsets per coordinate
//
// Where redundant joints tie offsets together, many f do. The least is taken, couples over half a sleeve: it does not hang on which of
// the offsets are coordinates, which is the drawing's choice.
#pragma once

#include <vector>

#include "boresight/mechanism/offset_layout.hpp"
#include "boresight/play/play_motion.hpp"

namespace boresight {

// B: layout.size() x n, r: n [N, N m]. Returns for each clearance the loads on its offsets, in the order of OffsetLayout (kMostOffsets,
// the slopes zero where the journal does not tilt), sleeve axes.
// near: loads on all offsets, as long [N, N m]: of the many, those that differ least from these; empty: the least.
std::vector<PlayOffsets> shared_reactions(const OffsetLayout& layout, const Parameters& parameters, const MatX& B,
                                          const VecX& r, const VecX& near = VecX());

}  // namespace boresight
