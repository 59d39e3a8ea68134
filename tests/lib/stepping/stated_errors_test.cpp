// What rungs state of their own errors, against multibody: stated must not be less than actual, nor so much
// that it says nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "bearing_pair_scenes.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/stepping/measured_error.hpp"
#include "finer_run.hpp"
#include "scenes.hpp"

namespace boresight {
namespace stated_errors_test {

struct Scene {
  const char* example;  // folder and file of examples/
  std::vector<Setting> settings;
  bool free_axes = false;
};

std::string words(const Scene& scene) {
  std::string text = scene.example;
  for (const Setting& s : scene.settings) text += ", " + s.path + " = " + s.value;
  return text + (scene.free_axes ? ", free axes" : "");
}

std::shared_ptr<const Mechanism> mechanism_of(const Scene& scene) {
  MechanismDescription d = read_mechanism(
      std::string(BORESIGHT_EXAMPLES) + "/" + scene.example + "/" + scene.example + ".toml", scene.settings);
  for (ClearanceDescription& c : d.clearances)
    if (scene.free_axes) c.axes = JournalAxes::free;
  return scenes::build(std::move(d));
}

struct Verdict {
  double actual = 0.0, stated = 0.0;  // where their ratio is largest
  void see(double a, double s) {
    if (a * stated >= actual * s) {
      actual = a;
      stated = s;
    }
  }
};

constexpr std::array kStatistics = {&Statistics::max, &Statistics::rms, &Statistics::mean};

// Multibody at half its own step and two neighbours: impacts make each a draw.
std::vector<PointingIndices> references(const std::shared_ptr<const Mechanism>& mechanism) {
  const auto multibody = make_rung("multibody", mechanism);
  RunOptions options;
  options.sample_spacing = 0.0;
  options.events = false;
  const RunResult own = multibody->run(mechanism->parameters(), options);
  std::vector<PointingIndices> runs;
  for (double share : {0.5, 0.49, 0.48})
    runs.push_back(multibody->run(mechanism->parameters(), finer_run(options, own, share)).index);
  return runs;
}

Verdict judge(const char* name, const std::shared_ptr<const Mechanism>& mechanism,
              const std::vector<PointingIndices>& exact) {
  const auto rung = make_rung(name, mechanism);
  RunOptions options;
  options.sample_spacing = 0.0;
  options.events = false;
  const RunResult result = rung->run(mechanism->parameters(), options);
  const MeasuredError steps = measure_discretisation(*rung, mechanism->parameters(), options, result);
  Verdict verdict;
  const double length = mechanism->characteristic_length();
  for (const auto quantity : {&PointingIndices::position_error, &PointingIndices::orientation_error}) {
    const bool turns = quantity == &PointingIndices::orientation_error;
    if (turns && length * (exact[0].*quantity).max < 1e-3 * exact[0].position_error.max) continue;
    for (const auto statistic : kStatistics) {
      double reference = 0.0;
      for (const PointingIndices& index : exact)
        reference += index.*quantity.*statistic / static_cast<double>(exact.size());
      if (!(reference > 0.0)) continue;
      const double value = result.index.*quantity.*statistic;
      verdict.see(std::abs(value / reference - 1.0), result.error.model_of(turns ? PointingQuantity::orientation_error
                                                                                 : PointingQuantity::position_error) +
                                                         steps.stated.*quantity.*statistic / value);
    }
  }
  return verdict;
}

// A scene and what multibody says of it: the same for all rungs that are judged by it.
struct KnownScene {
  Scene scene;
  std::shared_ptr<const Mechanism> mechanism;
  std::vector<PointingIndices> exact = {};
  std::string refusal = {};
};

std::vector<KnownScene> known(const std::vector<Scene>& scenes) {
  std::vector<KnownScene> all;
  for (const Scene& scene : scenes) {
    KnownScene& one = all.emplace_back(KnownScene{scene, mechanism_of(scene)});
    try {
      one.exact = references(one.mechanism);
    } catch (const ComputationError& refusal) {
      one.refusal = refusal.what();
    }
  }
  return all;
}

// Prints the table; returns the ratios of actual over stated.
std::vector<double> table(const char* rung, const std::vector<KnownScene>& scenes) {
  std::vector<double> ratios;
  for (const auto& [scene, mechanism, exact, no_reference] : scenes) {
    try {
      if (!no_reference.empty()) throw ComputationError(no_reference);
      const Verdict v = judge(rung, mechanism, exact);
      ratios.push_back(v.actual / v.stated);
      std::printf("%-12s off by %7.2f %%, states %7.2f %%, ratio %.2f: %s\n", rung, 100.0 * v.actual, 100.0 * v.stated,
                  ratios.back(), words(scene).c_str());
    } catch (const ComputationError& refusal) {
      std::printf("%-12s refuses: %s: %s\n", rung, words(scene).c_str(), refusal.what());
    }
  }
  std::sort(ratios.begin(), ratios.end());
  if (!ratios.empty())
    std::printf("%s: median ratio %.2f, largest %.2f\n", rung, ratios[ratios.size() / 2], ratios.back());
  return ratios;
}

const std::vector<Scene> kScenes = {
    {"2-us-pointing", {{"motion.duration", "0.3 s"}}},
    {"3-rrr", {{"motion.duration", "0.3 s"}}},
    {"crank-slider", {{"motion.duration", "0.3 s"}}},
    {"four-bar", {{"motion.duration", "0.3 s"}}},
    {"spatial-double-crank", {{"motion.duration", "0.3 s"}}},
    {"spatial-slider-crank", {{"motion.duration", "0.3 s"}}},
    {"flores-slider-crank", {}},
    {"3-rrcpr", {{"motion.duration", "0.3 s"}}},
    {"3-rrcpr", {{"motion.duration", "0.01 s"}}},
    {"3-rrcpr", {{"motion.duration", "0.3 s"}, {"clearance.F1.contact.restitution", "1"}}},
    {"3-rrcpr", {{"motion.duration", "0.3 s"}, {"clearance.F1.friction.coefficient", "0.5"}}},
    {"3-rrcpr", {{"motion.duration", "0.3 s"}, {"payload.mass", "250 kg"}}},
    {"3-rrcpr", {{"motion.duration", "0.2 s"}}, true},
};

TEST(StatedErrorsLong, OfEveryRungHoldAgainstMultibody) {
  const std::vector<KnownScene> scenes = known(kScenes);
  for (const char* rung : {"quasistatic", "envelope", "perturbation"}) {
    const std::vector<double> ratios = table(rung, scenes);
    ASSERT_FALSE(ratios.empty());
    EXPECT_LE(ratios.back(), 1.0) << rung;
    EXPECT_GE(ratios[ratios.size() / 2], 0.1) << rung << " states so much that it says nothing";
  }
}

// A motion that is over before anything settles.
TEST(StatedErrors, OfRestingJournalsHoldWhereNothingSettles) {
  const auto mechanism = mechanism_of({"3-rrcpr", {{"motion.duration", "0.01 s"}}});
  const Verdict v = judge("quasistatic", mechanism, references(mechanism));
  EXPECT_LE(v.actual, v.stated);
  EXPECT_LE(v.stated, 3.0 * v.actual);
}

// A plane mechanism's offsets across its plane hang on nothing but rounding: no share of the error. (What missed forces were seen to move is
// another matter: impacts make that large in the plane.)
TEST(StatedErrors, OfThePerturbationRungInAPlaneComeOfThePlane) {
  for (const char* example : {"3-rrr", "flores-slider-crank"}) {
    const auto mechanism = mechanism_of({example, {{"motion.duration", "0.02 s"}}});
    RunOptions options;
    options.sample_spacing = 0.0;
    options.model_look = ModelLook::shares;
    EXPECT_LT(make_rung("perturbation", mechanism)->run(mechanism->parameters(), options).error.largest_model(), 0.05)
        << example;
  }
}

// Samples that lose as much at an impact, but for a factor of two, share what was measured: whichever comes first, and on a rung of their own.
TEST(StatedErrors, OfSamplesFarFromTheNominalAreThoseOfTheNearestFactorOfTwo) {
  const auto mechanism = mechanism_of({"3-rrcpr", {{"motion.duration", "0.02 s"}}});  // restitution 0.9
  const auto stated = [&](const Rung& rung, double restitution) {
    Parameters parameters = mechanism->parameters();
    parameters.clearance[0].contact.restitution = restitution;
    RunOptions options;
    options.sample_spacing = 0.0;
    return rung.run(parameters, options).error.largest_model();
  };
  const auto one = make_rung("quasistatic", mechanism), other = make_rung("quasistatic", mechanism);
  const double nominal = stated(*one, 0.9), twice = stated(*one, 0.75), four = stated(*one, 0.6);
  EXPECT_EQ(stated(*one, 0.85), nominal);
  EXPECT_EQ(stated(*one, 0.72), twice);
  EXPECT_NE(twice, nominal);
  EXPECT_NE(four, twice);
  EXPECT_EQ(stated(*other, 0.72), twice);
  EXPECT_EQ(stated(*other, 0.9), nominal);
}

// So do those of a payload that the mechanism as drawn has not.
TEST(StatedErrors, OfSamplesWithWhatTheNominalHasNotAreThoseOfTheNearestPowerOfTwo) {
  const auto mechanism = mechanism_of({"3-rrcpr", {{"motion.duration", "0.02 s"}}});
  const auto stated = [&](const Rung& rung, double payload) {
    Parameters parameters = mechanism->parameters();
    parameters.payload_mass = payload;
    RunOptions options;
    options.sample_spacing = 0.0;
    return rung.run(parameters, options).error.largest_model();
  };
  const auto one = make_rung("quasistatic", mechanism), other = make_rung("quasistatic", mechanism);
  const double none = stated(*one, 0.0), four = stated(*one, 4.2), sixteen = stated(*one, 15.0);
  EXPECT_EQ(stated(*one, 3.1), four);
  EXPECT_EQ(stated(*other, 5.0), four);
  EXPECT_EQ(stated(*other, 0.0), none);
  EXPECT_NE(four, none);
  EXPECT_NE(sixteen, four);
}

TEST(StatedErrors, OfTheLinearDeviationGrowWithTheClearanceAndHoldInFlight) {
  for (const char* clearance : {"0.5 mm", "5 mm"}) {
    const auto mechanism = mechanism_of(
        {"3-rrcpr",
         {{"motion.duration", "0.012 s"}, {"clearance.F1.radial", clearance}, {"clearance.F1.axial", clearance}}});
    const Verdict v = judge("perturbation", mechanism, references(mechanism));
    EXPECT_LE(v.actual, v.stated) << clearance;
    EXPECT_LE(v.stated, 0.1) << clearance;
  }
}

// A linkage that stands still in its play, wide enough that the pose is not linear in it: the rungs agree, being linear both, and the static
// one states of every quantity what the dynamic one is off by that.
TEST(StatedErrors, OfRestingJournalsTakeInWhatTheLinearDeviationIsOffBy) {
  const auto mechanism = std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml", {{"motion.duration", "0.02 s"},
                                                                                   {"motion.drives.A", "0.4"},
                                                                                   {"initial.journals", "rest"},
                                                                                   {"clearance.D.cap_radius", "20 mm"},
                                                                                   {"clearance.D.radial", "5 mm"}}));
  const RunResult rest = make_rung("quasistatic", mechanism)->run(mechanism->parameters(), {});
  const RunResult motion = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
  ASSERT_NEAR(rest.index.position_error.max / motion.index.position_error.max, 1.0, 1e-4);
  for (const auto quantity : {PointingQuantity::position_error, PointingQuantity::orientation_error}) {
    const double of_linearity = motion.error.model_of(quantity);
    EXPECT_GT(of_linearity, 1e-3);
    // Or what its forces' share says, where that is more.
    EXPECT_GE(rest.error.model_of(quantity), 0.999 * of_linearity);
    EXPECT_LE(rest.error.model_of(quantity), 3.0 * of_linearity);
  }
}

// The envelope bounds journals that stay in contact; those that strike leave it, by what the warning says of the position. The slider
// does not turn.
TEST(Envelope, SaysByHowMuchImpactsExceedIt) {
  const auto mechanism = std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml",
                     {{"motion.duration", "0.1 s"}, {"initial.journals", "centred"}}));
  const RunResult bound = make_rung("envelope", mechanism)->run(mechanism->parameters(), {});
  const RunResult motion = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
  const std::string begin = "largest position error is ";
  double said = -1.0;
  for (const std::string& w : bound.warnings)
    if (const std::size_t at = w.find(begin); at != std::string::npos) said = std::stod(w.substr(at + begin.size()));
  const double above = 100.0 * (motion.index.position_error.max / bound.index.position_error.max - 1.0);
  ASSERT_GT(above, 2.0);
  // Said with two digits, of the largest of three neighbouring motions.
  EXPECT_NEAR(said, above, 0.15 * above);
}

// Turns count as much as displacements however large a mechanism is drawn, in metres or in kilometres.
TEST(StatedErrors, OfRestingJournalsHoldForTurnsOfALargeDrawing) {
  MechanismDescription d =
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml", {{"motion.duration", "0.1 s"}});
  d.journals = JournalStart::centred;
  for (const double scale : {1.0, 3000.0}) {
    const auto mechanism = scenes::build(scenes::drawn_elsewhere(d, Mat3::Identity(), Vec3::Zero(), scale));
    const RunResult rest = make_rung("quasistatic", mechanism)->run(mechanism->parameters(), {});
    const RunResult motion = make_rung("perturbation", mechanism)->run(mechanism->parameters(), {});
    // Turns are met far worse than displacements, and each states its own error.
    for (const auto quantity : {PointingQuantity::position_error, PointingQuantity::orientation_error})
      for (const auto statistic : {&Statistics::max, &Statistics::rms}) {
        const double off = std::abs(rest.index.of(quantity).*statistic / (motion.index.of(quantity).*statistic) - 1.0);
        EXPECT_LE(off, rest.error.model_of(quantity)) << scale;
      }
  }
}

}  // namespace stated_errors_test
}  // namespace boresight
