// The default mechanism's lengths, axes and drives, fitted from poses that were measured.
#include <gtest/gtest.h>

#include <cstdio>
#include <set>

#include "boresight/io/expression.hpp"
#include "boresight/mechanism/error.hpp"
#include "poses_bench.hpp"

namespace boresight {
namespace kinematic_calibration_test {

using poses::Bench;
using poses::Coverage;

using Kind = ErrorDescription::Kind;

// Thirty-three errors: per leg the zero and scale of its two drives, the length of its crank and rod, where its foot and its bearing on the
// platform stand, and how its axes are turned.
std::shared_ptr<const Mechanism> with_thirty_errors(std::vector<std::string>& paths) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml");
  m.clearances.clear();
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  const auto joint = [&](const std::string& name) {
    for (std::size_t j = 0; j < m.joints.size(); ++j)
      if (m.joints[j].name == name) return static_cast<int>(j);
    throw std::logic_error(name);
  };
  const auto body = [&](const std::string& name) {
    for (std::size_t b = 0; b < m.bodies.size(); ++b)
      if (m.bodies[b].name == name) return static_cast<int>(b);
    return kGround;
  };
  const auto add = [&](const std::string& name, Kind kind, const std::string& of_joint, const std::string& in,
                       const Vec3& direction, const std::string& law) {
    ErrorDescription e;
    e.name = name;
    e.kind = kind;
    e.joint = joint(of_joint);
    e.body = body(in);
    e.direction = direction;
    if (kind == Kind::drive) e.law = parse_coordinate_function(law);
    const bool length = kind == Kind::translation || (kind == Kind::drive && of_joint[0] == 'P');
    e.value = (length ? 50e-6 : 100e-6) * normal(engine);
    m.errors.push_back(e);
    paths.push_back("error." + name);
  };
  for (const std::string i : {"1", "2", "3"}) {
    const Vec3 along = (m.joints[joint("F" + i)].point - m.joints[joint("P" + i)].point).normalized();
    add("leg" + i + ".crank_zero", Kind::drive, "A" + i, "", Vec3::UnitX(), "1");
    add("leg" + i + ".crank_scale", Kind::drive, "A" + i, "", Vec3::UnitX(), "q");
    add("leg" + i + ".slide_zero", Kind::drive, "P" + i, "", Vec3::UnitX(), "1");
    add("leg" + i + ".slide_scale", Kind::drive, "P" + i, "", Vec3::UnitX(), "q");
    // As the slide's zero.
    add("leg" + i + ".rod_length", Kind::translation, "F" + i, "rod" + i, along, "");
    add("leg" + i + ".platform_x", Kind::translation, "F" + i, "platform", Vec3::UnitX(), "");
    add("leg" + i + ".platform_y", Kind::translation, "F" + i, "platform", Vec3::UnitY(), "");
    add("leg" + i + ".platform_z", Kind::translation, "F" + i, "platform", Vec3::UnitZ(), "");
    add("leg" + i + ".platform_turn", Kind::rotation, "F" + i, "platform", Vec3::UnitX(), "");
    add("leg" + i + ".foot_turn_x", Kind::rotation, "A" + i, "ground", Vec3::UnitX(), "");
    add("leg" + i + ".foot_turn_y", Kind::rotation, "A" + i, "ground", Vec3::UnitY(), "");
  }
  return std::make_shared<const Mechanism>(std::move(m));
}

// Of as many sets of fifty poses.
void expect_coverage(int sets) {
  constexpr int kPoses = 50;
  std::vector<std::string> paths;
  const auto mechanism = with_thirty_errors(paths);
  ASSERT_EQ(paths.size(), 33u);
  const Bench bench(mechanism, paths, {0, 1, 2, 3, 4, 5}, kPoses);
  // As a laser tracker and an autocollimator measure.
  const std::vector<double> noise = {5e-6, 5e-6, 5e-6, 5e-6, 5e-6, 5e-6};
  Coverage single, combined;
  std::vector<Coverage> each(paths.size());
  std::set<std::size_t> numbers_of_groups;
  std::size_t named = 0;
  for (int seed = 0; seed < sets; ++seed) {
    CalibrationProblem problem = bench.problem(noise, static_cast<unsigned>(100 + seed));
    problem.loss.kind = Loss::none;
    const CalibrationResult result = calibrate(problem, {});
    EXPECT_TRUE(result.fit.converged) << result.fit.reason;
    for (std::size_t p = 0; p < paths.size(); ++p) {
      const ParameterEstimate& e = result.inference.parameters[p];
      if (!e.identifiable) continue;
      each[p].add(bench.truth(paths[p]), e.low, e.high);
      single.add(bench.truth(paths[p]), e.low, e.high);
    }
    for (const ConfusedErrors& group : result.inference.confused)
      for (const KnownCombination& c : group.known) combined.add(bench.truth(c), c.low, c.high);
    numbers_of_groups.insert(result.inference.confused.size());
    if (seed > 0) continue;
    for (const std::string& sentence : result.verdict) std::printf("  %s\n", sentence.c_str());
    for (const ConfusedErrors& group : result.inference.confused) named += group.parameters.size();
    std::printf("  %d of 33 directions are seen; %zu errors in %zu groups\n", result.inference.rank, named,
                result.inference.confused.size());
    // A rod's length is its slide's zero.
    for (std::size_t leg = 0; leg < 3; ++leg) {
      EXPECT_FALSE(result.inference.parameters[11 * leg + 2].identifiable);
      EXPECT_FALSE(result.inference.parameters[11 * leg + 4].identifiable);
    }
  }
  for (std::size_t p = 0; p < paths.size(); ++p)
    if (each[p].all > 0)
      std::printf("  %s: truth inside %d of %d intervals of 95 %%\n", paths[p].c_str(), each[p].inside, each[p].all);
  std::printf("  errors: %d of %d, %.2f %%; combinations: %d of %d, %.2f %%\n", single.inside, single.all,
              100.0 * single.share(), combined.inside, combined.all, 100.0 * combined.share());
  // The same are named whatever the noise.
  EXPECT_EQ(numbers_of_groups.size(), 1u);
  EXPECT_GT(single.all, 0);
  EXPECT_GT(combined.all, 0);
  // Intervals of one data set go up and down together: two standard errors of as many sets as there are, not of all intervals.
  const double allowed = 2.0 * std::sqrt(0.95 * 0.05 / sets);
  EXPECT_NEAR(single.share(), 0.95, allowed);
  EXPECT_NEAR(combined.share(), 0.95, allowed);
}

// Even if the intervals of one set all held the truth or all missed it together, 30 sets found out intervals that hold it in three cases of four
// where they say 95 % with a chance of 96 %, and in four of five with 88 %; 100 sets those of 85 % with 94 %. (They do not: chances are better.)
TEST(KinematicCalibration, NamesWhatFiftyPosesDoNotTellAndIsRightOfTheRestAsOftenAsStated) { expect_coverage(30); }

TEST(KinematicCalibrationNight, ThirtyErrorsAreInsideTheirIntervalsAsOftenAsStated) { expect_coverage(100); }

}  // namespace kinematic_calibration_test
}  // namespace boresight
