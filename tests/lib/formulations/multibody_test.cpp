// The paper's method on the paper's mechanism, against the figures of an independent program.
#include "boresight/multibody/multibody.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "reference/reference.hpp"
#include "scenes.hpp"

namespace boresight {
namespace multibody_test {

// Position error of the default scene over one second, gravity on, as Simbody follows it (tests/reference/simbody_figures.txt): clearance,
// payload, maximum and root mean square, each the least, the median and the largest of five runs at neighbouring accuracies: impacts make
// them a draw.
std::vector<reference::Row> simbody() { return reference::table("simbody_figures", "default mechanism"); }

// No further off the five than `share`.
void expect_among(double value, const reference::Row& r, std::size_t least, double share, const char* what) {
  EXPECT_GT(value, (1.0 - share) * r[least]) << what << " at " << r[0] << " m, " << r[1] << " kg";
  EXPECT_LT(value, (1.0 + share) * r[least + 2]) << what << " at " << r[0] << " m, " << r[1] << " kg";
}

RunResult run(const Rung& rung, const Mechanism& mechanism, const reference::Row& r, double step,
              const std::string& formulation = "") {
  Parameters p = mechanism.parameters();
  p.clearance[0].radial = p.clearance[0].axial = r[0];
  p.payload_mass = r[1];
  RunOptions options;
  options.step = step;
  options.sample_spacing = 0.0;
  options.formulation = formulation;
  return rung.run(p, options);
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

// At the paper's step a contact lasts a handful of steps and the maximum is set by single impacts, so that a change in the
// last bit of a parameter moves it by up to 1.5 %: the median over neighbouring steps is what can be held against a figure.
TEST(Multibody, GivesSimbodysFiguresAtThePapersStep) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const auto rung = make_multibody(mechanism);
  for (const reference::Row& r : simbody()) {
    std::vector<double> max, rms;
    for (double share : {1.0, 0.99, 0.98, 0.97, 0.96}) {
      const RunResult result = run(*rung, *mechanism, r, share * 1e-4, "paper");
      max.push_back(result.index.position_error.max);
      rms.push_back(result.index.position_error.rms);
      EXPECT_LT(result.index.orientation_error.max, 1e-7);
      EXPECT_LT(result.index.boresight_error.max, 1e-7);
    }
    // The step itself moves maximum and root mean square by up to 0.6 %, besides the 1.5 % that a maximum is a draw.
    expect_among(median(max), r, 2, 0.022, "maximum");
    expect_among(median(rms), r, 5, 0.01, "root mean square");
  }
}

TEST(MultibodyLong, ComesCloserToSimbodysFiguresAsTheStepShrinks) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const auto rung = make_multibody(mechanism);
  for (const reference::Row& r : simbody()) {
    const RunResult result = run(*rung, *mechanism, r, 1e-5);
    expect_among(result.index.position_error.max, r, 2, 0.005, "maximum");
    expect_among(result.index.position_error.rms, r, 5, 0.003, "root mean square");
    EXPECT_LT(result.index.orientation_error.max, 1e-9);
  }
}

TEST(Multibody, ProjectionKeepsTheConstraintsAndTheIndices) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const auto rung = make_multibody(mechanism);
  RunOptions options;
  options.step = 5e-5;
  const RunResult baumgarte = rung->run(mechanism->parameters(), options);
  options.stabilisation = "projection";
  const RunResult projection = rung->run(mechanism->parameters(), options);
  EXPECT_LT(projection.constraint_drift, 1e-13);
  EXPECT_NEAR(projection.index.position_error.rms / baumgarte.index.position_error.rms, 1.0, 0.003);
}

TEST(Multibody, AStepTooLargeIsStoppedNamingContactFrequencyAndLargestStep) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  RunOptions options;
  options.step = 1e-3;
  try {
    make_multibody(mechanism)->run(mechanism->parameters(), options);
    FAIL() << "ran through";
  } catch (const ComputationError& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("F1"), std::string::npos) << what;
    EXPECT_NE(what.find("rad/s"), std::string::npos) << what;
    EXPECT_NE(what.find("largest stable step"), std::string::npos) << what;
  }
}

TEST(Multibody, ASingularPoseStopsNamingTheLostMotion) {
  MechanismDescription description = scenes::rrcpr_with_legs(0.0, 0.1, 0.3);
  description.clearances.clear();
  const auto mechanism = scenes::build(description);
  try {
    make_multibody(mechanism)->run(mechanism->parameters(), {});
    FAIL() << "ran through";
  } catch (const ComputationError& e) {
    EXPECT_NE(std::string(e.what()).find("turns about (0, 0, 1)"), std::string::npos) << e.what();
  }
}

TEST(Multibody, TheSameRunTwiceGivesTheSameBits) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.1 s"}}));
  const auto rung = make_multibody(mechanism);
  const RunResult a = rung->run(mechanism->parameters(), {}), b = rung->run(mechanism->parameters(), {});
  EXPECT_EQ(a.index.position_error.max, b.index.position_error.max);
  EXPECT_EQ(a.index.position_error.rms, b.index.position_error.rms);
  ASSERT_EQ(a.events.size(), b.events.size());
}

TEST(Multibody, SamplesLieOnTheGridThatWasAskedFor) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.1 s"}}));
  RunOptions options;
  options.sample_spacing = 2e-3;
  const RunResult result = make_multibody(mechanism)->run(mechanism->parameters(), options);
  ASSERT_EQ(result.time.size(), 51u);
  for (std::size_t k = 0; k < result.time.size(); ++k)
    EXPECT_NEAR(result.time[k], 2e-3 * static_cast<double>(k), 1e-12);
}

TEST(Multibody, AsTheClearanceVanishesOnlyTheHertzDeflectionIsLeft) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.2 s"}}));
  const auto rung = make_multibody(mechanism);
  double last = 1.0;
  for (double c : {1e-4, 1e-5, 1e-6}) {
    Parameters p = mechanism->parameters();
    p.clearance[0].radial = p.clearance[0].axial = c;
    const RunResult result = rung->run(p, {});
    EXPECT_LT(result.index.position_error.max, last);
    last = result.index.position_error.max;
  }
  // At 1 um the stiffness is 5.4e11 N/m^1.5: some 300 N deflect it by about 1 um, and the error has a lever of order two.
  EXPECT_LT(last, 1e-5);
}

// A body's quaternion and its negative are the same pose: what closes the joints keeps the one that the state has, of length one.
TEST(PaperFormulation, KeepsUnitQuaternionsAndTheirSigns) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
  const auto formulation =
      make_paper_formulation(*mechanism, mechanism->parameters(), &ideal, {.stabilisation = Stabilisation::projection});
  IdealState state;
  ideal.state(0.3, state);
  constexpr int kPerBody = 13;
  for (const double sign : {1.0, -1.0}) {
    VecX y;
    formulation->start(state, y);
    std::vector<Eigen::Vector4d> before;
    for (int b = 0; b < mechanism->bodies(); ++b) {
      auto q = y.segment<4>(kPerBody * b + 3);
      q *= sign;
      before.push_back(q);
      y[kPerBody * b] += 1e-6 * (b + 1);  // open the joints, so that there is something to close
    }
    formulation->stabilise(0.3, y);
    VecX dy(y.size());
    formulation->derivative(0.3, y, std::vector<ContactMemory>(1), dy);
    EXPECT_LT(formulation->violation(), 1e-12);
    for (int b = 0; b < mechanism->bodies(); ++b) {
      const Eigen::Vector4d q = y.segment<4>(kPerBody * b + 3);
      EXPECT_NEAR(q.norm(), 1.0, 1e-12) << b;
      EXPECT_GT(q.dot(before[static_cast<std::size_t>(b)]), 1.0 - 1e-6) << b;
    }
  }
}

}  // namespace multibody_test
}  // namespace boresight
