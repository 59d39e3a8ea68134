// Pure geometry in batches: what the rungs give for the same samples one by one.
#include "boresight/scene/geometric_errors.hpp"

#include <gtest/gtest.h>

#include <string>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/scene/standing_model_error.hpp"
#include "error_scenes.hpp"

namespace boresight {
namespace geometric_errors_test {

struct Choice {
  PointingQuantity quantity;
  Statistics PointingIndices::*of;
};
constexpr Choice kQuantities[] = {{PointingQuantity::position_error, &PointingIndices::position_error},
                                  {PointingQuantity::orientation_error, &PointingIndices::orientation_error},
                                  {PointingQuantity::boresight_error, &PointingIndices::boresight_error},
                                  {PointingQuantity::line_of_sight_error, &PointingIndices::line_of_sight_error}};
struct Kept {
  TimeStatistic statistic;
  double Statistics::*of;
};
constexpr Kept kStatistics[] = {{TimeStatistic::max, &Statistics::max},
                                {TimeStatistic::rms, &Statistics::rms},
                                {TimeStatistic::mean, &Statistics::mean},
                                {TimeStatistic::p9973, &Statistics::p9973}};

// Only errors that the mechanism takes up.
Parameters taken_up(const Mechanism& mechanism, Parameters sample) {
  const IdealMotion ideal = ideal_motion(mechanism, mechanism.parameters());
  const auto all = StandingErrors::of_all(mechanism, ideal);
  for (std::size_t e = 0; e < sample.error.size(); ++e) {
    std::vector<double> alone(sample.error.size(), 0.0);
    alone[e] = sample.error[e];
    try {
      all->require(alone);
    } catch (const ComputationError&) {
      sample.error[e] = 0.0;
    }
  }
  return sample;
}

void expect_the_rungs(const std::shared_ptr<const Mechanism>& mechanism, const std::vector<Parameters>& samples,
                      double start, const std::string& name) {
  RunOptions options;
  options.sample_spacing = 0.0;
  options.start = start;
  const auto rung = make_rung("quasistatic", mechanism);
  std::vector<PointingIndices> expected;
  for (const Parameters& sample : samples) expected.push_back(rung->run(sample, options).index);
  for (const Choice& choice : kQuantities) {
    if (choice.quantity == PointingQuantity::line_of_sight_error && !expected[0].has_line_of_sight) continue;
    for (const Kept& kept : kStatistics) {
      std::vector<GeometricOutcome> outcomes(samples.size());
      const GeometricErrors geometry(mechanism, choice.quantity, kept.statistic, start);
      EXPECT_EQ(geometry.run(samples, outcomes), samples.size());
      for (std::size_t k = 0; k < samples.size(); ++k) {
        const Statistics& one = expected[k].*choice.of;
        EXPECT_EQ(outcomes[k].refusal, "");
        EXPECT_NEAR(outcomes[k].value, one.*kept.of, 1e-9 * one.*kept.of + 1e-18)
            << name << ", quantity " << static_cast<int>(choice.quantity) << ", statistic "
            << static_cast<int>(kept.statistic) << ", sample " << k << ", from " << start << " s";
        const bool has_peak = kept.statistic == TimeStatistic::max && one.max > 1e-12;
        EXPECT_EQ(outcomes[k].time_of_max, has_peak ? one.time_of_max : outcomes[k].time_of_max) << name;
      }
    }
  }
}

MechanismDescription without_play() {
  MechanismDescription m = scenes::rrcpr();
  m.clearances.clear();
  return m;
}

// Every fifth of all errors: of all kinds.
MechanismDescription with_many_errors() {
  MechanismDescription m = scenes::with_every_error(without_play());
  std::vector<ErrorDescription> some;
  for (std::size_t e = 0; e < m.errors.size(); e += 5) some.push_back(m.errors[e]);
  m.errors = some;
  return m;
}

TEST(GeometricErrors, GiveWhatTheRungGivesInEveryStatistic) {
  const auto mechanism = scenes::build(with_many_errors());
  ASSERT_TRUE(GeometricErrors::serve(*mechanism));
  std::vector<Parameters> samples;
  for (unsigned k = 0; k < 11; ++k) samples.push_back(scenes::with_scattered_errors(*mechanism, k));
  // Turns so large that no series serves: the linear pose is the same all the same.
  samples.push_back(scenes::with_scattered_errors(*mechanism, 11, 3e3));
  expect_the_rungs(mechanism, samples, 0.0, "default");
  expect_the_rungs(mechanism, samples, 0.30007, "default");
}

TEST(GeometricErrors, GiveWhatTheRungGivesOnEveryKindOfMechanism) {
  int compared = 0;
  for (const char* file : {"hexapod-6-ups", "universal-joint-shaft", "tip-tilt-mirror", "spherical-wrist", "lens-focus",
                           "two-axis-gimbal", "delta"}) {
    MechanismDescription m = read_mechanism(std::string(BORESIGHT_CORPUS) + "/" + file + ".toml");
    m.clearances.clear();
    const auto mechanism = scenes::build(scenes::with_every_error(m));
    if (!GeometricErrors::serve(*mechanism)) continue;
    expect_the_rungs(mechanism, {taken_up(*mechanism, scenes::with_scattered_errors(*mechanism, 1))}, 0.0, file);
    ++compared;
  }
  EXPECT_GE(compared, 4);
}

TEST(GeometricErrors, AreASamplesOwnToTheLastBit) {
  const auto mechanism = scenes::build(with_many_errors());
  const GeometricErrors geometry(mechanism, PointingQuantity::boresight_error, TimeStatistic::rms);
  std::vector<Parameters> samples;
  for (unsigned k = 0; k < 19; ++k) samples.push_back(scenes::with_scattered_errors(*mechanism, k));
  std::vector<GeometricOutcome> together(samples.size()), alone(samples.size());
  geometry.run(samples, together);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    geometry.run({&samples[k], 1}, {&alone[k], 1});
    EXPECT_EQ(alone[k].value, together[k].value);
    EXPECT_EQ(alone[k].model_error, together[k].model_error);
  }
}

// What the estimate for many samples says of second order, against each sample's exact closure.
TEST(GeometricErrors, SayWhatBeingLinearMisses) {
  const auto mechanism = scenes::build(with_many_errors());
  const GeometricErrors geometry(mechanism, PointingQuantity::position_error, TimeStatistic::max);
  const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
  const auto influence = StandingErrors::of_all(*mechanism, ideal);
  int below = 0;
  for (unsigned k = 0; k < 20; ++k) {
    const Parameters sample = scenes::with_scattered_errors(*mechanism, 100 + k, 10.0);
    GeometricOutcome out;
    geometry.run({&sample, 1}, {&out, 1});
    const auto missed = missed_by_linearity(*mechanism, ideal, *influence, sample);
    ASSERT_TRUE(missed);
    below += out.model_error * out.value < missed->position;
    EXPECT_LT(out.model_error * out.value, 100.0 * missed->position);
  }
  EXPECT_LE(below, 2);
}

std::shared_ptr<const Mechanism> read(const std::string& text) {
  return std::make_shared<const Mechanism>(read_mechanism_text(text, "scene.toml"));
}

constexpr const char* kNoGravity = "gravity = [\"0 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n";
std::string body(const std::string& name, const std::string& more = "") {
  return "[[body]]\nname = \"" + name +
         "\"\nmass = \"1 kg\"\ncenter_of_mass = [\"0 m\", \"0 m\", \"0 m\"]\n"
         "inertia = [\"0.01 kg m^2\", \"0.01 kg m^2\", \"0.01 kg m^2\"]\n" +
         more;
}
std::string joint(const std::string& name, const std::string& type, const std::string& parts, const std::string& point,
                  const std::string& more) {
  return "[[joint]]\nname = \"" + name + "\"\ntype = \"" + type + "\"\nconnects = [" + parts + "]\npoint = [" + point +
         "]\n" + more;
}

// A four-bar that passes 0.2 mm from where its coupler and rocker lie in line: there its crank's length tells most, in a hundredth of the turn.
std::string beside_a_toggle() {
  const std::string axis = "axis = [0, -1, 0]\n";
  return "format = 1\nname = \"beside a toggle\"\n" + std::string(kNoGravity) + body("crank") + body("coupler") +
         body("rocker", "boresight = [-0.03217242721926692, 0.0, 0.9994823334740945]\n") +
         joint("A", "revolute", "\"ground\", \"crank\"", "\"0 m\", \"0 m\", \"0 m\"", axis + "driven = true\n") +
         joint("B", "revolute", "\"crank\", \"coupler\"",
               "\"0.05403023058681398 m\", \"0 m\", \"0.08414709848078966 m\"", axis) +
         joint("C", "revolute", "\"coupler\", \"rocker\"",
               "\"0.2951677014316661 m\", \"0 m\", \"0.15012224648780903 m\"", axis) +
         joint("D", "revolute", "\"ground\", \"rocker\"", "\"0.3 m\", \"0 m\", \"0 m\"", axis) +
         "[motion]\nduration = \"1 s\"\ndrives = { A = \"2*pi*t\" }\n[[error]]\nname = \"len\"\njoint = \"B\"\n"
         "body = \"crank\"\ntranslation = [0.5403023058681398, 0.0, 0.8414709848078966]\nvalue = \"0.1 mm\"\n";
}

TEST(GeometricErrors, SayWhatIsMissedInAMomentBesideASingularPose) {
  const auto mechanism = read(beside_a_toggle());
  const double exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), {}).index.boresight_error.max;
  const RunResult linear = make_rung("quasistatic", mechanism)->run(mechanism->parameters(), {});
  const double value = linear.index.boresight_error.max;
  EXPECT_GT(exact, 1.1 * value);
  EXPECT_GE(linear.error.model_of(PointingQuantity::boresight_error) * value, 0.9 * (exact - value));
  GeometricOutcome out;
  GeometricErrors(mechanism, PointingQuantity::boresight_error, TimeStatistic::max, 0.0, mechanism->parameters().error)
      .run({&mechanism->parameters(), 1}, {&out, 1});
  EXPECT_GE(out.model_error * out.value, 0.9 * (exact - value));
}

// A turn of a drive and a shift on its arm miss together what neither misses alone; errors that are not there beside them change nothing.
TEST(GeometricErrors, SayWhatTwoErrorsMissTogetherAmongManyThatAreNotThere) {
  const auto with = [](int others) {
    std::string text =
        "format = 1\nname = \"arm\"\n" + std::string(kNoGravity) + body("arm") +
        body("tip", "boresight = [0, 0, 1]\n") +
        joint("A", "revolute", "\"ground\", \"arm\"", "\"0 m\", \"0 m\", \"0 m\"",
              "axis = [0, 0, 1]\ndriven = true\n") +
        joint("F", "fixed", "\"arm\", \"tip\"", "\"0.5 m\", \"0 m\", \"0.5 m\"", "") +
        "[motion]\nduration = \"1 s\"\ndrives = { A = \"0.001*t\" }\n"
        "[[error]]\nname = \"turn\"\ndrive = \"A\"\nvalue = 0.03\n"
        "[[error]]\nname = \"shift\"\njoint = \"F\"\nbody = \"arm\"\ntranslation = [0, 1, 0]\nvalue = \"21 mm\"\n";
    for (int k = 0; k < others; ++k)
      text += "[[error]]\nname = \"other" + std::to_string(k) +
              "\"\njoint = \"A\"\nbody = \"ground\"\ntranslation = [0, 0, 1]\nvalue = \"0 m\"\n";
    return read(text);
  };
  double alone = 0.0;
  for (const int others : {0, 10, 30}) {
    const auto mechanism = with(others);
    const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
    const auto influence = StandingErrors::of_all(*mechanism, ideal);
    const Parameters& sample = mechanism->parameters();
    const auto missed = missed_by_linearity(*mechanism, ideal, *influence, sample);
    ASSERT_TRUE(missed);
    GeometricOutcome out;
    GeometricErrors(mechanism, PointingQuantity::position_error, TimeStatistic::max, 0.0, sample.error)
        .run({&sample, 1}, {&out, 1});
    EXPECT_GE(out.model_error * out.value, 0.9 * missed->position) << others;
    if (others == 0) alone = out.model_error;
    EXPECT_NEAR(out.model_error, alone, 0.01 * alone) << others;
  }
}

// A part held twice cannot take an error up: that sample is refused by its name, those beside it are computed.
TEST(GeometricErrors, RefuseTheSampleThatStrainsAndNoOther) {
  MechanismDescription m = scenes::four_bar({{0, 0, 0}, {0, 0, 0.3}, {0.5, 0, 0.4}, {0.6, 0, 0}}, true, "0.5*sin(t)");
  m.errors.push_back(
      scenes::frame_error(m, ErrorDescription::Kind::rotation, m.joints[1].name, m.bodies[0].name, Vec3::UnitX()));
  m.errors.push_back(
      scenes::frame_error(m, ErrorDescription::Kind::translation, m.joints[1].name, m.bodies[0].name, Vec3::UnitZ()));
  const auto mechanism = scenes::build(m);
  const GeometricErrors geometry(mechanism, PointingQuantity::position_error, TimeStatistic::max);
  std::vector<Parameters> samples(2, mechanism->parameters());
  samples[0].error = {1e-4, 1e-4};
  samples[1].error = {0.0, 1e-4};
  std::vector<GeometricOutcome> outcomes(2);
  geometry.run(samples, outcomes);
  EXPECT_NE(outcomes[0].refusal.find(m.errors[0].name), std::string::npos) << outcomes[0].refusal;
  EXPECT_EQ(outcomes[1].refusal, "");
  EXPECT_GT(outcomes[1].value, 1e-5);
}

TEST(GeometricErrors, ServeWhereNoPlayCanMoveOnly) {
  EXPECT_FALSE(GeometricErrors::serve(*scenes::build(without_play()))) << "no errors";
  EXPECT_FALSE(GeometricErrors::serve(*scenes::build(scenes::with_every_error(scenes::rrcpr())))) << "F1 moves";
}

}  // namespace geometric_errors_test
}  // namespace boresight
