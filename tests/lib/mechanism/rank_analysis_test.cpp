// The rank of a mechanism's rows, group of coupled bodies by group.
#include "boresight/mechanism/rank_analysis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/math/singular_values.hpp"
#include "boresight/mechanism/kinematic_report.hpp"

namespace boresight {
namespace rank_analysis_test {

MechanismDescription example(const std::string& name) {
  return read_mechanism(BORESIGHT_EXAMPLES "/" + name + "/" + name + ".toml");
}

// A scene and `more` copies of it, which nothing couples but the ground: their bodies lie mixed.
MechanismDescription several(const MechanismDescription& one, int more) {
  MechanismDescription all;
  const int copies = more + 1, bodies = static_cast<int>(one.bodies.size());
  for (int b = 0; b < bodies; ++b)
    for (int c = 0; c < copies; ++c) {
      all.bodies.push_back(one.bodies[b]);
      all.bodies.back().name += std::to_string(c);
      if (c > 0) all.bodies.back().boresight.reset();
    }
  for (int c = 0; c < copies; ++c)
    for (JointDescription joint : one.joints) {
      joint.name += std::to_string(c);
      if (joint.first != kGround) joint.first = copies * joint.first + c;
      if (joint.second != kGround) joint.second = copies * joint.second + c;
      all.joints.push_back(joint);
    }
  return all;
}

struct Home {
  RankAnalysis analysis;
  int rank_alone = 0;
};

Home ranks_at_home(const MechanismDescription& m, MatX* scaled) {
  const Mechanism mechanism(m);
  std::vector<TimeValue> laws(mechanism.joints());
  ConstraintSystem system(mechanism, {.clearance = ClearanceRows::closed});
  std::vector<BodyMotion> bodies(mechanism.bodies());
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    bodies[b].p = m.bodies[b].center_of_mass;
    bodies[b].R = m.bodies[b].axes;
  }
  system.evaluate(bodies, laws);
  if (scaled) *scaled = scaled_rows(system.dense_jacobian(), mechanism.characteristic_length());
  return {analyse_rank(mechanism, system, false), constraint_rank(mechanism, system)};
}

RankAnalysis with_motion_at_home(const MechanismDescription& m) {
  const Mechanism mechanism(m);
  ConstraintSystem system(mechanism, {.clearance = ClearanceRows::closed});
  std::vector<BodyMotion> bodies(mechanism.bodies());
  for (std::size_t b = 0; b < m.bodies.size(); ++b) bodies[b] = {m.bodies[b].center_of_mass, m.bodies[b].axes};
  system.evaluate(bodies, std::vector<TimeValue>(mechanism.joints()));
  return analyse_rank(mechanism, system);
}

RankAnalysis at_home(const MechanismDescription& m, MatX* scaled = nullptr) {
  return ranks_at_home(m, scaled).analysis;
}

TEST(RankAnalysis, OfSceneBesideSceneIsThatOfEach) {
  for (const char* scene : {"four-bar", "3-rrcpr", "hexapod", "bricard", "altaz-gimbal"}) {
    SCOPED_TRACE(scene);
    MechanismDescription one = example(scene);
    for (JointDescription& joint : one.joints) joint.driven = false;
    one = several(one, 0);
    const RankAnalysis alone = at_home(one), threefold = at_home(several(one, 2));
    EXPECT_EQ(threefold.rank, 3 * alone.rank);
    EXPECT_EQ(threefold.rows, 3 * alone.rows);
    EXPECT_EQ(threefold.columns, 3 * alone.columns);
  }
}

TEST(RankAnalysis, GroupByGroupIsThatOfTheWholeMatrix) {
  for (const char* scene : {"four-bar", "3-rrcpr", "bricard", "hexapod", "free-body"}) {
    SCOPED_TRACE(scene);
    MatX J;
    const RankAnalysis grouped = at_home(several(example(scene), 1), &J);
    if (J.rows() == 0) continue;
    const VecX sigma = Eigen::JacobiSVD<MatX>(J).singularValues();
    int rank = 0;
    for (const double s : sigma) rank += s > kRankTolerance * sigma[0];
    EXPECT_EQ(grouped.rank, rank);
    EXPECT_NEAR(grouped.largest, sigma[0], 1e-13 * sigma[0]);
    EXPECT_NEAR(grouped.weakest, J.rows() >= J.cols() ? sigma[J.cols() - 1] : 0.0, 1e-13 * sigma[0]);
  }
}

// Few columns are decomposed, many are not.
TEST(RankAnalysis, FindsTheMotionThatIsResistedLeastInScenesOfAnySize) {
  for (const int more : {0, 9})
    for (const bool free : {false, true}) {
      MechanismDescription m = several(example("four-bar"), more);
      if (free)
        for (JointDescription& joint : m.joints) joint.driven = joint.driven && joint.name.back() != '0';
      MatX J;
      at_home(m, &J);
      const VecX found = with_motion_at_home(m).least_resisted;
      const double length = Mechanism(m).characteristic_length();
      VecX x = found;
      for (Eigen::Index b = 0; b < x.size() / 6; ++b) x.segment<3>(6 * b) /= length;
      EXPECT_NEAR(x.norm(), 1.0, 1e-9);
      EXPECT_NEAR((J * x).norm(), Eigen::JacobiSVD<MatX>(J).singularValues()[J.cols() - 1], 1e-7) << more << free;
    }
}

TEST(RankAnalysis, AloneIsTheSameNumber) {
  for (const auto& entry : std::filesystem::directory_iterator(BORESIGHT_EXAMPLES)) {
    const std::string name = entry.path().filename().string();
    if (!std::filesystem::exists(entry.path() / (name + ".toml"))) continue;
    SCOPED_TRACE(name);
    const Home home = ranks_at_home(example(name), nullptr);
    EXPECT_EQ(home.rank_alone, home.analysis.rank);
  }
}

// Two drives of one freedom leave another one free, which their number hides.
TEST(KinematicReport, CountsFreedomsByRankNotByDrives) {
  MechanismDescription m = example("four-bar");
  int passive = -1;
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (!m.joints[j].driven && m.joints[j].type == JointType::revolute) passive = static_cast<int>(j);
  ASSERT_GE(passive, 0);
  const MechanismDescription twice = several(m, 1);  // two four-bars, each with its drive
  MechanismDescription crossed = twice;
  int undriven = 0;
  for (std::size_t j = 0; j < crossed.joints.size(); ++j) {
    JointDescription& joint = crossed.joints[j];
    // The first one is driven twice, the second one not at all.
    if (joint.name.ends_with("1") && joint.driven) {
      joint.driven = false;
      ++undriven;
    }
    if (joint.name == m.joints[passive].name + "0") joint.driven = true;
  }
  ASSERT_EQ(undriven, 1);
  const KinematicReport report = analyse_kinematics(Mechanism(crossed));
  EXPECT_EQ(report.mobility, 2);
  EXPECT_EQ(report.drives, 2);
  EXPECT_EQ(report.free_freedoms, 1);
  EXPECT_THAT(report.findings, testing::Contains(testing::HasSubstr("their laws must agree")));
}

// R = Q diag(1 .. s) W with a gap that falls through the tolerance: the bounds must hold the singular values that they bound.
TEST(RankBounds, HoldTheSingularValuesOnBothSides) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 200; ++trial) {
    const int m = 1 + trial % 17, n = 1 + trial * 7 % 23, k = std::min(m, n);
    MatX A = MatX::NullaryExpr(m, n, [&] { return normal(random); });
    const Eigen::JacobiSVD<MatX> svd(A, Eigen::ComputeThinU | Eigen::ComputeThinV);
    VecX sigma(k);
    for (int i = 0; i < k; ++i) sigma[i] = std::pow(10.0, -12.0 * i / k);
    if (trial % 3 == 0 && k > 2) sigma.tail(2).setZero();
    A = svd.matrixU() * sigma.asDiagonal() * svd.matrixV().transpose();
    const RankBounds bounds = rank_bounds(A, 1e-8);
    ASSERT_LE(bounds.rank, k);
    if (bounds.rank > 0) {
      EXPECT_LE(bounds.kept, sigma[bounds.rank - 1] * (1.0 + 1e-6) + 1e-15) << trial;
    }
    if (bounds.rank < k) {
      EXPECT_GE(bounds.dropped, sigma[bounds.rank] - 1e-15) << trial;
    }
  }
}

}  // namespace rank_analysis_test
}  // namespace boresight
