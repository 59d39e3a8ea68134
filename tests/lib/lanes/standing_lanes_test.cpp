// Lanes of samples with standing errors: the rung's own results one by one, and nothing stale between samples.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight/mechanism/error.hpp"
#include "error_scenes.hpp"

namespace boresight {
namespace standing_lanes_test {

const Statistics& of(const PointingIndices& indices, PointingQuantity quantity) {
  switch (quantity) {
    case PointingQuantity::position_error:
      return indices.position_error;
    case PointingQuantity::orientation_error:
      return indices.orientation_error;
    case PointingQuantity::boresight_error:
      return indices.boresight_error;
    case PointingQuantity::line_of_sight_error:
      break;
  }
  return indices.line_of_sight_error;
}

constexpr PointingQuantity kQuantities[] = {PointingQuantity::position_error, PointingQuantity::orientation_error,
                                            PointingQuantity::boresight_error, PointingQuantity::line_of_sight_error};

void expect_the_rungs(const std::shared_ptr<const Mechanism>& mechanism, const Parameters& sample, const char* name) {
  RunOptions options;
  options.step = 2e-6;
  options.sample_spacing = 0.0;
  const PointingIndices expected = make_rung("perturbation", mechanism)->run(sample, options).index;
  for (const PointingQuantity quantity : kQuantities) {
    if (quantity == PointingQuantity::line_of_sight_error && !expected.has_line_of_sight) continue;
    LaneOutcome out;
    PerturbationLanes(mechanism, quantity).run({&sample, 1}, {&out, 1}, 1e-6);
    const Statistics& rung = of(expected, quantity);
    EXPECT_EQ(out.status, LaneStatus::done);
    // Second order: turns of some 1e-4 over the index.
    EXPECT_NEAR(out.max, rung.max, 1e-3 * rung.max + 1e-10) << name << ", quantity " << static_cast<int>(quantity);
    EXPECT_NEAR(std::sqrt(out.mean_square), rung.rms, 1e-3 * rung.rms + 1e-10) << name;
    EXPECT_NEAR(out.mean, rung.mean, 1e-3 * rung.mean + 1e-10) << name;
  }
}

MechanismDescription short_scene(JournalAxes axes, const char* journals = "centred") {
  MechanismDescription m =
      scenes::with_every_error(scenes::rrcpr({{"motion.duration", "0.03 s"}, {"initial.journals", journals}}));
  m.clearances[0].axes = axes;
  if (axes == JournalAxes::free) m.clearances[0].parameters.sleeve_length = 0.12;
  return m;
}

TEST(StandingLanes, FollowTheRungWithErrorsOfEveryKind) {
  for (const JournalAxes axes : {JournalAxes::parallel, JournalAxes::free}) {
    const auto mechanism = scenes::build(short_scene(axes));
    ASSERT_GT(mechanism->description().errors.size(), 100u);
    expect_the_rungs(mechanism, scenes::with_scattered_errors(*mechanism, 1),
                     axes == JournalAxes::free ? "free axes" : "parallel axes");
  }
}

TEST(StandingLanes, FollowTheRungAtRestAndInFreeFlight) {
  const auto at_rest = scenes::build(short_scene(JournalAxes::parallel, "rest"));
  expect_the_rungs(at_rest, scenes::with_scattered_errors(*at_rest, 2), "from rest");
  MechanismDescription floating = short_scene(JournalAxes::parallel);
  floating.gravity.setZero();
  const auto in_flight = scenes::build(floating);
  Parameters sample = scenes::with_scattered_errors(*in_flight, 3);
  sample.clearance[0].radial = sample.clearance[0].axial = 5e-4;
  expect_the_rungs(in_flight, sample, "in flight");
  LaneOutcome out;
  PerturbationLanes(in_flight, PointingQuantity::position_error).run({&sample, 1}, {&out, 1});
  EXPECT_GT(out.free_flight_share, 0.5);
}

TEST(StandingLanes, FollowTheRungWithPlayInTwelveJoints) {
  const auto mechanism = scenes::build(scenes::with_every_error(read_mechanism(
      std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/twelve-joints.toml", {{"motion.duration", "0.01 s"}})));
  const Parameters sample = scenes::with_scattered_errors(*mechanism, 4);
  RunOptions options;
  options.step = 1e-6;
  options.sample_spacing = 0.0;
  const Statistics expected = make_rung("perturbation", mechanism)->run(sample, options).index.position_error;
  LaneOutcome out;
  PerturbationLanes(mechanism, PointingQuantity::position_error).run({&sample, 1}, {&out, 1}, 1e-6);
  EXPECT_NEAR(out.max, expected.max, 1e-3 * expected.max);
  EXPECT_NEAR(std::sqrt(out.mean_square), expected.rms, 1e-3 * expected.rms);
}

// A thread of a screw that passes in 2 ms: steps of flights would leave its ripple out.
TEST(StandingLanes, ShowTheRippleOfAScrewBetweenLongSteps) {
  MechanismDescription m = scenes::rrcpr({{"motion.duration", "0.3 s"}, {"initial.journals", "rest"}});
  m.errors.push_back(scenes::drive_error(m, "P1", "sin(2*pi*t/0.002)"));
  const auto mechanism = scenes::build(m);
  Parameters sample = mechanism->parameters();
  // Half a micrometre, which shakes with half a g, beside 5 um of play: a tenth of the index.
  sample.error[0] = 0.5e-6;
  sample.clearance[0].radial = sample.clearance[0].axial = 5e-6;
  RunOptions options;
  options.step = 1e-5;
  options.sample_spacing = 0.0;
  const Statistics expected = make_rung("perturbation", mechanism)->run(sample, options).index.position_error;
  LaneOutcome out;
  PerturbationLanes(mechanism, PointingQuantity::position_error).run({&sample, 1}, {&out, 1});
  EXPECT_NEAR(out.max, expected.max, 0.005 * expected.max);
  EXPECT_NEAR(std::sqrt(out.mean_square), expected.rms, 0.005 * expected.rms);
  EXPECT_NEAR(out.mean, expected.mean, 0.005 * expected.mean);
}

TEST(StandingLanes, GiveEachSampleItsOwnBitsWhateverRunsBeside) {
  const auto mechanism = scenes::build(short_scene(JournalAxes::parallel));
  const PerturbationLanes lanes(mechanism, PointingQuantity::position_error);
  std::vector<Parameters> samples;
  for (unsigned k = 0; k < 21; ++k)
    samples.push_back(k % 4 == 3 ? mechanism->parameters() : scenes::with_scattered_errors(*mechanism, k));
  for (const LanePrecision precision : {LanePrecision::single_precision, LanePrecision::double_precision}) {
    std::vector<LaneOutcome> alone(samples.size()), together(samples.size());
    const LaneTarget* first = nullptr;
    for (const LaneTarget& target : lane_targets(precision)) {
      if (first == nullptr || first->fuses != target.fuses) {
        first = &target;
        for (std::size_t k = 0; k < samples.size(); ++k) lanes.run(target, {&samples[k], 1}, {&alone[k], 1});
      }
      lanes.run(target, samples, together);
      for (std::size_t k = 0; k < samples.size(); ++k) {
        EXPECT_EQ(together[k].max, alone[k].max) << target.name << ", sample " << k;
        EXPECT_EQ(together[k].mean_square, alone[k].mean_square) << target.name << ", sample " << k;
        EXPECT_EQ(together[k].time_of_max, alone[k].time_of_max) << target.name << ", sample " << k;
        EXPECT_EQ(together[k].steps, alone[k].steps) << target.name << ", sample " << k;
      }
    }
  }
}

// The scene of the sample before is not this one's: it hangs on where masses have their centres.
TEST(StandingLanes, BuildAnotherSceneWhereACentreOfMassHasMoved) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.03 s"}}));
  Parameters moved = mechanism->parameters();
  for (std::size_t b = 0; b < moved.body_center.size(); ++b) moved.body_center[b] += Vec3(0.05, -0.03, 0.04);
  const PerturbationLanes lanes(mechanism, PointingQuantity::position_error);
  const std::vector<Parameters> samples = {mechanism->parameters(), moved, mechanism->parameters()};
  std::vector<LaneOutcome> out(samples.size());
  lanes.run(samples, out, 1e-6);
  RunOptions options;
  options.step = 2e-6;
  options.sample_spacing = 0.0;
  const Statistics drawn = make_rung("perturbation", mechanism)->run(samples[0], options).index.position_error;
  const Statistics elsewhere = make_rung("perturbation", mechanism)->run(moved, options).index.position_error;
  EXPECT_GT(std::abs(drawn.rms - elsewhere.rms), 0.01 * drawn.rms);
  EXPECT_NEAR(std::sqrt(out[0].mean_square), drawn.rms, 1e-3 * drawn.rms);
  EXPECT_NEAR(std::sqrt(out[1].mean_square), elsewhere.rms, 1e-3 * elsewhere.rms);
  EXPECT_EQ(out[2].mean_square, out[0].mean_square);
}

// What an error loads a journal with along its axis, it is loaded with before the motion begins.
TEST(StandingLanes, StartWhereTheErrorsLoadsHaveTheJournalsRest) {
  const std::string text = R"toml(format = 1
name = "arm"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "arm"
mass = "2 kg"
center_of_mass = ["200 mm", "0 mm", "0 mm"]
inertia = ["0.01 kg m^2", "0.02 kg m^2", "0.02 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "A"
type = "revolute"
connects = ["ground", "arm"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 1, 0]
driven = true
[motion]
duration = "0.1 s"
drives = { A = "0.05*sin(20*t)" }
[[error]]
name = "lean"
joint = "A"
body = "ground"
rotation = [1, 0, 0]
value = "0 mrad"
[[clearance]]
joint = "A"
journal = "arm"
radial = "0.1 mm"
axial = "0.1 mm"
journal_radius = "10 mm"
cap_radius = "14 mm"
sleeve_length = "30 mm"
axes = "parallel"
[clearance.contact]
law = "flores"
restitution = 0.6
young = ["200 GPa", "200 GPa"]
poisson = [0.3, 0.3]
density = "7800 kg/m^3"
minimum_impact_speed = "1 mm/s"
)toml";
  const auto mechanism = std::make_shared<const Mechanism>(read_mechanism_text(text, "arm.toml"));
  Parameters sample = mechanism->parameters();
  sample.error[0] = 2e-3;
  RunOptions options;
  options.sample_spacing = 0.0;
  const Statistics expected = make_rung("perturbation", mechanism)->run(sample, options).index.position_error;
  LaneOutcome out;
  PerturbationLanes(mechanism, PointingQuantity::position_error).run({&sample, 1}, {&out, 1});
  EXPECT_NEAR(std::sqrt(out.mean_square), expected.rms, 0.01 * expected.rms);
  EXPECT_NEAR(out.mean, expected.mean, 0.01 * expected.mean);
}

}  // namespace standing_lanes_test
}  // namespace boresight
