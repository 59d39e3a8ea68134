// What restitution each law returns when asked for one, and the shape of every law's force.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "boresight/contact/exact_restitution.hpp"
#include "boresight/contact/impact.hpp"
#include "boresight/contact/kelvin_voigt.hpp"
#include "boresight/contact/normal_law.hpp"
#include "reference/reference.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace restitution_test {

constexpr double kAsked[] = {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99};

// From h (1 + e) = ln((1 + h) / (1 - h e)), the relation that holds for the whole family whatever exponent, stiffness, mass and speed
// (tests/reference/contact_laws.py). Lines of Hunt-Crossley, Gonthier and Carvalho-Martins also stand in EXUDYN's
// contactSphereSphereTest (0.90903 at 0.9, 0.66298 at 0.5 for the first; 0.30424 at 0.3, 0.10099 at 0.1 for the second; 0.90002 at 0.9
// for the third).
std::map<std::string, std::vector<double>> returned_by_law() {
  std::map<std::string, std::vector<double>> laws = {{"exact", {std::begin(kAsked), std::end(kAsked)}},
                                                     {"hertz", std::vector<double>(12, 1.0)}};
  for (const reference::Row& row : reference::table("contact_laws", "returned")) laws[row.name] = row.values;
  return laws;
}

TEST(ContactLaws, ReturnTheRestitutionThatTheoryForesees) {
  for (const auto& [name, returned] : returned_by_law()) {
    ASSERT_EQ(returned.size(), std::size(kAsked)) << name;
    for (std::size_t k = 0; k < returned.size(); ++k) {
      const NormalLaw law{1e9, normal_law(name).damping_factor(kAsked[k])};
      EXPECT_NEAR(impact(law, 1.0, 1.0, 3000).restitution, returned[k], 2e-5) << name << " asked for " << kAsked[k];
    }
  }
}

// EXUDYN's contactSphereSphereTest prints what it integrates, of a linear spring (exponent 1) and an impact
// at 10 m/s: the relation does not know the exponent, nor the speed.
TEST(ContactLaws, ReturnWhatExudynPrintsForALinearSpring) {
  struct Row {
    const char* name;
    double asked, returned;
  };
  validation::PrintedTable table("EXUDYN, contactSphereSphereTest", "restitution returned by three laws", 5e-5);
  for (const Row& row :
       {Row{"hunt-crossley", .9, .90903}, Row{"hunt-crossley", .8, .83290}, Row{"hunt-crossley", .5, .66298},
        Row{"hunt-crossley", .3, .58132}, Row{"hunt-crossley", .1, .51586}, Row{"gonthier", .3, .30424},
        Row{"gonthier", .1, .10099}, Row{"carvalho-martins", .9, .90002}, Row{"carvalho-martins", .8, .80002},
        Row{"carvalho-martins", .5, .50018}}) {
    NormalLaw law{1e9, normal_law(row.name).damping_factor(row.asked)};
    law.curve = ElasticCurve::linear;
    table.expect(row.name, row.returned, impact(law, 1.0, 10.0, 3000).restitution);
  }
}

TEST(ContactLaws, EveryLawOfHertzGeometryIsInTheTableOfReturnedRestitutions) {
  const auto returned = returned_by_law();
  for (const NormalLawEntry& law : normal_laws()) {
    if (law.geometry == ContactGeometry::point) {
      EXPECT_EQ(returned.count(law.name), 1u) << law.name;
    }
  }
}

TEST(ExactRestitution, HasTheDampingFactorsOfTheRelation) {
  for (const reference::Row& row : reference::table("contact_laws", "exact factors"))
    EXPECT_NEAR(exact_restitution_damping_factor(row[0]) / row[1], 1.0, 2e-12) << row[0];
}

TEST(ExactRestitution, ReturnsWhatItWasAskedForWhateverMassSpeedAndElasticCurve) {
  ClearanceParameters p;
  p.radial = 0.1e-3;
  p.journal_radius = 10e-3;
  p.sleeve_length = 30e-3;
  for (const char* name : {"johnson", "radzimovsky", "dubowsky-freudenstein", "liu", "pereira", "flores"})
    for (const double e : {0.2, 0.6, 0.95}) {
      p.contact.restitution = e;
      EXPECT_NEAR(impact(make_normal_law(name, "exact", p), 0.3, 0.2, 8000).restitution, e, 1e-6) << name;
    }
}

TEST(ExactRestitution, GoesToZeroDampingSmoothlyAtFullRestitution) {
  EXPECT_EQ(exact_restitution_damping_factor(1.0), 0.0);
  EXPECT_NEAR(exact_restitution_damping_factor(1.0 - 1e-9) / 1.5e-9, 1.0, 1e-6);
  // Beyond it the relation goes on smoothly, as derivatives by differences need it.
  const double slope = (exact_restitution_damping_factor(1.01) - exact_restitution_damping_factor(0.99)) / 0.02;
  EXPECT_NEAR(slope, -1.5, 1e-3);
}

TEST(ContactLaws, ReachTheDepthAndForceThatTheoryForesees) {
  // Relative to the undamped impact: depth, force, and duration over depth / speed.
  for (const reference::Row& row : reference::table("contact_laws", "shape")) {
    const double e = row[0];
    const NormalLaw law{1e9, normal_law(row.name).damping_factor(e)};
    const Impact hit = impact(law, 1.0, 1.0, 8000);
    const double depth = std::pow(5.0 / (4.0 * law.stiffness), 0.4), force = law.stiffness * std::pow(depth, 1.5);
    EXPECT_NEAR(hit.depth / depth, row[1], 2e-6) << row.name;
    EXPECT_NEAR(hit.force / force, row[2], 2e-6) << row.name;
    EXPECT_NEAR(hit.duration / depth, row[3], 5e-5) << row.name;
    // In closed form: K d^(n+1) / ((n+1) m v^2) = (1 - ln(1 + h) / h) / h.
    const double h = law.damping_factor;
    EXPECT_NEAR(law.stiffness * std::pow(hit.depth, 2.5) / 2.5, (1.0 - std::log1p(h) / h) / h, 1e-6) << row.name;
  }
}

TEST(KelvinVoigt, ReturnsTheRestitutionOfItsClosedForm) {
  for (const double e : {0.2, 0.5, 0.9}) {
    const double m = 0.7, K = 1e7, D = kelvin_voigt_dashpot(K, m, e);
    NormalLaw law;
    law.curve = ElasticCurve::linear;
    law.stiffness = K;
    law.dashpot = D;
    EXPECT_NEAR(impact(law, m, 0.3, 20000).restitution, e, 1e-6);
    EXPECT_NEAR(kelvin_voigt_restitution(K, D, m), e, 1e-12);
  }
}

TEST(KelvinVoigt, JumpsByTheDashpotWhenContactBegins) {
  ClearanceParameters p;
  p.contact.linear_stiffness = 1e7;
  p.contact.linear_damping = 100.0;
  const NormalLaw law = kelvin_voigt(p);
  EXPECT_NEAR(law.force(1e-15, 0.5, 0.5), 50.0, 1e-7);
}

// All laws, over twelve decades of penetration and rates up to ten times the impact speed.
TEST(ContactLaws, AreContinuousNeverPullAndStayFinite) {
  ClearanceParameters p;
  p.radial = 0.1e-3;
  p.journal_radius = 10e-3;
  p.sleeve_length = 30e-3;
  p.contact.linear_stiffness = 1e8;
  p.contact.linear_damping = 10.0;
  for (const NormalLawEntry& entry : normal_laws())
    for (const double e : {1e-6, 0.1, 0.9, 1.0}) {
      p.contact.restitution = e;
      const NormalLaw law = make_normal_law(entry.name, "", p);
      for (const double rate : {-10.0, -0.5, 0.0, 0.5, 1.0, 10.0}) {
        double before = 0.0, depth_before = 0.0;
        for (double d = 1e-15; d < 1e-2; d *= 1.02) {
          const double F = law.force(d, rate, 1.0);
          ASSERT_TRUE(std::isfinite(F)) << entry.name;
          ASSERT_GE(F, 0.0) << entry.name;
          // No jump: the steepest curve, a logarithmic one where its range ends, rises with the second power.
          if (entry.geometry != ContactGeometry::linear && before > 0.0) {
            ASSERT_LE(std::abs(F / before - 1.0), std::pow(d / depth_before, 2.0) - 1.0 + 1e-9)
                << entry.name << " at " << d;
          }
          before = F, depth_before = d;
        }
      }
      // Starts from nothing: a thousandth of a thousandth of the force at a thousandth of a thousandth of the
      // depth, but for the slowly varying logarithm of the line laws.
      if (entry.geometry != ContactGeometry::linear) {
        EXPECT_LT(law.force(1e-15, 1.0, 1.0), 3e-6 * law.force(1e-9, 1.0, 1.0)) << entry.name;
      }
    }
}

TEST(ElasticCurves, SlopeAndEnergyAreTheForcesDerivativeAndIntegralAndDepthItsInverse) {
  ClearanceParameters p;
  p.radial = 0.1e-3;
  p.journal_radius = 10e-3;
  p.sleeve_length = 30e-3;
  p.contact.linear_stiffness = 1e8;
  for (const NormalLawEntry& entry : normal_laws()) {
    const NormalLaw law = make_normal_law(entry.name, "", p);
    for (const double d : {1e-9, 3e-7, 0.99e-6, 1.01e-6, 5e-6, 0.4e-4, 0.1e-3, 0.5e-3}) {
      const double h = 1e-6 * d, F = law.elastic_force(d);
      EXPECT_NEAR((law.elastic_force(d + h) - law.elastic_force(d - h)) / (2.0 * h) / law.elastic_slope(d), 1.0, 1e-6)
          << entry.name << " at " << d;
      EXPECT_NEAR(law.depth_under(F) / d, 1.0, 1e-9) << entry.name << " at " << d;
      // Simpson's rule over the last tenth of the way.
      const double a = 0.9 * d, sum = (law.elastic_force(a) + 4.0 * law.elastic_force(0.95 * d) + F) * 0.1 * d / 6.0;
      EXPECT_NEAR((law.elastic_energy(d) - law.elastic_energy(a)) / sum, 1.0, 1e-5) << entry.name << " at " << d;
    }
  }
}

// The implicit laws, from penetration to force and back through the line that their papers print.
TEST(CylinderLaws, SatisfyTheirPrintedRelations) {
  ClearanceParameters p;
  p.radial = 0.5e-3;
  p.journal_radius = 9.5e-3;
  p.sleeve_length = 15e-3;
  p.contact.young = {207e9, 207e9};
  p.contact.poisson = {0.3, 0.3};
  const double E = 207e9 / (2.0 * (1.0 - 0.09)), L = 15e-3, dR = 0.5e-3, Ra = 9.5e-3, Rb = 10e-3, pi = M_PI;
  for (const double d : {1e-7, 1e-6, 5e-6, 2e-5}) {
    double f = make_normal_law("johnson", "", p).elastic_force(d) / L;
    EXPECT_NEAR(f / (pi * E) * (std::log(4.0 * pi * E * dR / f) - 1.0) / d, 1.0, 1e-12);
    f = make_normal_law("radzimovsky", "", p).elastic_force(d) / L;
    const double b = 1.60 * std::sqrt(f * Ra * Rb / (dR * E));
    EXPECT_NEAR(f / (pi * E) * (2.0 / 3.0 + std::log(4.0 * Ra / b) + std::log(4.0 * Rb / b)) / d, 1.0, 1e-12);
    const double F = make_normal_law("dubowsky-freudenstein", "", p).elastic_force(d), s = 1.0 / (pi * E);
    EXPECT_NEAR(F * s / L * (std::log(L * L * L * dR / (F * Ra * Rb * s)) + 1.0) / d, 1.0, 1e-12);
    const double liu = 0.5 * pi * d * E * L * std::sqrt(d / (2.0 * (dR + d)));
    EXPECT_NEAR(make_normal_law("liu", "", p).elastic_force(d) / liu, 1.0, 1e-14);
    const double n = (0.0151 * 0.5 + 1.151) * std::pow(0.5, -0.005);
    const double pereira = (0.965 * 0.5 + 0.0965) * 15.0 * (E * 1e-6) / 0.5 * std::pow(1e3 * d, n);
    EXPECT_NEAR(make_normal_law("pereira", "", p).elastic_force(d) / pereira, 1.0, 1e-12);
  }
}

// Without damping all energy is elastic at the deepest: m v^2 / 2 = 2/5 K d^(5/2), and the force there is K d^(3/2), however small.
TEST(Impact, WithoutDampingIsAsDeepAndAsHardAsItsEnergySays) {
  for (const double speed : {1e-3, 0.1, 5.0}) {
    const double K = 1e9, mass = 1e-3, depth = std::pow(1.25 * mass * speed * speed / K, 0.4);
    const Impact found = impact({K, normal_law("hertz").damping_factor(0.9)}, mass, speed);
    EXPECT_NEAR(found.depth / depth, 1.0, 1e-6) << speed;
    EXPECT_NEAR(found.force / (K * std::pow(depth, 1.5)), 1.0, 1e-6) << speed;
    // Hertz: 2.9432 depths at the speed of approach.
    EXPECT_NEAR(found.duration / (2.943276 * depth / speed), 1.0, 1e-3) << speed;
  }
}

}  // namespace restitution_test
}  // namespace boresight
