// The loads that journals at rest go by: where those of a joint cancel, their last digits say which way it points.
#include "boresight/statics/reaction_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/ideal_solver.hpp"
#include "boresight/scene/riding_masses.hpp"
#include "boresight/statics/quasistatic.hpp"

namespace boresight {
namespace reaction_table_test {

std::shared_ptr<const Mechanism> example(const std::string& path, const std::vector<Setting>& settings = {}) {
  return std::make_shared<const Mechanism>(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + path, settings));
}

// r at one instant, of the mechanism closed there by Newton's method.
VecX solved_load(const Mechanism& mechanism, DeviationCoordinates& coordinates, const IdealMotion& ideal, double t) {
  const Parameters parameters = mechanism.parameters();
  IdealState state;
  ideal.state(t, state);
  EXPECT_TRUE(IdealSolver(mechanism).solve(t, state));
  MatX T;
  coordinates.gain(state, T);
  const Eigen::Index n = T.cols();
  VecX r = VecX::Zero(n);
  const auto groups = riding_masses(mechanism, parameters);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    VecX part = VecX::Zero(n);
    MatX per_gravity = MatX::Zero(n, 3);
    for (const RidingMass& mass : groups[g]) add_load(mass, state, T, part.data(), per_gravity.data());
    r += units_of(g, mechanism, parameters) * (part + per_gravity * parameters.gravity);
  }
  add_load_of_forces(mechanism, parameters, state, T, r);
  return r;
}

// The largest miss between the instants over the largest load, coordinate by coordinate.
double miss(const Mechanism& mechanism) {
  const Parameters parameters = mechanism.parameters();
  const PreparedScene prepared(mechanism, ideal_motion(mechanism, parameters), parameters);
  const StandingDisplacement none = prepared.standing(parameters);
  const ReactionTable table(mechanism, prepared, none, parameters);
  DeviationCoordinates coordinates(mechanism, prepared.ideal());
  VecX largest = VecX::Zero(coordinates.count()), off = largest;
  for (int i = 0; i < 101; ++i) {
    const double t = mechanism.duration() * (i + 0.37) / 101.0;
    const VecX exact = solved_load(mechanism, coordinates, prepared.ideal(), t);
    largest = largest.cwiseMax(exact.cwiseAbs());
    off = off.cwiseMax((table.at_time(t).reaction - exact).cwiseAbs());
  }
  return (off.array() / largest.array().max(1e-9 * largest.maxCoeff())).maxCoeff();
}

TEST(ReactionTable, HoldsTheLoadsOfTheMechanismSolvedAtTheInstant) {
  EXPECT_LT(miss(*example("3-rrcpr/3-rrcpr.toml")), 1e-9);
  EXPECT_LT(miss(*example("crank-slider/crank-slider.toml")), 1e-9);
  EXPECT_LT(miss(*example("four-bar/four-bar.toml")), 1e-9);
}

// How fine a scene's tables are is decided by what they miss, and so by rounding where that is at its bound.
TEST(ReactionTable, HasTheSameInstantsHoweverFineTheScene) {
  const auto mechanism = example("crank-slider/crank-slider.toml", {{"motion.duration", "0.3 s"}});
  const Parameters parameters = mechanism->parameters();
  for (const double accuracy : {1e-4, 2e-6, 1e-8}) {
    const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, parameters), parameters, accuracy);
    const ReactionTable table(*mechanism, prepared, prepared.standing(parameters), parameters);
    EXPECT_EQ(table.instants(), 601) << prepared.scene().knots();
    EXPECT_NEAR(table.spacing() * (table.instants() - 1), 0.3, 1e-15);
  }
}

// A mirror of 5 g on a table of 2 t, both on upright axes with end play: each lies on its own end face. The mirror's weight is
// 2.5e-6 of the table's.
TEST(ReactionTable, KnowsTheWeightOfALightPartOnAHeavyOne) {
  const auto mechanism = std::make_shared<const Mechanism>(read_mechanism_text(R"toml(format = 1
name = "a light part on a heavy one"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "table"
mass = "2000 kg"
center_of_mass = ["20 mm", "0 mm", "0 mm"]
inertia = ["100 kg m^2", "100 kg m^2", "100 kg m^2"]
[[body]]
name = "mirror"
mass = "0.005 kg"
center_of_mass = ["150 mm", "0 mm", "120 mm"]
inertia = ["4e-06 kg m^2", "4e-06 kg m^2", "4e-06 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "azimuth"
type = "revolute"
connects = ["ground", "table"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 0, 1]
driven = true
[[joint]]
name = "mirror"
type = "revolute"
connects = ["table", "mirror"]
point = ["100 mm", "0 mm", "120 mm"]
axis = [0, 0, 1]
driven = true
[motion]
duration = "20 ms"
drives = { azimuth = "0.02*sin(10*t)", mirror = "0.03*sin(20*t)" }
[[clearance]]
joint = "azimuth"
journal = "table"
radial = "0.02 mm"
axial = "0.05 mm"
cap_radius = "80 mm"
journal_radius = "60 mm"
sleeve_length = "100 mm"
axes = "parallel"
  [clearance.contact]
  law = "flores"
  restitution = 0.5
  young = ["207 GPa", "72 GPa"]
  poisson = [0.3, 0.33]
[[clearance]]
joint = "mirror"
journal = "mirror"
radial = "0.02 mm"
axial = "0.05 mm"
cap_radius = "8 mm"
journal_radius = "6 mm"
sleeve_length = "10 mm"
axes = "parallel"
  [clearance.contact]
  law = "flores"
  restitution = 0.5
  young = ["207 GPa", "72 GPa"]
  poisson = [0.3, 0.33]
)toml",
                                                                               "light.toml"));
  const Parameters parameters = mechanism->parameters();
  const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, parameters), parameters);
  const StandingDisplacement none = prepared.standing(parameters);
  const ReactionTable table(*mechanism, prepared, none, parameters);
  const ReactionTable::Instant now = table.at_time(0.3 * mechanism->duration());
  EXPECT_NEAR(now.load[0].force.head<3>().norm() / (2000.005 * 9.81), 1.0, 1e-3);  // and what accelerates it
  EXPECT_NEAR(std::abs(now.load[1].force[1]) / (0.005 * 9.81), 1.0, 1e-6);
  // Both drop by their end play, 0.1 mm, and by what the table's 20 kN press its face; with a mirror that hung in its play it was 0.07 mm.
  const double error = make_rests(mechanism)->run(parameters, {}).index.position_error.max;
  EXPECT_GT(error, 0.1e-3);
  EXPECT_LT(error, 0.12e-3);
}

}  // namespace reaction_table_test
}  // namespace boresight
