// The search for where journals rest where Newton's method with the contacts' own stiffness does not get there: stiffness by differences,
// damped where a step does not pay (Levenberg 1944, Quarterly of Applied Mathematics 2, 164-168). While a journal crosses its clearance
// nothing gets better yet, so that a step is held against the worst of the last few.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "boresight/math/dense_solves.hpp"
#include "boresight/math/types.hpp"

namespace boresight {

// Where a journal rests, to be called so, in clearances; and where it is still taken: a hundredth of what a contact is pressed in by that
// gives way by a thousandth of its clearance.
inline constexpr double kSettledRest = 1e-8, kAcceptableRest = 1e-5;
// What may be left unbalanced of the load.
inline constexpr double kAcceptableLoad = 1e-8;
// Of an energy, which loads and clearances make: what rounding leaves of it.
inline constexpr double kRoundedEnergy = 1e-14;
// Stiffness below this share of the largest holds nothing.
inline constexpr double kSoftContact = 1e-11;

// left(z): what is unbalanced with the journals at z [N, N m]. unit: z = unit y, with y in clearances (RestingBalance::unit). z: from where;
// then the best place met. Returns the length of the full step left there, in clearances.
template <typename Left>
double search_rest(Left&& left_at, const MatX& unit, VecX& z) {
  constexpr int kMost = 200, kLast = 4;
  constexpr double kReach = 0.5;  // of the clearances, at once: beyond, the contacts are others
  constexpr double kDifference =
      1e-6;  // of the clearances: rounding leaves 1e-10 of the stiffness, contact's curvature 1e-5
  const auto by_differences = [&](const VecX& at) {
    MatX H(at.size(), at.size());
    for (Eigen::Index k = 0; k < at.size(); ++k) {
      const VecX by = kDifference * unit.col(k), up = left_at(VecX(at + by));
      H.col(k) = unit.transpose() * (up - left_at(VecX(at - by))) / (2.0 * kDifference);
    }
    return H;
  };
  VecX load = unit.transpose() * left_at(z), best = z;
  std::deque<double> last = {load.norm()};
  double damping = 0.0, shortest = std::numeric_limits<double>::infinity();
  MatX H = by_differences(z);
  for (int step = 0; step < kMost && shortest > kSettledRest; ++step) {
    VecX dx;  // in clearances
    if (damping == 0.0) {
      dx = solve_least(-H, load, kDifference);
      if (const double length = dx.norm(); length < shortest) {
        shortest = length;
        best = z;
      }
    } else {
      dx = solve_square(MatX(damping * MatX::Identity(H.rows(), H.cols()) - H), load);
    }
    const double length = dx.norm();
    if (!std::isfinite(length)) break;
    if (length > kReach) dx *= kReach / length;
    const VecX to = z + unit * dx, there = unit.transpose() * left_at(to);
    const double stiffest = H.diagonal().cwiseAbs().maxCoeff();
    if (there.norm() <= *std::max_element(last.begin(), last.end())) {
      z = to;
      load = there;
      last.push_back(there.norm());
      if (last.size() > kLast) last.pop_front();
      damping = damping > 1e-9 * stiffest ? 0.1 * damping : 0.0;
      H = by_differences(z);
    } else {
      damping = damping == 0.0 ? 1e-6 * stiffest : 10.0 * damping;
      if (!(damping <= 1e3 * stiffest)) break;
    }
  }
  z = best;
  return shortest;
}

}  // namespace boresight
