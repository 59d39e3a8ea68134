#include "boresight/contact/normal_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "boresight/contact/hertz.hpp"
#include "boresight/contact/impact.hpp"
#include "boresight/contact/modified_coulomb.hpp"
#include "reference/reference.hpp"

namespace boresight {
namespace normal_law_test {

// A mass on one contact with the law's damping factor, approaching at 1 m/s: depths relative to the undamped impact's.
Impact impact_of(double e, const char* name) {
  const NormalLaw law{1e9, normal_law(name).damping_factor(e)};
  Impact result = impact(law, 1.0, 1.0, 20000);
  result.depth /= std::pow(5.0 / (4.0 * law.stiffness), 0.4);
  return result;
}

// Closed forms of the whole Hunt-Crossley family (tests/reference/contact_laws.py): restitution returned, and depth relative to the
// undamped impact, K d^(n+1) / ((n+1) m v^2) = (1/h) (1 - ln(1 + h) / h).
TEST(FloresLaw, GivesTheRestitutionThatTheoryForesees) {
  const double asked[] = {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99};
  const reference::Row returned = reference::named("contact_laws", "returned", "flores");
  for (std::size_t k = 0; k < std::size(asked); ++k)
    EXPECT_NEAR(impact_of(asked[k], "flores").restitution, returned[k], 2e-5) << asked[k];
}

TEST(FloresLaw, ReachesTheDepthThatTheoryForesees) {
  int held = 0;
  for (const reference::Row& row : reference::table("contact_laws", "shape")) {
    if (row.name != "flores") continue;
    ++held;
    EXPECT_NEAR(impact_of(row[0], "flores").depth, row[1], 2e-6) << row[0];
  }
  EXPECT_EQ(held, 4);
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
  for (const reference::Row& row : reference::table("contact_laws", "stiffness")) {
    p.radial = row[0];
    p.journal_radius = 10e-3 - row[0];
    EXPECT_NEAR(radial_hertz_stiffness(p) / row[1], 1.0, 1e-6);
  }
}

// 1/E = 0.9375/200 GPa + 0.84/70 GPa, whichever of the two is the journal.
TEST(Hertz, ModulusTakesTheNumbersOfEachMaterialTogether) {
  ContactParameters c;
  c.young = {200e9, 70e9};
  c.poisson = {0.25, 0.4};
  EXPECT_NEAR(composite_modulus(c), 59.925093632958797e9, 1.0);
  std::swap(c.young[0], c.young[1]);
  std::swap(c.poisson[0], c.poisson[1]);
  EXPECT_NEAR(composite_modulus(c), 59.925093632958797e9, 1.0);
}

// The same steel pair at 0.5 and 0.1 mm: depth under a load, (F / K)^(2/3); a journal of 1 kg at rest in the bottom of its bearing
// bounces at sqrt(1.5 g / depth).
TEST(Hertz, DepthUnderALoadAndBounceOfAJournalAtRest) {
  for (const double K : {6.610198e10, 1.508882e11}) {
    const NormalLaw law{K, 0.0};
    for (const double load : {9.81, 10.0, 100.0, 1000.0})
      EXPECT_NEAR(law.depth_under(load) / std::pow(load / K, 2.0 / 3.0), 1.0, 1e-12);
    const double depth = law.depth_under(9.81);
    EXPECT_NEAR(std::sqrt(law.elastic_slope(depth)) / std::sqrt(1.5 * 9.81 / depth), 1.0, 1e-12);
  }
}

// Mass, speed; depth, force and duration of an undamped impact in closed form.
TEST(Hertz, ImpactsAsItsClosedFormSays) {
  const NormalLaw law{6.6102e10, 0.0};
  const auto reference = reference::table("contact_laws", "undamped");
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
  EXPECT_NEAR(v, 1e-4 + 0.9e-3 * std::tan(slope) / 0.5, 1e-9);
}

}  // namespace normal_law_test
}  // namespace boresight
