// Correlated contributors, correlated axes and turned frames: what members draw has the correlations asked for, and the classical table knows them.
#include "boresight_analyses/budget/draws.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "budget/made_budget.hpp"

namespace boresight {
namespace draws_test {

using testing::HasSubstr;

constexpr double kSpacing = 0.01;
constexpr std::size_t kSamples = 100;
constexpr int kMembers = 3000;

// Correlation of two components over members and time.
struct Seen {
  double xx = 0.0, yy = 0.0, xy = 0.0;
  void add(double x, double y) { xx += x * x, yy += y * y, xy += x * y; }
  double correlation() const { return xy / std::sqrt(xx * yy); }
};

Contributor of(ContributorClass kind, const PowerDensity& density = {.white = 1.0, .upper = 20.0}) {
  Contributor c{.name = "c", .kind = kind, .correlation_time = 0.02};
  c.parameter.fill(kind == ContributorClass::bias ? make_normal(0.0, 2.0) : make_discrete({2.0}, {1.0}));
  if (kind != ContributorClass::spectrum) return c;
  c.noise = std::make_shared<const Noise>(density);
  c.noise_course = std::make_shared<const NoiseCourse>(*c.noise, kSpacing, kSamples);
  return c;
}

TEST(Draws, OfCorrelatedContributorsHaveThatCorrelationAxisByAxis) {
  for (const ContributorClass kind : {ContributorClass::bias, ContributorClass::random, ContributorClass::spectrum}) {
    const std::vector<Contributor> all(3, of(kind));
    const std::vector<Draws> draws = draws_of(all, {{0, 1, 0.6}, {1, 2, -0.3}});
    EXPECT_NEAR(draws[0].correlation_with(draws[1]), 0.6, 1e-12);
    EXPECT_NEAR(draws[2].correlation_with(draws[1]), -0.3, 1e-12);
    Seen first_second, second_third, first_third, across;
    for (std::uint64_t member = 0; member < kMembers; ++member) {
      std::vector<std::vector<Vec3>> e;
      for (std::size_t i = 0; i < 3; ++i) e.push_back(course(all[i], 1, member, draws[i], kSpacing, kSamples, {}));
      for (std::size_t k = 0; k < kSamples; k += 10) {
        first_second.add(e[0][k].x(), e[1][k].x());
        second_third.add(e[1][k].y(), e[2][k].y());
        first_third.add(e[0][k].x(), e[2][k].x());
        across.add(e[0][k].x(), e[1][k].y());
      }
    }
    // Of 3000 independent pairs at least: 0.018.
    EXPECT_NEAR(first_second.correlation(), 0.6, 0.05) << to_string(kind);
    EXPECT_NEAR(second_third.correlation(), -0.3, 0.06) << to_string(kind);
    EXPECT_NEAR(first_third.correlation(), 0.0, 0.06) << to_string(kind);
    EXPECT_NEAR(across.correlation(), 0.0, 0.06) << to_string(kind);
  }
}

// Coherent in the band that both have: of white noises from 1 to 20 Hz and from 1 to 5 Hz the correlation is the coefficient times sqrt(4 / 19).
TEST(Draws, OfCorrelatedSpectraAreCoherentWhereBothHavePower) {
  const std::vector<Contributor> all = {of(ContributorClass::spectrum, {.white = 1.0, .lower = 1.0, .upper = 20.0}),
                                        of(ContributorClass::spectrum, {.white = 1.0, .lower = 1.0, .upper = 5.0})};
  const std::vector<Draws> draws = draws_of(all, {{0, 1, 0.8}});
  Seen seen;
  for (std::uint64_t member = 0; member < kMembers; ++member) {
    const auto a = course(all[0], 1, member, draws[0], kSpacing, kSamples, {}),
               b = course(all[1], 1, member, draws[1], kSpacing, kSamples, {});
    for (std::size_t k = 0; k < kSamples; k += 10) seen.add(a[k].x(), b[k].x());
  }
  EXPECT_NEAR(seen.correlation(), 0.8 * std::sqrt(4.0 / 19.0), 0.03);
}

TEST(Draws, OfCorrelatedAxesInATurnedFrameHaveTheCovarianceThatTheTableSays) {
  for (const ContributorClass kind : {ContributorClass::bias, ContributorClass::random, ContributorClass::spectrum}) {
    Contributor c = of(kind);
    c.parameter[0] = kind == ContributorClass::bias ? make_normal(0.0, 3.0) : make_discrete({3.0}, {1.0});
    c.axes_factor = axes_of_correlation(0.5, -0.2, 0.1);
    c.frame = Eigen::AngleAxisd(0.7, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    const Windows windows;
    const AxesMoments m = axes_moments(c, ErrorIndex::ape, Interpretation::mixed, windows, 1.0);
    Mat3 covariance = Mat3::Zero();
    for (std::uint64_t member = 0; member < kMembers; ++member) {
      const std::vector<Vec3> e = course(c, 1, member, 0, kSpacing, kSamples, windows);
      for (std::size_t k = 0; k < kSamples; k += 10) covariance += e[k] * e[k].transpose() / (kMembers * 10.0);
    }
    const Mat3 expected = m.factor * m.factor.transpose();
    EXPECT_LT((covariance - expected).norm(), 0.06 * expected.norm()) << to_string(kind) << '\n'
                                                                      << covariance << '\n'
                                                                      << expected;
  }
}

// Two noises of 3 and 4 that go together by one half: sqrt(9 + 16 + 12).
TEST(ClassicalTable, AddsCorrelatedContributorsByTheirCoefficients) {
  const std::vector<Draws> draws = draws_of(std::vector<std::uint64_t>{0, 1, 2}, {{0, 1, 0.5}});
  std::vector<ClassicalLine> lines = {{"a", "random", "", {{0.0, 3.0}}, {}, draws[0]},
                                      {"b", "random", "", {{0.0, 4.0}}, {}, draws[1]},
                                      {"c", "random", "", {{0.0, 2.0}}, {}, draws[2]}};
  EXPECT_NEAR(total_of(lines).axes[0].sd, std::sqrt(37.0 + 4.0), 1e-12);
}

// A covariance turned by 45 degrees has the radius of its principal axes.
TEST(ClassicalTable, IntegratesAnErrorWhoseAxesAreCorrelatedAlongItsPrincipalOnes) {
  Mat3 turned = Mat3::Zero();
  turned.topLeftCorner<2, 2>() << std::sqrt(0.5) * 3.0, -std::sqrt(0.5), std::sqrt(0.5) * 3.0, std::sqrt(0.5);
  const std::vector<ClassicalLine> along = {{"a", "bias", "", {{std::sqrt(2.0), 3.0}, {0.0, 1.0}}}},
                                   across = {{"a", "bias", "", {{1.0, std::sqrt(5.0)}, {1.0, std::sqrt(5.0)}}, turned}};
  EXPECT_NEAR(total_of(across).radius_integrated(0.95), total_of(along).radius_integrated(0.95), 1e-9);
  EXPECT_NEAR(total_of(across).axes[1].sd, std::sqrt(5.0), 1e-12);
}

// White noise of 10 arcsec on the x of a head that is mounted a quarter turn about the boresight: all of it on the error's y.
TEST(Frames, TurnAContributorIntoTheAxesOfTheError) {
  const MadeBudget made =
      make_budget(std::make_shared<const Mechanism>(read_mechanism_text(kMirror, "mirror.toml")), R"([budget]
members = 20
sampling = "1 ms"
[[budget.contributor]]
name = "head"
class = "random"
value = "10 arcsec"
axes = ["x", "z"]
frame = { x = [0, 1, 0], z = [0, 0, 1] }
)");
  const ClassicalTable& table = table_of(made.budget, ErrorIndex::ape, Interpretation::mixed);
  const double arcsec = M_PI / 180.0 / 3600.0;
  EXPECT_NEAR(table.total.axes[0].sd, 0.0, 1e-15);
  EXPECT_NEAR(table.total.axes[1].sd, 10.0 * arcsec, 1e-12);
  EXPECT_NEAR(mixed_level(made.budget, ErrorIndex::ape, 0), 0.0, 1e-15);
  EXPECT_NEAR(mixed_level(made.budget, ErrorIndex::ape, 1), 1.96 * 10.0 * arcsec, 0.05 * 19.6 * arcsec);
}

std::string fault(const std::string& table) {
  try {
    Document document = Document::from_text("[budget]\n" + table, "study.toml");
    Cursor root(document);
    Study study;
    study.index.quantity = "boresight_error";
    read_budget_plan(root, study, read_mechanism_text(kMirror, "mirror.toml"), 1.0, [](const Setting&) {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(Correlations, MistakesAreOneLine) {
  const auto one = [](const std::string& name, const std::string& lines) {
    return "[[budget.contributor]]\nname = \"" + name + "\"\n" + lines + "\n";
  };
  const std::string bias = "class = \"bias\"\nvalue = \"1 arcsec\"";
  const std::string three = one("a", bias) + one("b", bias) + one("c", bias) +
                            one("p", "class = \"periodic\"\nperiod = \"1 s\"\nvalue = \"1 arcsec\"");
  const auto pair = [](const std::string& a, const std::string& b, const std::string& coefficient) {
    return "[[budget.correlation]]\ncontributors = [\"" + a + "\", \"" + b + "\"]\ncoefficient = " + coefficient + "\n";
  };
  EXPECT_EQ(fault(three + pair("a", "b", "0.9") + pair("b", "c", "-0.9") + pair("a", "c", "-0.8")), "no fault");
  EXPECT_THAT(fault(three + pair("a", "b", "0.9") + pair("b", "c", "-0.9") + pair("a", "c", "0.8")),
              HasSubstr("positive definite"));
  EXPECT_THAT(fault(three + pair("a", "q", "0.9")), HasSubstr("the name of a contributor"));
  EXPECT_THAT(fault(three + pair("a", "p", "0.9")), HasSubstr("two of one sort"));
  EXPECT_THAT(fault(three + pair("a", "a", "0.9")), HasSubstr("vary as one"));
  const auto grouped = [&](const std::string& kind) {
    return one("g", bias + "\ngroup = \"both\"") + one("h", kind + "\nvalue = \"1 arcsec\"\ngroup = \"both\"");
  };
  EXPECT_EQ(fault(three + grouped("class = \"bias\"") + pair("a", "g", "0.5")), "no fault");
  EXPECT_THAT(fault(three + grouped("class = \"periodic\"\nperiod = \"1 s\"") + pair("a", "g", "0.5")),
              HasSubstr("a and g, in a group with h, which is of another sort"));
  EXPECT_THAT(fault(three + pair("a", "b", "0.9") + pair("b", "a", "0.1")), HasSubstr("once"));
  EXPECT_THAT(fault(three + pair("a", "b", "1")), HasSubstr("less than 1"));
  EXPECT_THAT(fault(one("a", bias + "\naxis_correlation = [0.5, 0.1, 0.1]")), HasSubstr("one: of x with y"));
  EXPECT_THAT(fault(one("a", bias + "\naxis_correlation = [1.5]")), HasSubstr("positive definite"));
  EXPECT_THAT(fault(one("a", bias + "\nframe = { x = [1, 0, 0] }")), HasSubstr("two of x, y, z"));
  EXPECT_THAT(fault(one("a", bias + "\nframe = { x = [1, 0, 0], y = [1, 1, 0] }")), HasSubstr("perpendicular"));
  EXPECT_THAT(fault(one("a", bias + "\naxes = [\"z\"]")), HasSubstr("an axis of the error"));
  EXPECT_EQ(
      fault(
          one("a",
              bias + "\naxes = [\"z\"]\nframe = { x = [0, 0, 1], y = [0, 1, 0] }\naxis_correlation = [0.5, 0.1, 0.1]")),
      "no fault");
}

}  // namespace draws_test
}  // namespace boresight
