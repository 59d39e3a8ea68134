// The perturbation rung on any topology: many joints at once, driven ones, redundant ones, freedoms that nothing drives.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/scene/clearance_scene.hpp"
#include "boresight/scene/deviation_coordinates.hpp"
#include "scenes.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace deviation_test {

// The default scene with F1's clearance on the joints chosen.
template <typename Chosen>
std::shared_ptr<const Mechanism> with_clearance_on(const Chosen& chosen, const char* duration) {
  MechanismDescription d = scenes::rrcpr({{"motion.duration", duration}});
  const ClearanceDescription pattern = d.clearances[0];
  d.clearances.clear();
  for (int j = 0; j < static_cast<int>(d.joints.size()); ++j) {
    if (!chosen(d.joints[j])) continue;
    ClearanceDescription c = pattern;
    c.joint = j;
    c.journal = d.joints[j].first == kGround ? d.joints[j].second : d.joints[j].first;
    d.clearances.push_back(c);
  }
  return scenes::build(std::move(d));
}

bool takes_clearance(const JointDescription& j) {
  return j.type == JointType::revolute || j.type == JointType::cylindrical;
}

// An example with nothing driven, started at a rate of its first joint.
std::shared_ptr<const Mechanism> undriven(const std::string& example, const char* duration, double rate) {
  MechanismDescription d = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + example + "/" + example + ".toml",
                                          {{"motion.duration", duration}});
  for (JointDescription& j : d.joints) j.driven = false;
  d.motion.drives.clear();
  d.initial_rates.push_back({0, InitialRateDescription::Freedom::angle, rate, {}});
  return scenes::build(std::move(d));
}

RunResult run(const char* rung, const std::shared_ptr<const Mechanism>& mechanism, double step) {
  RunOptions options;
  options.step = step;
  options.sample_spacing = 0.0;
  return make_rung(rung, mechanism)->run(mechanism->parameters(), options);
}

void expect_close(const RunResult& a, const RunResult& b, double max, double rms, const std::string& what) {
  ASSERT_GT(b.index.position_error.rms, 0.0) << what;
  EXPECT_NEAR(a.index.position_error.max / b.index.position_error.max, 1.0, max) << what;
  EXPECT_NEAR(a.index.position_error.rms / b.index.position_error.rms, 1.0, rms) << what;
}

TEST(Perturbation, FollowsMultibodyWithClearanceInAnyOneJoint) {
  for (const char* name : {"A1", "B2", "C1", "C3", "F2"}) {
    const auto mechanism = with_clearance_on([&](const JointDescription& j) { return j.name == name; }, "0.3 s");
    // Single runs, which impacts scatter by a percent.
    expect_close(run("perturbation", mechanism, 1e-5), run("multibody", mechanism, 1e-5), 0.03, 0.01, name);
  }
}

// Impacts scatter the maximum: the scatter over three perturbed steps of each rung is part of the test's record.
void expect_twelve_joints_followed(const char* duration) {
  const auto mechanism = with_clearance_on(takes_clearance, duration);
  ASSERT_EQ(mechanism->clearances(), 12);
  double max[2], rms[2];
  for (int k : {0, 1}) {
    const auto rung = make_rung(k == 0 ? "perturbation" : "multibody", mechanism);
    std::vector<double> maxima, means;
    for (double share : {1.0, 0.98, 0.96}) {
      RunOptions options;
      options.step = share * 2e-5;
      options.sample_spacing = 0.0;
      const PointingIndices index = rung->run(mechanism->parameters(), options).index;
      maxima.push_back(index.position_error.max);
      means.push_back(index.position_error.rms);
    }
    std::sort(maxima.begin(), maxima.end());
    std::sort(means.begin(), means.end());
    std::printf("%s: maximum %.4f mm (%.4f to %.4f over three steps), RMS %.4f mm (%.4f to %.4f)\n",
                rung->name().c_str(), 1e3 * maxima[1], 1e3 * maxima[0], 1e3 * maxima[2], 1e3 * means[1], 1e3 * means[0],
                1e3 * means[2]);
    max[k] = maxima[1];
    rms[k] = means[1];
  }
  EXPECT_NEAR(max[0] / max[1], 1.0, 0.06);
  EXPECT_NEAR(rms[0] / rms[1], 1.0, 0.03);
}
TEST(PerturbationLong, FollowsMultibodyWithClearanceInAllTwelveJoints) { expect_twelve_joints_followed("0.3 s"); }
TEST(PerturbationNight, FollowsMultibodyWithClearanceInAllTwelveJointsForASecond) {
  expect_twelve_joints_followed("1 s");
}

TEST(ContactReport, AsksForSmallerStepsWhereTwoContactsShareALightLink) {
  const auto one = with_clearance_on([](const JointDescription& j) { return j.name == "B1"; }, "0.3 s");
  const auto all = with_clearance_on(takes_clearance, "0.3 s");
  const double alone = analyse_contacts(*one, one->parameters())[0].largest_stable_step;
  double together = 1.0;
  for (const ContactFrequency& f : analyse_contacts(*all, all->parameters()))
    if (f.joint == "B1") together = f.largest_stable_step;
  EXPECT_LT(together, 0.6 * alone);
  // The rungs know it: a step that serves one joint is refused, their own is not.
  EXPECT_THROW(run("multibody", all, 1.6 * alone), ComputationError);
  EXPECT_NO_THROW(run("multibody", all, 0.0));
  EXPECT_NO_THROW(run("perturbation", all, 0.0));
}

// A radio telescope weighs a million times what a gimbal does: loads, and the masses that contacts feel, are as many times larger, whatever
// the unit in which a body's own mobility is compared with its joint's.
TEST(ContactReport, GrowsWithTheMassesOfAllBodies) {
  const auto scaled = [](double by) {
    MechanismDescription d =
        read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/twelve-joints.toml", {{"motion.duration", "0.1 s"}});
    for (BodyDescription& b : d.bodies) {
      b.mass *= by;
      b.inertia *= by;
    }
    d.payload->mass *= by;
    const auto mechanism = scenes::build(std::move(d));
    return analyse_contacts(*mechanism, mechanism->parameters());
  };
  const std::vector<ContactFrequency> light = scaled(1.0), heavy = scaled(1e6);
  ASSERT_EQ(light.size(), 12u);
  for (std::size_t c = 0; c < light.size(); ++c) {
    EXPECT_GT(light[c].effective_mass, 0.0) << light[c].joint;
    EXPECT_NEAR(heavy[c].effective_mass / light[c].effective_mass / 1e6, 1.0, 1e-6) << light[c].joint;
    EXPECT_NEAR(heavy[c].typical_load / light[c].typical_load / 1e6, 1.0, 1e-6) << light[c].joint;
  }
}

// With play at one or both pins of its coupler.
std::shared_ptr<const Mechanism> driven_four_bar(int opened) {
  MechanismDescription d = scenes::planar_four_bar();
  d.bodies[0].boresight.reset();
  d.bodies[1].boresight = Vec3::UnitZ();
  d.joints[0].driven = true;
  d.motion.drives[0] = scenes::sine(0.3, 6.0);
  d.motion.duration = 0.4;
  scenes::add_clearance(d, 1, true);
  if (opened == 2) scenes::add_clearance(d, 2, true);
  return scenes::build(std::move(d));
}

// Planar loop in space: hinges elsewhere hold the pins' play along their axes, which is then no coordinate.
TEST(Perturbation, BearsRedundantJoints) {
  for (int opened : {1, 2}) {
    const auto mechanism = driven_four_bar(opened);
    const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
    const DeviationCoordinates coordinates(*mechanism, ideal);
    EXPECT_EQ(coordinates.leftover(), 0);
    EXPECT_EQ(coordinates.count(), opened == 1 ? 2 : 5);  // both pins' play moves the coupler along, together
    EXPECT_TRUE(coordinates.has_dependent());
    expect_close(run("perturbation", mechanism, 2e-5), run("multibody", mechanism, 2e-5), 0.04, 0.01,
                 std::to_string(opened) + " joints opened");
  }
}

// Against differences of the gains themselves, which are exact to 1e-9 at this step.
TEST(DeviationCoordinates, ChangeAsTheMotionGoesOn) {
  const std::shared_ptr<const Mechanism> mechanisms[] = {with_clearance_on(takes_clearance, "0.2 s"),
                                                         driven_four_bar(2)};
  for (const auto& mechanism : mechanisms) {
    const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
    DeviationCoordinates coordinates(*mechanism, ideal);
    constexpr double kStep = 1e-5;
    for (double share : {0.13, 0.5, 0.81}) {
      const double t = share * ideal.duration();
      MatX T, before, after, T_rate, rate_before, rate_after, T_second, unused, B_rate;
      coordinates.gain(t - kStep, before);
      const MatX B_before = coordinates.offsets_per_coordinate(before);
      coordinates.rates(before, rate_before, unused, B_rate);
      coordinates.gain(t + kStep, after);
      const MatX B_after = coordinates.offsets_per_coordinate(after);
      coordinates.rates(after, rate_after, unused, B_rate);
      coordinates.gain(t, T);
      coordinates.rates(T, T_rate, T_second, B_rate);
      const MatX T_difference = (after - before) / (2.0 * kStep), B_difference = (B_after - B_before) / (2.0 * kStep);
      EXPECT_GT(T_difference.norm(), 0.0);
      EXPECT_LT((T_rate - T_difference).norm(), 1e-6 * T_difference.norm()) << mechanism->name() << " at " << t;
      if (coordinates.has_dependent()) {
        const MatX second = (rate_after - rate_before) / (2.0 * kStep);
        EXPECT_LT((T_second - second).norm(), 1e-6 * second.norm()) << mechanism->name() << " at " << t;
      }
      EXPECT_LE((B_rate - B_difference).norm(), 1e-6 * std::max(1.0, B_difference.norm()))
          << mechanism->name() << " at " << t;
    }
  }
}

// What coordinates add to spins and slides while they stand still is what their rates' gains change by: seen from the sleeve, which turns, and
// across whose axis the journal's own spin carries a slope along.
TEST(ClearanceScene, KeepsTheDriftOfTheGainsWhereOffsetsHangOnEachOther) {
  for (const JointType first : {JointType::revolute, JointType::cylindrical}) {
    MechanismDescription d = driven_four_bar(2)->description();
    d.joints[1].type = first;
    for (ClearanceDescription& c : d.clearances)
      c.axes = first == JointType::cylindrical ? JournalAxes::free : JournalAxes::parallel;
    const auto mechanism = scenes::build(std::move(d));
    const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
    const ClearanceScene scene(*mechanism, ideal, mechanism->parameters(), 1e-9);
    const SceneTables tables = scene.tables(mechanism->parameters());
    const int n = tables.layout.n;
    constexpr double kStep = 1e-4;
    std::vector<double> before(tables.dynamics.width()), row = before, after = before;
    for (double t : {0.06, 0.17, 0.33}) {
      tables.dynamics.at(t - kStep, before.data());
      tables.dynamics.at(t, row.data());
      tables.dynamics.at(t + kStep, after.data());
      const auto rate = [&](int at) { return (after[at] - before[at]) / (2.0 * kStep); };
      double size = 0.0;
      for (const SceneLayout::Joint& joint : tables.layout.joints) {
        ASSERT_TRUE(joint.gains_move);
        for (int j = 0; j < n; ++j) {
          const double spin = row[joint.spin + (joint.tilts ? 1 : 0)];
          for (int i = 0; i < joint.spins; ++i) {
            double expected = rate(joint.spin_gain + i * n + j);
            if (joint.tilts && i == 0) expected -= spin * row[joint.spin_gain + 2 * n + j];
            if (joint.tilts && i == 2) expected += spin * row[joint.spin_gain + j];
            EXPECT_NEAR(row[joint.spin_drift + i * n + j], expected, 1e-4 * (1.0 + std::abs(expected)))
                << "spin " << i << " of " << j << " at " << t;
            size = std::max(size, std::abs(expected));
          }
          if (joint.slides) {
            const double expected = rate(joint.slide_gain + j);
            EXPECT_NEAR(row[joint.slide_drift + j], expected, 1e-4 * (1.0 + std::abs(expected)))
                << "slide of " << j << " at " << t;
          }
        }
      }
      EXPECT_GT(size, 0.1);
    }
  }
}

// Free mechanisms drift off their ideal motion: the deviation is many times the clearance after a while.
TEST(Perturbation, FollowsFreedomsThatNothingDrives) {
  const std::shared_ptr<const Mechanism> free[] = {undriven("four-bar", "0.2 s", 6.0),
                                                   undriven("crank-slider", "0.1 s", 30.0)};
  for (const auto& mechanism : free) {
    const RunResult exact = run("multibody", mechanism, 1e-5);
    EXPECT_GT(exact.index.position_error.max, 4.0 * mechanism->parameters().clearance[0].radial);
    expect_close(run("perturbation", mechanism, 1e-5), exact, 0.03, 0.03, mechanism->name());
  }
}

TEST(SceneRungs, WithoutDynamicsRefuseFreedomsThatNothingDrives) {
  const auto mechanism = undriven("crank-slider", "0.1 s", 30.0);
  for (const char* name : {"envelope", "quasistatic"})
    EXPECT_THROW(run(name, mechanism, 0.0), ComputationError) << name;
}

TEST(SceneRungs, KeepThePosesOfOtherBodies) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.01 s"}}));
  RunOptions options;
  options.step = 1e-5;
  options.sample_spacing = 1e-3;
  options.pose_bodies = {mechanism->body_index("rod1"), mechanism->body_index("tube2")};
  const RunResult exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  const RunResult cheap = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
  ASSERT_EQ(cheap.others.size(), 2u);
  for (std::size_t b = 0; b < 2; ++b) {
    ASSERT_EQ(cheap.others[b].samples.size(), exact.others[b].samples.size());
    double largest = 0.0, difference = 0.0;
    for (std::size_t k = 0; k < exact.time.size(); ++k) {
      const PoseSample &x = exact.others[b].samples[k], &y = cheap.others[b].samples[k];
      largest = std::max(largest, x.error.displacement.norm());
      difference = std::max(difference, (x.error.displacement - y.error.displacement).norm());
    }
    EXPECT_GT(largest, 1e-5);
    EXPECT_LT(difference, 0.02 * largest);
  }
}

TEST(SceneRungs, KeepFramesOfAllBodiesWithoutChangingAnything) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.01 s"}}));
  for (const std::string& name : rung_names()) {
    RunOptions options;
    options.sample_spacing = 5e-4;
    options.pose_bodies = {mechanism->body_index("rod1")};
    const RunResult plain = make_rung(name, mechanism)->run(mechanism->parameters(), options);
    EXPECT_TRUE(plain.frames.empty());
    options.frame_spacing = 2e-3;
    const RunResult result = make_rung(name, mechanism)->run(mechanism->parameters(), options);
    EXPECT_EQ(result.index.position_error.rms, plain.index.position_error.rms) << name;
    EXPECT_EQ(result.time, plain.time) << name;
    ASSERT_EQ(result.frames.size(), 6u) << name;
    for (std::size_t f = 0; f < result.frames.size(); ++f) {
      const Frame& frame = result.frames[f];
      EXPECT_NEAR(result.time[frame.sample], 2e-3 * static_cast<double>(f), 1e-4) << name;
      ASSERT_EQ(frame.pose.size(), static_cast<std::size_t>(mechanism->bodies())) << name;
      ASSERT_EQ(frame.ideal.size(), frame.pose.size()) << name;
      const BodyHistory &platform = result.boresight, &rod = result.others[0];
      // Static rungs add up the boresight's own pose apart from all others': equal but for rounding.
      EXPECT_LT((frame.pose[platform.body].p - platform.samples[frame.sample].pose.p).norm(), 1e-14) << name;
      EXPECT_EQ(frame.pose[rod.body].p, rod.samples[frame.sample].pose.p) << name;
      EXPECT_EQ(frame.ideal[rod.body].p, rod.samples[frame.sample].ideal.p) << name;
    }
  }
}

}  // namespace deviation_test
}  // namespace boresight
