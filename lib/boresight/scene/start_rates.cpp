#include "boresight/scene/start_rates.hpp"

#include "boresight/math/dense_solves.hpp"

namespace boresight {

MatX start_rates(const Mechanism& mechanism, const Parameters& parameters, const IdealState& ideal, const MatX& T,
                 const MatX& T_rate) {
  const Eigen::Index n = T.cols();
  const std::vector<MassProperties> mass = mechanism.mass_properties(parameters);
  MatX MT(T.rows(), n), change = T_rate;
  for (std::size_t b = 0; b < mass.size(); ++b) {
    const auto at = static_cast<Eigen::Index>(6 * b);
    const Mat3& R = ideal.bodies[b].R;
    const Vec3 c = R * mass[b].c, w = ideal.bodies[b].w;
    for (Eigen::Index k = 0; k < n; ++k) {
      const Vec3 v = T.block<3, 1>(at, k), turn = T.block<3, 1>(at + 3, k);
      const Vec3 push = mass[b].mass * (v + turn.cross(c));
      MT.block<3, 1>(at, k) = push;
      MT.block<3, 1>(at + 3, k) = R * (mass[b].inertia * (R.transpose() * turn)) + c.cross(push);
      change.block<3, 1>(at + 3, k) += turn.cross(w);
    }
  }
  return -solve_symmetric(MatX(MT.transpose() * T), MatX(MT.transpose() * change));
}

}  // namespace boresight
