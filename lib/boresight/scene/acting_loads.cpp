#include "boresight/scene/acting_loads.hpp"

#include "boresight/formulations/force_elements.hpp"

namespace boresight {

ActingLoad weight_and_inertia(const MassProperties& body, double gravity, double linear, double turning) {
  const double arm = body.c.norm(), force = body.mass * (linear + arm * turning + gravity);
  return {force, body.inertia.norm() * turning + arm * force};
}

std::vector<ActingLoad> applied_loads(const Mechanism& mechanism, const Parameters& parameters, double t,
                                      const std::vector<BodyMotion>& bodies) {
  std::vector<ActingLoad> loads(bodies.size());
  if (mechanism.description().springs.empty() && mechanism.description().loads.empty()) return loads;
  ForceElements forces(mechanism, parameters, false);
  std::vector<Vec6> wrench(bodies.size(), Vec6::Zero());
  forces.apply(t, bodies, {}, wrench);
  for (std::size_t b = 0; b < loads.size(); ++b) loads[b] = {wrench[b].head<3>().norm(), wrench[b].tail<3>().norm()};
  return loads;
}

void add_to_coordinates(const ActingLoad& load, int body, const MatX& T, VecX& sum) {
  const Eigen::Index row = 6 * static_cast<Eigen::Index>(body);
  for (Eigen::Index j = 0; j < sum.size(); ++j)
    sum[j] += load.force * T.col(j).segment<3>(row).norm() + load.couple * T.col(j).segment<3>(row + 3).norm();
}

double sum_of_acting_loads(const Mechanism& mechanism, const Parameters& parameters, double t,
                           const std::vector<BodyMotion>& bodies, const std::vector<BodyAcceleration>& accelerations) {
  const std::vector<MassProperties> masses = mechanism.mass_properties(parameters);
  const std::vector<ActingLoad> applied = applied_loads(mechanism, parameters, t, bodies);
  const double length = mechanism.characteristic_length();
  double sum = 0.0;
  for (std::size_t b = 0; b < masses.size(); ++b) {
    sum += masses[b].mass * (accelerations[b].head<3>().norm() + parameters.gravity.norm()) + applied[b].force +
           applied[b].couple / length;
  }
  return sum;
}

}  // namespace boresight
