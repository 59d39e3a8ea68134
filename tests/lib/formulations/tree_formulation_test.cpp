// The tree formulation against the paper's: two ways to write the same equations, which share no more than the force elements
// and the definition of a joint's rows.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>

#include "boresight/formulations/formulation.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/multibody/multibody.hpp"
#include "scenes.hpp"
#include "tree_formulation_scenes.hpp"

namespace boresight {
namespace tree_formulation_test {

double largest(const std::vector<Vec6>& v) {
  double result = 0.0;
  for (const Vec6& x : v) result = std::max(result, x.lpNorm<Eigen::Infinity>());
  return result;
}

// One mechanism in both formulations.
struct Pair {
  Pair(const Mechanism& m, const IdealMotion& ideal, const Parameters& parameters, bool with_clearance)
      : mechanism(m), memory(m.clearances()) {
    tree = make_tree_formulation(m, parameters, &ideal, {.with_clearance = with_clearance});
    paper = make_paper_formulation(m, parameters, &ideal,
                                   {.with_clearance = with_clearance, .stabilisation = Stabilisation::projection});
  }

  // Both at the state y of the tree: everything they report is the same.
  void expect_equal(double t, const VecX& y) {
    IdealState state;
    state.t = t;
    state.bodies = tree->bodies(t, y);
    paper->start(state, y_paper);
    VecX dy(y.size()), dy_paper(y_paper.size());
    tree->derivative(t, y, memory, dy);
    paper->derivative(t, y_paper, memory, dy_paper);
    std::vector<Vec6> difference = paper->acceleration();
    for (std::size_t b = 0; b < difference.size(); ++b) difference[b] -= tree->acceleration()[b];
    const double scale = std::max(1.0, largest(paper->acceleration()));
    EXPECT_LT(largest(difference) / scale, 1e-9) << mechanism.name() << ", t = " << t << " s, scale " << scale;
    EXPECT_LT(tree->violation(), 1e-12);
    EXPECT_LT(paper->violation(), 1e-12);
    EXPECT_NEAR(tree->energy(t, y), paper->energy(t, y_paper), 1e-12 * std::abs(paper->energy(t, y_paper)) + 1e-12);
    const MatX A = tree->offset_compliance(), B = paper->offset_compliance();
    ASSERT_EQ(A.rows(), B.rows());
    if (A.size() > 0) {
      EXPECT_LT((A - B).lpNorm<Eigen::Infinity>() / B.lpNorm<Eigen::Infinity>(), 1e-9);
    }
    // Coordinates read off the bodies put them where they were.
    VecX again;
    tree->start(state, again);
    double apart = 0.0;
    for (std::size_t b = 0; b < state.bodies.size(); ++b) {
      const BodyMotion &was = state.bodies[b], &is = tree->bodies(t, again)[b];
      apart =
          std::max({apart, (was.p - is.p).norm(), (was.R - is.R).norm(), (was.v - is.v).norm(), (was.w - is.w).norm()});
    }
    EXPECT_LT(apart, 1e-11);
  }

  const Mechanism& mechanism;
  std::vector<ContactMemory> memory;
  std::unique_ptr<Formulation> tree, paper;
  VecX y_paper;
};

// A state near `y` that satisfies all joints: pushed at random, then projected.
VecX pushed(Formulation& formulation, double t, VecX y, double by, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-by, by);
  for (double& x : y) x += uniform(random);
  formulation.stabilise(t, y);
  return y;
}

void compare_along(const Mechanism& mechanism, const IdealMotion& ideal, const Parameters& parameters,
                   bool with_clearance, int states = 20) {
  Pair pair(mechanism, ideal, parameters, with_clearance);
  std::mt19937 random(7);
  IdealState state;
  for (int k = 0; k <= states; ++k) {
    const double t = mechanism.duration() * k / states;
    ideal.state(t, state);
    VecX y;
    pair.tree->start(state, y);
    // By up to three times the clearance, so that journals touch in many of the states.
    y = pushed(*pair.tree, t, y, k % 2 == 0 ? 1e-4 : 3e-4, random);
    pair.expect_equal(t, y);
  }
}

TEST(TreeFormulation, AcceleratesAsThePapersOnTheExamples) {
  for (const char* file : {"3-rrcpr", "crank-slider", "four-bar"}) {
    const auto mechanism =
        scenes::build(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + file + "/" + file + ".toml", {}));
    const IdealMotion ideal = IdealMotion::kinematic(*mechanism);
    Parameters parameters = mechanism->parameters();
    compare_along(*mechanism, ideal, parameters, false);
    compare_along(*mechanism, ideal, parameters, true);
    parameters.payload_mass = 100.0;
    compare_along(*mechanism, ideal, parameters, true);
  }
}

// The clearances of a file may stand in another order than its joints.
TEST(TreeFormulation, AcceleratesAsThePapersWhereClearancesStandInAnyOrder) {
  MechanismDescription m = read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/twelve-joints.toml");
  std::reverse(m.clearances.begin(), m.clearances.end());
  const auto mechanism = scenes::build(std::move(m));
  compare_along(*mechanism, IdealMotion::kinematic(*mechanism), mechanism->parameters(), true, 4);
}

TEST(TreeFormulation, AcceleratesAsThePapersWithEveryTypeOfJoint) {
  struct Case {
    const char* what;
    std::vector<std::pair<int, bool>> opened;  // joint, journal on its first body
    JournalAxes axes = JournalAxes::parallel;
    bool drive_antenna = false;
  };
  constexpr JournalAxes kFree = JournalAxes::free;
  const Case cases[] = {{"none", {}},
                        {"one that closes a loop", {{8, true}}},
                        {"a cylindrical one", {{3, true}}},
                        {"a driven one", {{0, false}}},
                        {"one that alone carries its body", {{9, false}}},
                        {"one that alone carries its body, driven", {{9, true}}, JournalAxes::parallel, true},
                        {"several", {{0, true}, {3, false}, {8, true}, {9, true}}},
                        {"several that tilt", {{0, true}, {3, false}, {8, true}, {9, true}}, kFree},
                        {"several that tilt, one more driven", {{0, true}, {8, true}, {9, true}}, kFree, true}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.what);
    MechanismDescription description = scenes::menagerie(c.drive_antenna);
    for (const auto& [joint, first] : c.opened) scenes::add_clearance(description, joint, first, c.axes);
    const Mechanism mechanism(description);
    const IdealMotion laws = scenes::laws_only(mechanism);
    std::mt19937 random(3);
    for (bool with_clearance : {false, true}) {
      Pair pair(mechanism, laws, mechanism.parameters(), with_clearance);
      VecX y;
      pair.tree->start(scenes::at_home(mechanism), y);
      for (int k = 0; k < 100; ++k) {
        const double t = 0.01 * k;
        pair.tree->stabilise(t, y);  // follows the drives, 0.02 rad at a time
        // Far from rest where there is no contact; by some clearances, to and fro across contact, where there is.
        const bool contact = with_clearance && !c.opened.empty();
        pair.expect_equal(t, pushed(*pair.tree, t, y, contact ? 2e-4 : 0.05, random));
      }
    }
  }
}

// Largest distance between the bodies of two runs, until `end` or the tree's first contact.
double trajectories_apart(const Mechanism& mechanism, const IdealMotion& ideal, const IdealState& start, double end,
                          double h, bool with_clearance) {
  Pair pair(mechanism, ideal, mechanism.parameters(), with_clearance);
  VecX y, z;
  pair.tree->start(start, y);
  pair.paper->start(start, z);
  ExplicitRungeKutta tree_method(classical_rk4(), y.size()), paper_method(classical_rk4(), z.size());
  const auto tree = [&](double t, const VecX& s, VecX& ds) { pair.tree->derivative(t, s, pair.memory, ds); };
  const auto paper = [&](double t, const VecX& s, VecX& ds) { pair.paper->derivative(t, s, pair.memory, ds); };
  double apart = 0.0;
  for (int i = 0; i * h < end; ++i) {
    tree(i * h, y, tree_method.first_slope());
    paper(i * h, z, paper_method.first_slope());
    tree_method.step(i * h, h, y, tree);
    paper_method.step(i * h, h, z, paper);
    pair.tree->stabilise((i + 1) * h, y);
    pair.paper->stabilise((i + 1) * h, z);
    const std::vector<BodyMotion>& A = pair.tree->bodies((i + 1) * h, y);
    const std::vector<BodyMotion>& B = pair.paper->bodies((i + 1) * h, z);
    for (std::size_t b = 0; b < A.size(); ++b)
      apart = std::max({apart, (A[b].p - B[b].p).norm(), (A[b].R - B[b].R).norm()});
  }
  return apart;
}

// The first contact is at 4.18 ms. RK4's own error at h = 1e-5 s lies below 1e-12 m.
TEST(TreeFormulation, FollowsThePapersTrajectoryUpToTheFirstImpact) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const IdealMotion ideal = IdealMotion::kinematic(*mechanism);
  IdealState start;
  ideal.state(0.0, start);
  const double apart = trajectories_apart(*mechanism, ideal, start, 4.1e-3, 1e-5, true);
  EXPECT_LT(apart, 1e-9);
}

// Quaternions, successive turns and slides are integrated as what they are: the bodies follow the same paths as with six
// coordinates each. RK4's own errors, which differ, leave 2e-10 m at h = 2e-4 s
// (and sixteen times less at half of it).
TEST(TreeFormulation, FollowsThePapersTrajectoryWithEveryTypeOfJoint) {
  const Mechanism mechanism(scenes::menagerie());
  const IdealMotion laws = scenes::laws_only(mechanism);
  std::mt19937 random(11);
  IdealState start;
  {
    const auto tree = make_tree_formulation(mechanism, mechanism.parameters(), &laws, {});
    VecX y;
    tree->start(scenes::at_home(mechanism), y);
    start.bodies = tree->bodies(0.0, pushed(*tree, 0.0, y, 0.3, random));
  }
  const double apart = trajectories_apart(mechanism, laws, start, 0.3, 2e-4, false);
  EXPECT_LT(apart, 1e-9);
}

// Loops with more rows than they need: planar four-bar drawn in space (three rows too many, which its tree satisfies by
// itself), Bricard's six-bar loop (one too many, nowhere alone). Both fall from rest, so the energy stays what it was.
TEST(TreeFormulation, BearsRedundantLoops) {
  for (const MechanismDescription& description : {scenes::planar_four_bar(), scenes::bricard()}) {
    const Mechanism mechanism(description);
    const IdealMotion laws = scenes::laws_only(mechanism);
    Pair pair(mechanism, laws, mechanism.parameters(), true);
    IdealState start = scenes::at_home(mechanism);
    VecX y;
    pair.tree->start(start, y);
    const double energy = pair.tree->energy(0.0, y);
    ExplicitRungeKutta method(classical_rk4(), y.size());
    const auto derivative = [&](double t, const VecX& s, VecX& ds) { pair.tree->derivative(t, s, pair.memory, ds); };
    const double h = 1e-3;
    double fastest = 0.0;
    for (int i = 0; i < 1000; ++i) {
      derivative(i * h, y, method.first_slope());
      EXPECT_LT(pair.tree->violation(), 1e-12) << mechanism.name();
      fastest = std::max(fastest, y.tail(y.size() / 2).lpNorm<Eigen::Infinity>());
      if (i % 100 == 0) pair.expect_equal(i * h, y);
      method.step(i * h, h, y, derivative);
      pair.tree->stabilise((i + 1) * h, y);
    }
    EXPECT_GT(fastest, 1.0) << mechanism.name() << " must move";
    EXPECT_NEAR(pair.tree->energy(1.0, y), energy, 1e-7) << mechanism.name();  // of about 20 J turned over; RK4 at 1 ms
  }
}

// Nothing is left to integrate: a driven arm, and a rigid one fixed to it, with and without a hinge that closes a loop of
// rows only. The state is empty and the bodies still follow the drive.
TEST(TreeFormulation, FollowsDrivesThatPrescribeEverything) {
  for (bool looped : {false, true}) {
    MechanismDescription m;
    const int arm = scenes::add_body(m, "arm", 1.0, {0.1, 0.0, 0.0}, Vec3::Zero());
    const int hand = scenes::add_body(m, "hand", 1.0, {0.3, 0.0, 0.0}, {0.0, 0.0, 0.3});
    scenes::add_joint(m, JointType::revolute, kGround, arm, Vec3::Zero(), Vec3::UnitY(), scenes::sine(0.3, 3.0));
    scenes::add_joint(m, JointType::fixed, arm, hand, {0.2, 0.0, 0.0}, Vec3::UnitX());
    if (looped) scenes::add_joint(m, JointType::revolute, hand, kGround, {0.0, 0.1, 0.0}, Vec3::UnitY());
    const auto mechanism = scenes::build(m);
    RunOptions options;
    options.formulation = "tree";
    options.step = 1e-2;
    const RunResult result = make_multibody(mechanism)->run(mechanism->parameters(), options);
    EXPECT_LT(result.index.position_error.max, 1e-12);
    EXPECT_LT(result.constraint_drift, 1e-12);
  }
}

// Opened by centimetres, the loops close in Newton's steps: as far as rounding lets them, and velocities with them.
TEST(TreeFormulation, ClosesLoopsThatAreWideOpen) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const IdealMotion ideal = IdealMotion::kinematic(*mechanism);
  const auto tree = make_tree_formulation(*mechanism, mechanism->parameters(), &ideal, {});
  const std::vector<ContactMemory> memory(1);
  IdealState start;
  ideal.state(0.3, start);
  VecX y, dy;
  tree->start(start, y);
  dy = y;
  y.array() += 0.02;
  tree->derivative(0.3, y, memory, dy);
  EXPECT_GT(tree->violation(), 1e-3);
  tree->stabilise(0.3, y);
  tree->derivative(0.3, y, memory, dy);
  EXPECT_LT(tree->violation(), 1e-14);
  VecX again = y;
  tree->stabilise(0.3, again);
  EXPECT_LT((again - y).lpNorm<Eigen::Infinity>(), 1e-13) << "a closed loop stays as it is";
}

// Impacts make the two runs part in the end; the indices must not notice. Same step, same contacts: far below 0.3 %.
TEST(TreeFormulation, GivesTheIndicesOfThePapers) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const auto rung = make_multibody(mechanism);
  RunOptions options;
  options.step = 2e-5;
  options.sample_spacing = 0.0;
  options.formulation = "paper";
  const RunResult paper = rung->run(mechanism->parameters(), options);
  options.formulation = "tree";
  const RunResult tree = rung->run(mechanism->parameters(), options);
  EXPECT_EQ(tree.formulation, "tree");
  EXPECT_NEAR(tree.index.position_error.max / paper.index.position_error.max, 1.0, 3e-3);
  EXPECT_NEAR(tree.index.position_error.rms / paper.index.position_error.rms, 1.0, 3e-3);
  EXPECT_EQ(tree.contact[0].impacts, paper.contact[0].impacts);
  EXPECT_LT(tree.constraint_drift, 1e-13);
}

void expect_closed_loops(double duration, double drift) {
  MechanismDescription description = scenes::rrcpr();
  description.motion.duration = duration;
  const auto mechanism = scenes::build(description);
  RunOptions options;
  options.formulation = "tree";
  options.step = 1e-4;
  options.sample_spacing = 0.0;
  const RunResult result = make_multibody(mechanism)->run(mechanism->parameters(), options);
  EXPECT_DOUBLE_EQ(result.end_time, duration);
  EXPECT_LT(result.constraint_drift, drift);
}
// Rounds of two seconds with some hundred impacts each. What steps left open would add up round by round: a tenth of the rounds may leave a tenth.
TEST(TreeFormulation, KeepsItsLoopsClosedForTenSeconds) { expect_closed_loops(10.0, 1e-11); }
TEST(TreeFormulationNight, KeepsItsLoopsClosedForAHundredSeconds) { expect_closed_loops(100.0, 1e-10); }

}  // namespace tree_formulation_test
}  // namespace boresight
