// Dual numbers give the derivatives that Ceres' jets give, of the contact law itself.
#include "boresight/math/dual.hpp"

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "boresight/play/journal/journal_in_sleeve.hpp"
#include "scenes.hpp"

namespace boresight {
namespace dual_test {

template <typename M, typename Law>
PlayWrench<M> wrench_of(const Law& law, const std::array<double, 13>& x) {
  PlayMotion<M> m;
  for (int k = 0; k < 3; ++k) {
    m.e[k] = M(x[k], k);
    m.e_dot[k] = M(x[3 + k], 3 + k);
    m.w[k] = M(x[6 + k], 6 + k);
  }
  for (int k = 0; k < 2; ++k) {
    m.slope[k] = M(x[9 + k], 9 + k);
    m.slope_rate[k] = M(x[11 + k], 11 + k);
  }
  PlayWrench<M> out;
  using T = std::remove_cvref_t<decltype(law.radial_clearance)>;
  std::array<T, kContactPlaces> speed;
  speed.fill(T(0.02));
  law.wrench(m, speed, out);
  return out;
}

void expect_derivatives_of_jets(bool tilts, const std::array<double, 13>& x) {
  MechanismDescription d = scenes::rrcpr();
  d.clearances[0].axes = tilts ? JournalAxes::free : JournalAxes::parallel;
  const JournalInSleeve law(d.clearances[0], JointType::revolute, d.clearances[0].parameters);
  using Jet = ceres::Jet<double, 13>;
  JournalInSleeveT<Jet> constant;
  constant.radial_clearance = Jet(law.radial_clearance);
  constant.axial_clearance = Jet(law.axial_clearance);
  constant.bore_radius = Jet(law.bore_radius);
  constant.half_length = Jet(law.half_length);
  constant.radial_law = law.radial_law.cast<Jet>();
  constant.face_stiffness = Jet(law.face_stiffness);
  constant.friction = law.friction.cast<Jet>();
  constant.tilts = law.tilts;
  constant.tilted.radial_clearance = constant.radial_clearance;
  constant.tilted.axial_clearance = constant.axial_clearance;
  constant.tilted.bore_radius = constant.bore_radius;
  constant.tilted.half_length = constant.half_length;
  constant.tilted.ring_radius = Jet(law.tilted.ring_radius);
  constant.tilted.end_law = law.tilted.end_law.cast<Jet>();
  constant.tilted.face_stiffness = constant.face_stiffness;
  constant.tilted.friction = constant.friction;
  const auto jets = wrench_of<Jet>(constant, x);
  const auto duals = wrench_of<Dual<double, 13>>(static_cast<const JournalInSleeveT<double>&>(law), x);
  double largest = 0.0;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 13; ++i) {
      const double scale = std::abs(jets.force[k].v[i]) + 1e-9;
      EXPECT_NEAR(duals.force[k].v[i], jets.force[k].v[i], 1e-10 * scale) << k << ", " << i;
      EXPECT_NEAR(duals.moment[k].v[i], jets.moment[k].v[i], 1e-10 * (std::abs(jets.moment[k].v[i]) + 1e-9))
          << k << ", " << i;
      largest = std::max(largest, std::abs(jets.force[k].v[i]));
    }
  EXPECT_GT(largest, 1.0);
}

TEST(Dual, GivesTheDerivativesOfJetsForAParallelJournal) {
  expect_derivatives_of_jets(false, {1.05e-4, -1.003e-4, 3e-5, 0.01, 0.02, -0.03, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0});
}

TEST(Dual, GivesTheDerivativesOfJetsForAJournalThatTilts) {
  expect_derivatives_of_jets(true, {6e-5, -0.9e-4, 5e-5, 0.01, 0.02, -0.03, 0.3, 2.0, -0.2, 2e-3, -1e-3, 0.2, -0.1});
}

// Where another lane is in contact, one that hangs concentric and at rest is computed with it.
TEST(Dual, IsFiniteForAJournalAtRestInTheMiddle) {
  const MechanismDescription d = scenes::rrcpr();
  const JournalInSleeve law(d.clearances[0], JointType::revolute, d.clearances[0].parameters);
  const auto out = wrench_of<Dual<double, 13>>(static_cast<const JournalInSleeveT<double>&>(law), {});
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 13; ++i) EXPECT_TRUE(std::isfinite(out.force[k].v[i]) && std::isfinite(out.moment[k].v[i]));
}

}  // namespace dual_test
}  // namespace boresight
