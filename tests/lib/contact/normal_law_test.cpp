#include "boresight/contact/normal_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boresight/contact/hertz.hpp"
#include "boresight/contact/impact.hpp"
#include "boresight/contact/modified_coulomb.hpp"

namespace boresight {
namespace {

// A mass on one contact with the law's damping factor, approaching at 1 m/s: depths relative to the undamped impact's.
Impact impact_of(double e, const char* name) {
  const NormalLaw law{1e9, normal_law(name).damping_factor(e)};
  Impact result = impact(law, 1.0, 1.0, 20000);
  result.depth /= std::pow(5.0 / (4.0 * law.stiffness), 0.4);
  return result;
}

// Effective restitution of Flores' law for asked ones: the relation h (1 + e) = ln[(1 + h) / (1 - h e)] that holds for the
// whole Hunt-Crossley family (derived, and confirmed by integration to 1e-12).
TEST(FloresLaw, GivesTheRestitutionThatTheoryForesees) {
  const double asked[] = {0.1, 0.3, 0.5, 0.7, 0.9, 0.99};
  const double effective[] = {0.06944, 0.25621, 0.47044, 0.68318, 0.89392, 0.98934};
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(impact_of(asked[k], "flores").restitution, effective[k], 2e-5) << asked[k];
}

TEST(FloresLaw, ReachesTheDepthThatTheoryForesees) {
  // Relative to the undamped impact, e = 0.9, 0.7 and 0.3: K d^(n+1) / ((n+1) m v^2) = (1/h) (1 - ln(1 + h) / h).
  EXPECT_NEAR(impact_of(0.9, "flores").depth, 0.956737, 2e-6);
  EXPECT_NEAR(impact_of(0.7, "flores").depth, 0.864831, 2e-6);
  EXPECT_NEAR(impact_of(0.3, "flores").depth, 0.628078, 2e-6);
}

TEST(HertzElastic, GivesEverythingBack) {
  EXPECT_NEAR(impact_of(0.5, "hertz").restitution, 1.0, 1e-8);
  EXPECT_NEAR(impact_of(0.5, "hertz").depth, 1.0, 1e-7);
}

TEST(NormalLaw, NeverPulls) {
  const NormalLaw law{1e9, normal_law("flores").damping_factor(0.5)};
  EXPECT_EQ(law.force(1e-5, -10.0, 1e-3), 0.0);  // parting far faster than it came
  EXPECT_EQ(law.force(-1e-5, 1.0, 1.0), 0.0);
  EXPECT_EQ(law.force(0.0, 1.0, 1.0), 0.0);
}

TEST(NormalLaw, StaysFiniteAtTheSmallestRestitutionAndImpactSpeed) {
  const NormalLaw law{1e12, normal_law("flores").damping_factor(1e-6)};
  EXPECT_TRUE(std::isfinite(law.force(1e-3, 10.0, 1e-3)));
}

TEST(Hertz, StiffnessOfTheLiterature) {
  // Steel 207 GPa, 0.3, bearing radius 10 mm (Flores et al. 2006 quote 6.61e10 N/m^1.5 at 0.5 mm).
  ClearanceParameters p;
  p.contact.young = {207e9, 207e9};
  p.contact.poisson = {0.3, 0.3};
  const double clearance[] = {0.5e-3, 0.2e-3, 0.1e-3, 0.05e-3, 0.02e-3, 0.01e-3};
  const double stiffness[] = {6.610198e10, 1.061538e11, 1.508882e11, 2.139263e11, 3.387568e11, 4.793144e11};
  for (int k = 0; k < 6; ++k) {
    p.radial = clearance[k];
    p.journal_radius = 10e-3 - clearance[k];
    EXPECT_NEAR(radial_hertz_stiffness(p) / stiffness[k], 1.0, 1e-6);
  }
}

// The same steel pair at 0.5 and 0.1 mm: depth under a load, (F / K)^(2/3); a journal of 1 kg at rest in the bottom of its bearing
// bounces at sqrt(1.5 g / depth).
TEST(Hertz, DepthUnderALoadAndBounceOfAJournalAtRest) {
  const NormalLaw wide{6.610198e10, 0.0}, narrow{1.508882e11, 0.0};
  EXPECT_NEAR(wide.depth_under(10.0) / 2.83916e-7, 1.0, 1e-5);
  EXPECT_NEAR(wide.depth_under(100.0) / 1.31782e-6, 1.0, 1e-5);
  EXPECT_NEAR(wide.depth_under(1000.0) / 6.11679e-6, 1.0, 1e-5);
  const auto bounce = [](const NormalLaw& law, double depth) {
    EXPECT_NEAR(law.depth_under(9.81) / depth, 1.0, 1e-6);
    return std::sqrt(law.elastic_slope(law.depth_under(9.81)));
  };
  EXPECT_NEAR(bounce(wide, 2.803085e-7) / 7245.393, 1.0, 1e-6);
  EXPECT_NEAR(bounce(narrow, 1.616873e-7) / 9539.865, 1.0, 1e-6);
}

// Mass, speed; depth, force and duration of an undamped impact in closed form.
TEST(Hertz, ImpactsAsItsClosedFormSays) {
  const NormalLaw law{6.6102e10, 0.0};
  const double reference[][5] = {{1.0, 0.1, 8.141008e-6, 1535.436, 2.396123e-4},
                                 {0.1, 1.0, 2.044929e-5, 6112.68, 6.018788e-5},
                                 {1.0, 1.0, 5.136629e-5, 24335.03, 1.511851e-4}};
  for (const auto& r : reference) {
    const Impact hit = impact(law, r[0], r[1], 20000);
    EXPECT_NEAR(hit.depth / r[2], 1.0, 1e-6);
    EXPECT_NEAR(hit.force / r[3], 1.0, 1e-6);
    EXPECT_NEAR(hit.duration / r[4], 1.0, 1e-4);
  }
}

TEST(Hertz, ValiditySpeedOfTheDefaultPair) {
  EXPECT_NEAR(validity_speed(ContactParameters{}), 0.0387, 0.00005);  // Eq. 26 for the default aluminium pair
}

TEST(ModifiedCoulomb, RampsBetweenItsTwoSpeeds) {
  const ModifiedCoulomb law{0.03, 1e-4, 1e-3};
  const auto force = [&](double v) { return v * law.force_per_velocity(v); };
  EXPECT_EQ(force(0.0), 0.0);
  EXPECT_EQ(force(0.99e-4), 0.0);
  EXPECT_NEAR(force(5.5e-4), 0.015, 1e-15);
  EXPECT_NEAR(force(1e-3), 0.03, 1e-15);
  EXPECT_NEAR(force(7.0), 0.03, 1e-15);
}

// On an incline of 20 degrees with mu = 0.5 the law cannot hold: it creeps at v_s + (v_d - v_s) tan 20 / mu.
TEST(ModifiedCoulomb, CreepsUnderAStaticLoadAtTheSpeedThatTheoryForesees) {
  const ModifiedCoulomb law{0.5, 1e-4, 1e-3};
  const double slope = 20.0 * M_PI / 180.0, g = 9.81, h = 1e-6;
  double v = 0.0;
  for (int k = 0; k < 20000; ++k) v += h * (g * std::sin(slope) - g * std::cos(slope) * v * law.force_per_velocity(v));
  EXPECT_NEAR(v, 1e-4 + 0.727940469 * 0.9e-3, 1e-9);
}

}  // namespace
}  // namespace boresight
