// Where loads tip journals over (tipping.hpp): from a balance that is a saddle of the energy down to one that is none.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "boresight/scene/rest_search.hpp"
#include "boresight/scene/resting_start.hpp"

namespace boresight {

VecX RestingBalance::steepest_way(const MatX& by_z) const {
  constexpr double kFalls = 1e-4;  // of the loads' stiffness: less is what differences leave of none
  const MatX H = -(unit_.transpose() * by_z * unit_);
  const Eigen::SelfAdjointEigenSolver<MatX> bowl(MatX(0.5 * (H + H.transpose())));
  if (!(bowl.eigenvalues()[0] < -kFalls * (unit_.transpose() * stiffness_ * unit_).norm())) return {};
  return unit_ * bowl.eigenvectors().col(0);
}

double RestingBalance::off_the_saddle(VecX& z, double size_left) const {
  constexpr double kStep = 0.5;  // in clearances
  for (int saddle = 0; saddle < at_.n && z.allFinite(); ++saddle) {
    VecX F;
    MatX J;
    evaluate(z, F, J);
    const VecX away = steepest_way(J);
    if (away.size() == 0) break;
    VecX best = z;
    double least = energy(z), left_best = size_left;
    for (const double side : {1.0, -1.0}) {
      VecX there = z + side * kStep * away;
      const double left_there = descend(there, 0.0, true);
      const double E = energy(there);
      if (there.allFinite() && E < least - kRoundedEnergy * (std::abs(E) + load_)) {
        best = there;
        least = E;
        left_best = left_there;
      }
    }
    if (best == z) break;
    z = best;
    size_left = left_best;
  }
  return size_left;
}

}  // namespace boresight
