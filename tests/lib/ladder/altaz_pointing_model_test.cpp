// A two-axis mount's standing errors are the geometric terms of the classical pointing model of telescopes.
//
// Source: Wallace, TPOINT, a telescope pointing analysis system (version 18.20, 2011), the terms IA, IE, CA, NPAE, AN and AW of an
// altitude-azimuth mount. Signs are ours: of what the
// boresight does, in azimuth from north over east and in elevation (examples/altaz-gimbal).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/ideal_solver.hpp"
#include "scenes.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace altaz_pointing_model_test {

constexpr double kDegree = M_PI / 180.0;

struct Direction {
  double A, E;
};

// Of what the boresight does, where it is told to point at.
struct Term {
  const char* name;
  std::function<Direction(double A, double E)> per_unit;
};

const std::vector<Term>& terms() {
  using std::cos, std::sin, std::tan;
  static const std::vector<Term> all = {{"IA",
                                         [](double, double) {
                                           return Direction{1.0, 0.0};
                                         }},
                                        {"IE",
                                         [](double, double) {
                                           return Direction{0.0, 1.0};
                                         }},
                                        {"CA",
                                         [](double, double E) {
                                           return Direction{1.0 / cos(E), 0.0};
                                         }},
                                        {"NPAE",
                                         [](double, double E) {
                                           return Direction{tan(E), 0.0};
                                         }},
                                        {"AN",
                                         [](double A, double E) {
                                           return Direction{sin(A) * tan(E), cos(A)};
                                         }},
                                        {"AW", [](double A, double E) {
                                           return Direction{-cos(A) * tan(E), sin(A)};
                                         }}};
  return all;
}

// The mount told to stand at A, E for ever.
struct Mount {
  double A, E;
  std::shared_ptr<const Mechanism> mechanism;
  std::shared_ptr<const IdealMotion> commanded;

  Mount(double azimuth, double elevation) {
    const std::string a = std::to_string(azimuth), e = std::to_string(elevation);
    // As many digits as the settings have.
    A = std::stod(a);
    E = std::stod(e);
    mechanism = std::make_shared<const Mechanism>(
        read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml",
                       {{"motion.duration", "1 s"}, {"motion.drives.azimuth", a}, {"motion.drives.elevation", e}}));
    commanded = std::make_shared<const IdealMotion>(IdealMotion::kinematic(*mechanism));
  }

  // Of one term, its error alone of this size; of all of them, of different sizes and signs, where only is -1.
  Parameters sample(int only, double size) const {
    Parameters sample = mechanism->parameters();
    const std::vector<ErrorDescription>& errors = mechanism->description().errors;
    int found = 0;
    for (std::size_t k = 0; k < errors.size(); ++k) {
      sample.error[k] = 0.0;
      for (int t = 0; t < static_cast<int>(terms().size()); ++t) {
        if (errors[k].name != terms()[static_cast<std::size_t>(t)].name) continue;
        ++found;
        if (only == -1) sample.error[k] = size * std::cos(2.0 + 1.7 * t);
        if (only == t) sample.error[k] = size;
      }
    }
    EXPECT_EQ(found, 6);
    return sample;
  }

  // How far the boresight is off: azimuth times cos E, and elevation. By the geometry of the built mechanism.
  Direction exactly(const Parameters& sample) const {
    const auto built = built_mechanism(*mechanism, sample, commanded);
    IdealState state;
    commanded->state(0.0, state);
    EXPECT_TRUE(IdealSolver(*built).solve(0.0, state));
    const Vec3 b = state.bodies[static_cast<std::size_t>(mechanism->boresight_body())].R * mechanism->boresight_B();
    return {std::remainder(std::atan2(b.x(), b.y()) - A, 2.0 * M_PI) * std::cos(E), std::asin(b.z()) - E};
  }

  // By the closed forms.
  Direction in_closed_form(const Parameters& sample) const {
    Direction sum{0.0, 0.0};
    const std::vector<ErrorDescription>& errors = mechanism->description().errors;
    for (std::size_t k = 0; k < errors.size(); ++k)
      for (const Term& term : terms()) {
        if (errors[k].name != term.name) continue;
        const Direction unit = term.per_unit(A, E);
        sum.A += sample.error[k] * unit.A * std::cos(E);
        sum.E += sample.error[k] * unit.E;
      }
    return sum;
  }
};

// Over the sky, up to 75 degrees of elevation.
std::vector<Mount> sky() {
  std::vector<Mount> mounts;
  for (int a = 0; a < 12; ++a)
    for (int e = 0; e <= 5; ++e) mounts.emplace_back(30.0 * kDegree * a - M_PI + 0.1, 15.0 * kDegree * e);
  return mounts;
}

TEST(AltAzPointingModel, HasTheSixGeometricTermsToSecondOrderOverTheSky) {
  const std::vector<Mount> mounts = sky();
  // The largest difference over the sky; into a row of the table of printed numbers where there is one.
  const auto largest_difference = [&](int term, double size, validation::PrintedTable* row) {
    double worst = 0.0;
    for (const Mount& mount : mounts) {
      const Parameters sample = mount.sample(term, size);
      const Direction exact = mount.exactly(sample), closed = mount.in_closed_form(sample);
      worst = std::max(worst, std::hypot(exact.A - closed.A, exact.E - closed.E));
      if (!row) continue;
      const std::string where = "A = " + std::to_string(mount.A) + ", E = " + std::to_string(mount.E);
      row->expect(where + ", azimuth", closed.A, exact.A);
      row->expect(where + ", elevation", closed.E, exact.E);
    }
    return worst;
  };
  constexpr double kSize = 1e-4;  // [rad]: 21 arcsec
  for (int t = -1; t < static_cast<int>(terms().size()); ++t) {
    const std::string name = t < 0 ? "all six" : terms()[static_cast<std::size_t>(t)].name;
    // Second order: a term's square, times at most tan 75 where a direction turns into another azimuth.
    const double bound = (t < 0 ? 36.0 : 1.0) * std::tan(75.0 * kDegree) * kSize * kSize;
    validation::PrintedTable row("TPOINT (Wallace 2011), altitude-azimuth mount",
                                 name + " of 0.1 mrad, azimuth times cos E and elevation over the sky [rad]", bound);
    const double whole = largest_difference(t, kSize, &row), half = largest_difference(t, 0.5 * kSize, nullptr);
    // Index errors are exact.
    if (whole > 1e-13) {
      EXPECT_NEAR(half / whole, 0.25, 0.01) << name;
    } else {
      EXPECT_TRUE(name == "IA" || name == "IE") << name;
    }
  }
}

}  // namespace altaz_pointing_model_test
}  // namespace boresight
