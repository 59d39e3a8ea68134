#include "boresight/scene/riding_masses.hpp"

#include "boresight/formulations/force_elements.hpp"
#include "boresight/math/cross_matrix.hpp"

namespace boresight {

std::vector<std::vector<RidingMass>> riding_masses(const Mechanism& mechanism, const Parameters& parameters) {
  const MechanismDescription& m = mechanism.description();
  std::vector<std::vector<RidingMass>> groups;
  std::vector<RidingMass> fixed;
  for (int b = 0; b < mechanism.bodies(); ++b) fixed.push_back({.body = b, .inertia = m.bodies[b].inertia});
  groups.push_back(std::move(fixed));
  for (int b = 0; b < mechanism.bodies(); ++b) {
    const BodyDescription& body = m.bodies[b];
    groups.push_back(
        {{.body = b, .c = body.axes.transpose() * (parameters.body_center[b] - body.center_of_mass), .mass = 1.0}});
  }
  if (m.payload) {
    const BodyDescription& carrier = m.bodies[m.payload->body];
    groups.push_back({{.body = m.payload->body,
                       .c = carrier.axes.transpose() * (parameters.payload_center - carrier.center_of_mass),
                       .mass = 1.0,
                       .inertia = m.payload->gyration.array().square().matrix().asDiagonal()}});
  }
  return groups;
}

double units_of(std::size_t group, const Mechanism& mechanism, const Parameters& parameters) {
  const int body = static_cast<int>(group) - 1;
  return group == 0 ? 1.0 : body < mechanism.bodies() ? parameters.body_mass[body] : parameters.payload_mass;
}

Eigen::Matrix<double, 3, Eigen::Dynamic> gain_of_centre(const RidingMass& mass, const BodyMotion& body, const MatX& T) {
  return T.middleRows<3>(6 * mass.body) - cross_matrix(body.R * mass.c) * T.middleRows<3>(6 * mass.body + 3);
}

void add_load(const RidingMass& e, const IdealState& state, const MatX& T, double* r, double* per_gravity) {
  const Eigen::Index n = T.cols();
  const BodyMotion& body = state.bodies[e.body];
  const BodyAcceleration& a = state.acceleration[e.body];
  const Vec3 c = body.R * e.c, w = body.w, alpha = a.tail<3>();
  const auto T_w = T.middleRows<3>(6 * e.body + 3);
  const Mat3 I = body.R * e.inertia * body.R.transpose();
  const Eigen::Matrix<double, 3, Eigen::Dynamic> T_c = gain_of_centre(e, body, T);
  const Vec3 a_c = a.head<3>() + alpha.cross(c) + w.cross(w.cross(c));
  Eigen::Map<VecX>(r, n) -= e.mass * T_c.transpose() * a_c + T_w.transpose() * (I * alpha + w.cross(I * w));
  Eigen::Map<MatX>(per_gravity, n, 3) += e.mass * T_c.transpose();
}

void add_load_of_forces(const Mechanism& mechanism, const Parameters& parameters, const IdealState& state,
                        const MatX& T, VecX& r) {
  if (mechanism.description().springs.empty() && mechanism.description().loads.empty()) return;
  ForceElements forces(mechanism, parameters, false);
  std::vector<Vec6> wrench(mechanism.bodies(), Vec6::Zero());
  forces.apply(state.t, state.bodies, {}, wrench);
  for (int b = 0; b < mechanism.bodies(); ++b) r += T.middleRows<6>(6 * b).transpose() * wrench[b];
}

}  // namespace boresight
