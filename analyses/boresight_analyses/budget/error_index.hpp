// The error indices of ECSS-E-ST-60-10C (2008), 3.2.6 to 3.2.11, straight from a sampled history e(t) of the error vector:
//
//   APE  absolute performance error         e(t)
//   MPE  mean performance error             mean of e over a window
//   RPE  relative performance error         e(t) less the mean over a window that t lies in
//   PDE  performance drift error            mean over a later window less that over an earlier one, in one observation
//   PRE  performance reproducibility error  the same, the two windows in different observations
//
// All are linear in e, so the index of a sum of errors is the sum of their indices.
#pragma once

#include <string>
#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

enum class ErrorIndex { ape, mpe, rpe, pde, pre };
inline constexpr ErrorIndex kErrorIndices[] = {ErrorIndex::ape, ErrorIndex::mpe, ErrorIndex::rpe, ErrorIndex::pde,
                                               ErrorIndex::pre};
const char* to_string(ErrorIndex index);  // "APE"
const char* title_of(ErrorIndex index);   // "absolute performance error"

// The error vector at times spacing apart (error_vector of pointing/indices.hpp); each value stands for one spacing.
struct PointingHistory {
  double spacing = 0.0;  // [s]
  std::vector<Vec3> error;

  double duration() const { return spacing * static_cast<double>(error.size()); }
};

// Times [s]; 0: not given.
struct Windows {
  double window = 0.0;       // over which MPE, RPE, PDE and PRE take their means
  double separation = 0.0;   // of the two windows of PDE, from beginning to beginning
  double observation = 0.0;  // the motion is cut into observations of this length; 0: it is one
  double revisit = 0.0;      // of the two windows of PRE, from beginning to beginning; 0: one observation
  double start = 0.0;        // of the history, after the beginning of the motion

  double observation_in(double duration) const { return observation > 0.0 ? observation : duration; }
  double revisit_after() const { return revisit > 0.0 ? revisit : observation; }
  // From the beginning of an index' first window to that of its second one; 0: it has one.
  double apart(ErrorIndex index) const {
    if (index == ErrorIndex::pde) return separation;
    return index == ErrorIndex::pre ? revisit_after() : 0.0;
  }
  // Whether a history of this length has the index; if not, what is missing, in a few words.
  std::string missing_for(ErrorIndex index, double duration) const;
};

// Every value that the index takes in the history: APE one per sample; MPE, PDE, PRE one per place of the (first)
// window; RPE one per place of the window and sample in it. The instants of RPE are those of the samples, moved by at most half a spacing along
// the window's own straight line, from place to place elsewhere and to either end of it: what drifts has its whole size, and all of
// it is linear in e still. Windows do not cross from one observation into the next.
// They begin at every sample, for RPE at every sixteenth of a window (of histories of more than 25,000 samples at fewer places). Throws std::invalid_argument where missing_for() has
// something to say.
std::vector<Vec3> index_values(ErrorIndex index, const PointingHistory& history, const Windows& windows);

}  // namespace boresight
