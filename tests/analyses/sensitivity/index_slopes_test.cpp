// Exact slopes of the indices are what differences of whole motions tend to.
#include "boresight_analyses/sensitivity/index_slopes.hpp"

#include <gmock/gmock.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/parameter_path.hpp"

namespace boresight {
namespace index_slopes_test {

MechanismDescription crank_slider() {
  MechanismDescription d = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/crank-slider/crank-slider.toml", {});
  for (const BodyDescription& b : d.bodies)
    if (b.boresight)
      d.line_of_sight = LineOfSightDescription{.from = b.center_of_mass, .target = Vec3::Zero(), .origin = {}};
  return d;
}

struct Scene {
  Mechanism mechanism{crank_slider()};
  PreparedScene prepared{mechanism, ideal_motion(mechanism, mechanism.parameters()), mechanism.parameters()};
  std::vector<ParameterPath> paths;
  std::vector<double> values;
  bool from_rest = false;

  Scene() {
    for (const char* path :
         {"clearance.A.radial", "clearance.A.contact.restitution", "clearance.A.friction.coefficient"})
      paths.emplace_back(mechanism.description(), path);
    for (const ParameterPath& path : paths) values.push_back(path.get(mechanism.parameters()));
  }
  // In flight from a given state, or from where the journal rests, which its clearance moves.
  IndexSlopes slopes(const std::vector<double>& v, const IndexChoice& index) const {
    SlopeOptions options;
    options.end = 8e-3;  // three impacts, none of which grazes
    options.points = 100;
    if (!from_rest) options.start_state = (VecX(6) << 2e-5, 1e-5, -1e-5, 0.02, 0.001, 0.03).finished();
    options.tolerance = 1e-11;
    options.control_derivatives = true;
    return index_slopes(
        mechanism, prepared,
        [this](const std::vector<double>& x) {
          Parameters p = mechanism.parameters();
          for (std::size_t k = 0; k < paths.size(); ++k) paths[k].set(p, x[k]);
          return p;
        },
        v, index, options);
  }
  double richardson(std::size_t k, const IndexChoice& index) const {
    const auto central = [&](double share) {
      std::vector<double> above = values, below = values;
      above[k] *= 1.0 + share;
      below[k] *= 1.0 - share;
      return (slopes(above, index).value - slopes(below, index).value) / (2.0 * share * values[k]);
    };
    // Below, the rounding of two motions, above, their curvature outweighs 1e-7 of the slope. Of a maximum, one instant, rounding leaves more
    // than of sums over all.
    const double h = index.statistic == "max" ? 4e-4 : 2e-4;
    return (4.0 * central(0.5 * h) - central(h)) / 3.0;
  }
};

void expect_exact(const Scene& scene, const IndexChoice& index) {
  const IndexSlopes exact = scene.slopes(scene.values, index);
  ASSERT_GE(exact.impacts, 2);
  ASSERT_EQ(exact.grazing, 0);
  for (std::size_t k = 0; k < scene.values.size(); ++k)
    EXPECT_NEAR(exact.by[k] / scene.richardson(k, index), 1.0, 1e-6) << index.title() << ", parameter " << k;
}

TEST(IndexSlopes, OfRmsAndMeanAreThoseOfRichardsonDifferencesThroughImpacts) {
  const Scene scene;
  expect_exact(scene, {"position_error", "rms"});
  expect_exact(scene, {"position_error", "mean"});
}
TEST(IndexSlopes, OfAMaximumIsThatOfRichardsonDifferencesWhileNoOtherTimeTakesItsPlace) {
  expect_exact(Scene(), {"position_error", "max"});
}
TEST(IndexSlopes, OfTheLineOfSightAreThoseOfRichardsonDifferences) {
  expect_exact(Scene(), {"line_of_sight_error", "rms"});
}
TEST(IndexSlopes, FollowTheClearanceAndTheStiffnessIntoWhereTheJournalRestsAtTheStart) {
  Scene scene;
  scene.from_rest = true;
  scene.paths[1] = ParameterPath(scene.mechanism.description(), "clearance.A.contact.stiffness_scale");
  scene.values[1] = scene.paths[1].get(scene.mechanism.parameters());
  for (const char* statistic : {"mean", "rms"}) {
    const IndexChoice index{"position_error", statistic};
    const IndexSlopes exact = scene.slopes(scene.values, index);
    EXPECT_EQ(exact.impacts, 0);
    // One micrometre more clearance, and the journal rests a micrometre lower.
    EXPECT_GT(exact.by[0], 0.1);
    for (std::size_t k : {0u, 1u})
      EXPECT_NEAR(exact.by[k] / scene.richardson(k, index), 1.0, 1e-4) << statistic << ", parameter " << k;
  }
}
TEST(IndexSlopes, LeaveOutWhatComesBeforeTheIndexBegins) {
  const Scene scene;
  const IndexChoice index{"position_error", "mean", 3e-3};
  const IndexSlopes exact = scene.slopes(scene.values, index);
  EXPECT_NE(exact.value, scene.slopes(scene.values, {"position_error", "mean"}).value);
  EXPECT_NEAR(exact.by[0] / scene.richardson(0, index), 1.0, 1e-6);
}

}  // namespace index_slopes_test
}  // namespace boresight
