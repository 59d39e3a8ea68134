// The worst that offsets can displace by where redundant joints tie them together, bounded from above: the largest |G z| with all offsets
// S_c z + s_c in their joints' gaps, at one instant.
//
// A gap is made of parts xi_k that do not hang on one another (gap_part.hpp). The deviation puts them at xi = D z + d. With any multipliers
// L for which L D = G,
//
//     |G z| = |sum_k L_k (xi_k - d_k)| <= sum_k max |L_k xi_k| + |L d|
//
// (weak duality: Rockafellar 1970, Convex Analysis, section 30). Offsets that are all free have one L only, and the bound is that of
// envelope.cpp. Here there are many, and the least bound is sought by least squares over and over, each multiplier weighed by what it came
// to before over the width of its gap (iteratively reweighted least squares: Lawson 1961; Bjorck 1996, 4.5). Whatever multipliers that
// ends with, the bound holds; the least one met is taken.
#pragma once

#include <array>
#include <vector>

#include "boresight/scene/resting_start.hpp"

namespace boresight {

class TiedGaps {
 public:
  using Gain = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  static constexpr int kQuantities = 4;  // that are bounded side by side

  // The gaps of one instant: of each joint where it rests.
  void take(const RestingBalance& balance, const std::vector<RestingPlay>& rest);

  // Of G = gain: 3 x n. quantity: which of those side by side; its search goes on from the instant before. Throws ComputationError where the
  // gaps do not limit it.
  double bound(const Gain& gain, int quantity);
  // Of the last bound: a deviation within the gaps that displaces by as much as this search finds, on the side of `towards` (3).
  VecX place(const Gain& gain, const Vec3& towards) const;

 private:
  // Coordinates of parts that the width of one gap limits together.
  struct Group {
    std::vector<int> rows;
    double width;  // [m]
  };
  Gain multipliers(const Gain& gain, const VecX& weight) const;
  double bound_by(const Gain& multipliers) const;
  void weigh(const Gain& multipliers, VecX& weight) const;

  std::vector<GapPart> parts_;
  std::vector<Group> groups_;
  MatX D_;             // 3 parts x n
  VecX d_;             // 3 parts
  VecX out_of_width_;  // per row: 1 / its gap's width [1/m]
  std::array<VecX, kQuantities> weight_;
  Gain last_;
};

}  // namespace boresight
