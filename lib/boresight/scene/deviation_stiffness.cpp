#include "boresight/scene/deviation_stiffness.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/shared_reactions.hpp"

namespace boresight {
namespace {

// Truncation grows with its square, rounding (1e-13 of the accelerations) falls with it: they meet near this, in m and rad.
constexpr double kDisplacement = 1e-5;

}  // namespace

MatX deviation_stiffness(const Mechanism& mechanism, const IdealMotion& ideal, const Parameters& parameters,
                         DeviationCoordinates& coordinates, const IdealState& state, const MatX& T, const MatX& AC,
                         const VecX& r, const VecX& near) {
  const auto formulation = make_tree_formulation(mechanism, parameters, &ideal, {});
  formulation->forces().replace_contact(
      SharedReactions(OffsetLayout(mechanism), parameters, coordinates.offsets_per_coordinate(T)).of(r, near));
  const std::vector<ContactMemory> memory(mechanism.clearances());
  const int n = coordinates.count();
  MatX acceleration(n, n), rate(n, n), place(n, n);
  for (int j = 0; j < n; ++j) {
    VecX z_ddot[2], z_dot[2], z[2];
    for (int side : {0, 1}) {
      IdealState displaced = state;
      for (int b = 0; b < mechanism.bodies(); ++b) {
        const Vec6 by = (side == 0 ? -kDisplacement : kDisplacement) * T.block<6, 1>(6 * b, j);
        displace(displaced.bodies[b], by);
      }
      VecX y;
      formulation->start(displaced, y);
      formulation->stabilise(state.t, y);
      VecX dy(y.size());
      formulation->derivative(state.t, y, memory, dy);
      const std::vector<BodyMotion> bodies = formulation->bodies(state.t, y);
      coordinates.coordinate_accelerations(bodies, formulation->acceleration(), z_ddot[side]);
      coordinates.coordinate_rates(bodies, z_dot[side], z[side]);
    }
    acceleration.col(j) = z_ddot[1] - z_ddot[0];
    rate.col(j) = z_dot[1] - z_dot[0];
    // Turns may jump by a full turn between the two.
    place.col(j) = (z[1] - z[0]).unaryExpr([](double d) { return std::remainder(d, 2.0 * std::numbers::pi); });
  }
  return -(acceleration + AC * rate) * place.inverse();
}

}  // namespace boresight
