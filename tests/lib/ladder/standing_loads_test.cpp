// What standing errors change of the loads on the play: columns against the built mechanism, and what hangs on them.
#include "boresight/scene/standing_loads.hpp"

#include <gtest/gtest.h>

#include <set>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/scene/clearance_scene.hpp"
#include "error_scenes.hpp"

namespace boresight {
namespace standing_loads_test {

using scenes::drive_error, scenes::frame_error, scenes::with_every_error;

// r of a mechanism at the knots of a scene of its own.
struct Loads {
  explicit Loads(const Mechanism& mechanism, const IdealMotion& motion)
      : scene(mechanism, motion, mechanism.parameters()) {}
  VecX at(const Parameters& parameters, int knot) const {
    MatX M, C;
    VecX r;
    scene.assemble(parameters, knot, M, C, r);
    return r;
  }
  ClearanceScene scene;
};

// Many errors together, of the size of 1e-5: second order is some 1e-5 of a change.
void expect_columns(MechanismDescription m, const char* name) {
  m.motion.duration = std::min(m.motion.duration, 0.2);
  const auto mechanism = scenes::build(with_every_error(m));
  const auto commanded = std::make_shared<const IdealMotion>(ideal_motion(*mechanism, mechanism->parameters()));
  const auto influence = StandingErrors::of_all(*mechanism, *commanded);
  Parameters sample = scenes::with_scattered_errors(*mechanism, 7);
  sample.payload_mass += 3.0;
  for (double& mass : sample.body_mass) mass *= 1.1;
  sample.gravity = Vec3(1.0, -2.0, -9.0);
  const StandingLoads loads(*mechanism, *commanded);
  loads.change(mechanism->parameters(), *influence);  // another payload's columns are not left behind
  const StandingLoads::Change change = loads.change(sample, *influence);
  const Loads drawn(*mechanism, *commanded);
  const int n = drawn.scene.layout().n;
  ASSERT_GT(n, 0) << name;
  const BuiltMotion built = built_motion(mechanism, commanded, sample);
  const Loads exact(*built.mechanism, *built.motion);
  ASSERT_EQ(exact.scene.layout().n, n) << name;
  const TimeTable table = change.table(n);
  VecX largest = VecX::Zero(n), missed = largest;
  const int knots = std::min(drawn.scene.knots(), exact.scene.knots());
  for (int k = 0; k < knots; ++k) {
    const double t = mechanism->duration() * k / (knots - 1);
    const auto knot_of = [&](const Loads& of) { return static_cast<int>(std::lround(t / of.scene.spacing())); };
    VecX linear(n);
    table.at(t, linear.data());
    const VecX exactly = exact.at(sample, knot_of(exact)) - drawn.at(sample, knot_of(drawn));
    largest = largest.cwiseMax(exactly.cwiseAbs());
    missed = missed.cwiseMax((linear - exactly).cwiseAbs());
  }
  EXPECT_GT(largest.maxCoeff(), 0.0) << name;
  for (int i = 0; i < n; ++i)
    EXPECT_LT(missed[i], 2e-3 * std::max(largest[i], 1e-3 * largest.maxCoeff())) << name << ", coordinate " << i;
}

TEST(StandingLoads, AreThoseOfTheMechanismAsBuilt) {
  expect_columns(scenes::rrcpr(), "parallel axes");
  MechanismDescription free = scenes::rrcpr();
  free.clearances[0].axes = JournalAxes::free;
  free.clearances[0].parameters.sleeve_length = 0.12;
  expect_columns(free, "free axes");
  for (const char* archetype : {"stewart-secondary-mirror", "tip-tilt-mirror-on-balls"})
    expect_columns(read_mechanism(std::string(BORESIGHT_CORPUS) + "/" + archetype + ".toml"), archetype);
}

// Of a rod's tilt the light platform's loads need a finer grid than the heavy one's; which was asked for first is not heard.
TEST(StandingLoads, AreTheSameWhicheverSampleCameFirst) {
  MechanismDescription m = scenes::rrcpr();
  m.errors.push_back(frame_error(m, ErrorDescription::Kind::rotation, "P1", "rod1", Vec3(0.0, 1.0, 0.0)));
  const auto mechanism = scenes::build(m);
  const IdealMotion commanded = ideal_motion(*mechanism, mechanism->parameters());
  const auto influence = StandingErrors::of_all(*mechanism, commanded);
  std::vector<Parameters> samples(3, mechanism->parameters());
  for (Parameters& sample : samples) std::fill(sample.error.begin(), sample.error.end(), 1e-5);
  samples[0].gravity.setZero();
  samples[1].payload_mass = 500.0;
  samples[2].gravity = 100.0 * mechanism->parameters().gravity;
  std::vector<StandingLoads::Change> alone;
  for (const Parameters& sample : samples)
    alone.push_back(StandingLoads(*mechanism, commanded).change(sample, *influence));
  // Not all the same grid, or nothing is shown.
  std::set<double> spacings;
  for (const StandingLoads::Change& change : alone) spacings.insert(change.spacing);
  EXPECT_GT(spacings.size(), 1u);
  for (const std::vector<std::size_t>& order : {std::vector<std::size_t>{0, 1, 2}, std::vector<std::size_t>{2, 1, 0}}) {
    const StandingLoads loads(*mechanism, commanded);
    for (const std::size_t k : order) {
      const StandingLoads::Change now = loads.change(samples[k], *influence);
      EXPECT_EQ(now.spacing, alone[k].spacing) << "sample " << k << " with " << order.front() << " first";
      EXPECT_EQ(now.values, alone[k].values) << "sample " << k << " with " << order.front() << " first";
    }
  }
}

// An upright shaft carries its weight across none of its gaps along a level second axis: only the error that tilts it does.
TEST(StandingLoads, PushAJournalWhereNothingElseDoes) {
  MechanismDescription m =
      read_mechanism(std::string(BORESIGHT_CORPUS) + "/alt-az-antenna.toml", {{"motion.duration", "0.15 s"}});
  m.errors.push_back(frame_error(m, ErrorDescription::Kind::rotation, "azimuth", "ground", Vec3(1.0, 0.0, 0.0)));
  m.errors.back().value = 1e-3;
  const auto mechanism = scenes::build(m);
  RunOptions options;
  options.sample_spacing = 0.0;
  const Statistics exact =
      make_rung("multibody", mechanism)->run(mechanism->parameters(), options).index.position_error;
  const Statistics linear =
      make_rung("perturbation", mechanism)->run(mechanism->parameters(), options).index.position_error;
  EXPECT_NEAR(linear.rms, exact.rms, 0.003 * exact.rms);
}

// A screw's ripple of three micrometres at 300 Hz shakes with 10.7 m/s^2, more than gravity.
TEST(StandingLoads, ShakeTheJournalWithTheRippleOfAScrew) {
  MechanismDescription m = scenes::rrcpr({{"motion.duration", "0.1 s"}, {"initial.journals", "rest"}});
  m.errors.push_back(drive_error(m, "P1", "sin(2*pi*300*t)"));
  m.errors.back().value = 3e-6;
  const auto mechanism = scenes::build(m);
  RunOptions options;
  options.sample_spacing = 0.0;
  options.step = 5e-6;
  const auto penetration = [&](const char* rung, const Parameters& parameters) {
    return make_rung(rung, mechanism)->run(parameters, options).contact[0].max_force;
  };
  Parameters still = mechanism->parameters();
  still.error[0] = 0.0;
  const double exact = penetration("multibody", mechanism->parameters());
  EXPECT_GT(std::abs(exact - penetration("multibody", still)), 0.05 * exact);
  EXPECT_NEAR(penetration("perturbation", mechanism->parameters()), exact, 0.01 * exact);
}

}  // namespace standing_loads_test
}  // namespace boresight
