// One right-hand side for every scalar: with automatic derivatives it gives what differences of doubles give.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/play/journal/journal_in_sleeve.hpp"
#include "boresight/scene/offset_dynamics.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "scenes.hpp"

namespace boresight {
namespace scalars_test {

// Numbers of a sample, and the state, as one list: stiffness, clearance, friction, damping, then z and zdot.
template <typename T>
std::vector<T> accelerations(const Mechanism& mechanism, const SceneTables& tables, const std::vector<double>& row,
                             const std::vector<T>& x) {
  const JournalInSleeve joint(mechanism.description().clearances[0], JointType::revolute,
                              mechanism.parameters().clearance[0]);
  JournalInSleeveT<T> law;
  law.tilts = law.tilted.has_faces = joint.tilts;
  law.radial_clearance = law.axial_clearance = x[1];
  law.bore_radius = T(joint.bore_radius);
  law.half_length = T(joint.half_length);
  law.radial_law = {x[0], x[3]};
  law.face_stiffness = T(joint.face_stiffness);
  law.friction = {x[2], T(joint.friction.static_speed), T(joint.friction.dynamic_speed)};
  law.tilted.radial_clearance = law.tilted.axial_clearance = x[1];
  law.tilted.bore_radius = law.bore_radius;
  law.tilted.half_length = law.half_length;
  law.tilted.ring_radius = T(joint.tilted.ring_radius);
  law.tilted.end_law = {T(0.5) * x[0], x[3]};
  law.tilted.face_stiffness = law.face_stiffness;
  law.tilted.friction = law.friction;
  const SceneLayout& at = tables.layout;
  const T *z = x.data() + 4, *rate = z + at.n;
  std::vector<T> force(at.n, T(0.0)), acceleration(at.n);
  std::array<T, kContactPlaces> impact_speed;
  impact_speed.fill(T(0.02));
  PlayWrench<T> wrench;
  const PlayMotion<T> motion = play_motion(at, at.joints[0], row.data(), z, rate);
  law.wrench(motion, impact_speed, wrench);
  add_generalised_force(at, at.joints[0], row.data(), motion, wrench, force.data());
  coordinate_acceleration(at, row.data(), z, rate, force.data(), acceleration.data());
  return acceleration;
}

template <int n>
void expect_exact_derivatives(JournalAxes axes, const std::array<double, 2 * n>& state) {
  MechanismDescription d = scenes::rrcpr({{"motion.duration", "0.1 s"}, {"clearance.F1.sleeve_length", "120 mm"}});
  d.clearances[0].axes = axes;
  const auto mechanism = scenes::build(std::move(d));
  const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, mechanism->parameters()), mechanism->parameters());
  const auto tables = prepared.tables(mechanism->parameters());
  std::vector<double> row(tables->dynamics.width());
  tables->dynamics.at(0.037, row.data());

  constexpr int kInputs = 4 + 2 * n;
  using Jet = ceres::Jet<double, kInputs>;
  std::vector<double> x = {6.5e10, 1e-4, 0.03, 0.1778};
  x.insert(x.end(), state.begin(), state.end());
  std::vector<Jet> jets;
  for (int i = 0; i < kInputs; ++i) jets.emplace_back(x[i], i);
  const std::vector<Jet> exact = accelerations(*mechanism, *tables, row, jets);
  const std::vector<double> value = accelerations(*mechanism, *tables, row, x);
  // But for the order in which a compiler rounds.
  for (int k = 0; k < n; ++k) EXPECT_NEAR(exact[k].a, value[k], 1e-14 * std::abs(value[k]));
  for (int i = 0; i < kInputs; ++i) {
    // Richardson's extrapolation of central differences.
    const double h = 1e-4 * std::abs(x[i]);
    const auto central = [&](double step) {
      std::vector<double> plus = x, minus = x;
      plus[i] += step;
      minus[i] -= step;
      const std::vector<double> a = accelerations(*mechanism, *tables, row, plus),
                                b = accelerations(*mechanism, *tables, row, minus);
      VecX difference(n);
      for (int k = 0; k < n; ++k) difference[k] = (a[k] - b[k]) / (2.0 * step);
      return difference;
    };
    const VecX richardson = (4.0 * central(0.5 * h) - central(h)) / 3.0;
    for (int k = 0; k < n; ++k)
      EXPECT_NEAR(exact[k].v[i], richardson[k], 1e-6 * richardson.norm() + 1e-9 * std::abs(value[k] / x[i]))
          << i << ", " << k;
  }
}

TEST(OffsetDynamics, HasExactDerivativesThroughJets) {
  // In radial and axial contact, sliding.
  expect_exact_derivatives<3>(JournalAxes::parallel, {1.05e-4, -1.003e-4, 3e-5, 0.01, 0.02, -0.03});
  // Both ends and a cap on part of its rim.
  expect_exact_derivatives<5>(JournalAxes::free, {2e-5, -0.9e-4, 1e-5, 1.6e-3, 0.4e-3, 0.01, 0.02, -0.03, 0.2, -0.1});
}

}  // namespace scalars_test
}  // namespace boresight
