// Errors of a fit whose channels have noises of their own, each estimated by what the fit leaves of that channel.
//
// Weights 1 / sigma_c^2 that are estimated make estimates scatter by more than the inverse information says, and make the inverse information
// too small by as much again. With the information H_c of what shares one noise, the prior Q, B = (sum H_c + Q)^-1 and n_c values:
//
//   v_c = sum psi^2 / (n_c - tr B H_c) / mean psi'                                     what is left over what was weighed by
//   K_cd = delta_cd (n_c - 2 tr B H_c) + tr B H_c B H_d                                half the information about ln sigma^2, U = 2 K^-1
//   L = sum_cd U_cd (delta_cd H_c - H_c B H_d)                                         over those that are estimated
//   cov = B (sum v_c H_c + 2 L + Q) B
//   degrees of freedom along z:  2 (z' (sum v_c H_c + Q) z)^2 / (a' U a),  a_c = v_c z' H_c z
//
// Kenward and Roger (1997), Small sample inference for fixed effects from restricted maximum likelihood, Biometrics 53, section 3; L is what
// weights add (Kackar and Harville 1984). v_c and K are of restricted maximum likelihood, which for noises by group is Foerstner (1979).
// With one noise for all it is s^2 H^-1 and Student's with N - k, as elsewhere.
#pragma once

#include <vector>

#include "boresight/math/types.hpp"

namespace boresight {

// Of the largest information of any direction: what is seen less is lost in sums of products.
inline constexpr double kHardlySeen = 1e-9;

// The data's part of one noise.
struct SharedNoise {
  MatX information;  // H_c
  double values = 0.0, psi_square = 0.0, psi_slope = 0.0;
  bool estimated = true;  // false: it was told
};

class ChannelVariances {
 public:
  // seen: B, of what the data see, zero elsewhere. None: one noise for all.
  ChannelVariances() = default;
  ChannelVariances(std::vector<SharedNoise> noises, const MatX& seen, const VecX& prior);

  bool empty() const { return noises_.empty(); }
  // By how much the covariance of the scores is over that of one variance factor for all: sum (v_c - s^2) H_c + 2 L.
  MatX departure(double variance_factor) const;
  // Satterthwaite's degrees of freedom of what changes along z, a column of B; none where nothing is seen along it: `otherwise`.
  double freedom(const VecX& z, double otherwise) const;

 private:
  std::vector<SharedNoise> noises_;
  VecX variance_, prior_;  // v; Q
  MatX uncertainty_;       // U
  MatX weights_;           // L
};

}  // namespace boresight
