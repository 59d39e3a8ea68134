#include "boresight_analyses/random/tolerance_disc.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "boresight_analyses/random/sampling_design.hpp"
#include "validation/printed.hpp"

namespace boresight {
namespace tolerance_disc_test {

using Place = std::array<double, 2>;
constexpr double kRadius = 2.5e-5;

std::vector<Place> points_of(const ToleranceDisc& disc, std::uint64_t count) {
  const SamplingDesign design({.kind = SamplingKind::sobol, .seed = 3}, 2);
  std::vector<Place> points(count);
  for (std::uint64_t k = 0; k < count; ++k) {
    design.point(k, points[k]);
    disc.place(points[k]);
  }
  return points;
}

std::array<ToleranceDisc, 2> both() {
  return {ToleranceDisc(kRadius, {0.0, 0.0}, ZoneLaw::uniform), ToleranceDisc(kRadius, {0.0, 0.0}, ZoneLaw::normal)};
}

// E r^2 = R^2 / 2; of the cut Rayleigh law 2 s^2 (1 - a / (e^a - 1)), a = 9/2, s = R / 3.
double mean_square(const ToleranceDisc& disc) {
  if (disc.text().find("uniform") != std::string::npos) return 0.5 * kRadius * kRadius;
  return 2.0 * kRadius * kRadius / 9.0 * (1.0 - 4.5 / std::expm1(4.5));
}

TEST(ToleranceDisc, HoldsInSmallerDiscsWhatItsClosedFormsSay) {
  constexpr std::uint64_t n = 1 << 14;
  validation::PrintedTable uniform("closed form: (r / R)^2", "share of a uniform disc within r, by 16,384 points",
                                   2e-3);
  validation::PrintedTable normal("closed form: Rayleigh's distribution, cut at 3 sd",
                                  "share of a normal disc within r, by 16,384 points", 2e-3);
  for (const ToleranceDisc& disc : both()) {
    const std::vector<Place> points = points_of(disc, n);
    const bool flat = disc.text().find("uniform") != std::string::npos;
    for (const double share : {0.1, 0.3, 0.5, 0.8, 0.95}) {
      double within = 0.0;
      for (const Place& p : points) within += std::hypot(p[0], p[1]) <= share * kRadius;
      const double truth = flat ? share * share : (1.0 - std::exp(-4.5 * share * share)) / (1.0 - std::exp(-4.5));
      (flat ? uniform : normal).expect("r = " + std::to_string(share) + " R", truth, within / n);
      EXPECT_NEAR(disc.probability_within(share * kRadius), truth, 1e-15);
      EXPECT_NEAR(disc.radius_of(truth) / (share * kRadius), 1.0, 1e-13);
    }
    for (const Place& p : points) ASSERT_LE(std::hypot(p[0], p[1]), kRadius * (1.0 + 1e-15));
  }
}

TEST(ToleranceDisc, HasTheMomentsOfItsClosedForms) {
  constexpr std::uint64_t n = 1 << 14;
  for (const ToleranceDisc& disc : both()) {
    double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
    for (const Place& p : points_of(disc, n)) {
      x += p[0] / n, y += p[1] / n;
      xx += p[0] * p[0] / n, yy += p[1] * p[1] / n, xy += p[0] * p[1] / n;
    }
    const double variance = 0.5 * mean_square(disc);
    EXPECT_NEAR(x / kRadius, 0.0, 1e-3) << disc.text();
    EXPECT_NEAR(y / kRadius, 0.0, 1e-3) << disc.text();
    EXPECT_NEAR(xx / variance, 1.0, 3e-3) << disc.text();
    EXPECT_NEAR(yy / variance, 1.0, 3e-3) << disc.text();
    EXPECT_NEAR(xy / variance, 0.0, 3e-3) << disc.text();
    for (const std::size_t k : {0u, 1u}) {
      EXPECT_NEAR(disc.marginal(k)->mean() / kRadius, 0.0, 1e-14);
      EXPECT_NEAR(disc.marginal(k)->sd() / std::sqrt(variance), 1.0, 1e-13) << disc.text();
    }
  }
}

TEST(ToleranceDisc, HasNoDirection) {
  constexpr std::uint64_t n = 1 << 14;
  constexpr int kSectors = 12;
  for (const ToleranceDisc& disc : both()) {
    std::array<double, kSectors> share{};
    for (const Place& p : points_of(disc, n)) {
      const double turn = std::atan2(p[1], p[0]) / (2.0 * std::numbers::pi) + 0.5;
      share.at(std::min<std::size_t>(kSectors - 1, static_cast<std::size_t>(turn * kSectors))) += 1.0 / n;
    }
    for (const double s : share) EXPECT_NEAR(s, 1.0 / kSectors, 2e-3) << disc.text();
  }
}

TEST(ToleranceDisc, HasTheMarginalsOfItsPoints) {
  constexpr std::uint64_t n = 1 << 14;
  for (const ToleranceDisc& disc : both()) {
    const std::vector<Place> points = points_of(disc, n);
    for (const double u : {0.02, 0.2, 0.5, 0.7, 0.99})
      for (const std::size_t k : {0u, 1u}) {
        const double at = disc.marginal(k)->quantile(u);
        double below = 0.0;
        for (const Place& p : points) below += p.at(k) <= at;
        EXPECT_NEAR(below / n, u, 2e-3) << disc.text();
      }
  }
}

TEST(ToleranceDisc, IsAtItsCentreInTheMiddleOfTheCubeAndGrowsWithEachCoordinate) {
  for (const ZoneLaw law : {ZoneLaw::uniform, ZoneLaw::normal}) {
    const ToleranceDisc disc(kRadius, {1.0, -2.0}, law);
    Place middle = {0.5, 0.5};
    disc.place(middle);
    EXPECT_EQ(middle, (Place{1.0, -2.0}));
    double before = -1e9;
    for (double u = 0.01; u < 1.0; u += 0.07) {
      Place p = {u, 0.8};
      disc.place(p);
      EXPECT_GT(p[0], before);
      before = p[0];
    }
    Place corner = {1.0 - 0x1p-53, 1e-300};
    disc.place(corner);
    EXPECT_LE(std::hypot(corner[0] - 1.0, corner[1] + 2.0), kRadius * (1.0 + 1e-9));
  }
}

TEST(ToleranceDisc, SaysAllThatItsPointsDependOn) {
  EXPECT_NE(both()[0].text(), both()[1].text());
  EXPECT_NE(both()[0].text(), ToleranceDisc(kRadius, {0.0, 1e-9}, ZoneLaw::uniform).text());
  EXPECT_NE(both()[0].text(), ToleranceDisc(2.0 * kRadius, {0.0, 0.0}, ZoneLaw::uniform).text());
  EXPECT_THROW(ToleranceDisc(0.0, {0.0, 0.0}, ZoneLaw::normal), std::invalid_argument);
}

}  // namespace tolerance_disc_test
}  // namespace boresight
