// What the linear deviation leaves out is a share: of what, and that it does not hang on how large a mechanism is drawn.
#include "boresight/perturbation/second_order.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "bearing_pair_scenes.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"

namespace boresight {
namespace second_order_test {

// Journals that tilt in flight, so that all motions are the same ones on any scale, gravity being scaled with the lengths. (Those whose
// axes stay parallel leave next to nothing out there.)
TEST(SecondOrderShare, IsTheSameOnEveryScaleOfADrawing) {
  const auto share = [](double scale) {
    MechanismDescription m = scenes::gimbal({"A1", "A2", "E1", "E2"}, JournalAxes::free);
    m.journals = JournalStart::centred;
    m.motion.duration = 2e-3;
    RunOptions options;
    options.step = 2e-5;
    const auto mechanism = scenes::build(scenes::drawn_elsewhere(m, Mat3::Identity(), Vec3::Zero(), scale));
    const RunResult result = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
    for (const ContactSummary& c : result.contact) EXPECT_EQ(c.contact_fraction, 0.0);
    return result.error.largest_model();
  };
  const double plain = share(1.0);
  EXPECT_GT(plain, 1e-5);
  EXPECT_LT(plain, 1.0);
  for (const double scale : {0.05, 0.4, 20.0}) EXPECT_NEAR(share(scale) / plain, 1.0, 1e-6) << scale;
}

// Deviations are looked at where they are large. What is missed there is missed all along where it hardly changes: of a motion that is mostly
// half as far off it is twice the share.
TEST(SecondOrderShare, CountsAgainstTheMotionsOwnMeansWhereTheseAreLess) {
  MechanismDescription m = scenes::gimbal({"A1", "A2", "E1", "E2"}, JournalAxes::free);
  m.journals = JournalStart::centred;
  const auto mechanism = scenes::build(std::move(m));
  const Parameters& parameters = mechanism->parameters();
  const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, parameters), parameters);
  const int n = prepared.scene().layout().n, body = mechanism->boresight_body();
  LargestDeviations largest(mechanism->duration());
  const VecX z = VecX::LinSpaced(n, 2e-5, 5e-5);
  largest.add(0.5 * mechanism->duration(), 1.0, z, VecX::Zero(n));
  std::vector<double> gain(static_cast<std::size_t>(6 * n));
  prepared.pose_gain(body).at(0.5 * mechanism->duration(), gain.data());
  const Vec6 x = Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>>(gain.data(), 6, n) * z;

  const auto position = [&](double rms, double mean, double start = 0.0) {
    PointingIndices index;
    index.position_error = {
        .max = x.head<3>().norm(), .rms = rms * x.head<3>().norm(), .mean = mean * x.head<3>().norm()};
    return second_order(*mechanism, prepared, parameters, largest, index, start, false).pose[0];
  };
  const double alone = position(1.0, 1.0);
  ASSERT_GT(alone, 1e-6);
  ASSERT_LT(alone, 0.1);
  EXPECT_NEAR(position(0.5, 1.0) / alone, 2.0, 1e-5);  // closing the joints moves z a little
  EXPECT_NEAR(position(0.5, 0.25) / alone, 4.0, 1e-5);
  // Errors besides the play's make the index larger, and not what is missed smaller.
  EXPECT_EQ(position(3.0, 2.0), alone);
  // What is missed before the indices begin to count is none of theirs.
  largest.add(0.1 * mechanism->duration(), 2.0, 3.0 * z, VecX::Zero(n));
  EXPECT_GT(position(3.0, 2.0), 2.0 * alone);
  EXPECT_EQ(position(3.0, 2.0, 0.3 * mechanism->duration()), alone);
}

// A slider-crank in the x-z plane that stands still under its weight: the crank pin at P, a rod of length L from there to a slider on the x axis.
// With play in the pin its displacement is the coordinate, and with d = sqrt(L^2 - P_z^2) the kinetic energy is that of
//   slider:  xdot = u - P_z w / d        rod: its centre (u - P_z w / (2 d), w / 2), its turning w / d        where Pdot = (u, w).
struct StandingSliderCrank {
  static constexpr double kRod = 0.3, kRodMass = 0.8, kSliderMass = 1.7, kRodInertia = 0.009;
  static inline const Vec3 kPin{0.03, 0.0, 0.08};

  static Eigen::Matrix2d inverse_mass(double z) {
    const double d = std::sqrt(kRod * kRod - z * z);
    const Eigen::RowVector2d slider(1.0, -z / d), along(1.0, -0.5 * z / d), up(0.0, 0.5), turning(0.0, 1.0 / d);
    return (kSliderMass * slider.transpose() * slider + kRodMass * along.transpose() * along +
            kRodMass * up.transpose() * up + kRodInertia * turning.transpose() * turning)
        .inverse();
  }

  static std::shared_ptr<const Mechanism> drawn() {
    const Vec3 end(kPin.x() + std::sqrt(kRod * kRod - kPin.z() * kPin.z()), 0.0, 0.0);
    MechanismDescription m;
    m.name = "slider-crank";
    m.gravity = Vec3(0.0, 0.0, -9.81);
    const int crank = scenes::add_body(m, "crank", 1.0, 0.5 * kPin, Vec3::Zero());
    const int rod = scenes::add_body(m, "rod", kRodMass, 0.5 * (kPin + end), Vec3::Zero());
    // Guided a little above the rod's end, which is what keeps it from rolling.
    const Vec3 guide = end + Vec3(0.0, 0.0, 0.02);
    const int slider = scenes::add_body(m, "slider", kSliderMass, guide, Vec3::Zero());
    m.bodies[rod].inertia = kRodInertia * Mat3::Identity();
    m.bodies[slider].inertia = 0.01 * Mat3::Identity();
    m.bodies[crank].boresight.reset();
    m.bodies[slider].boresight = Vec3::UnitZ();
    scenes::add_joint(m, JointType::revolute, kGround, crank, Vec3::Zero(), Vec3::UnitY(), scenes::sine(0.0, 1.0));
    const int pin = scenes::add_joint(m, JointType::revolute, crank, rod, kPin, Vec3::UnitY());
    scenes::add_joint(m, JointType::spherical, rod, slider, end, Vec3::UnitY());
    scenes::add_joint(m, JointType::cylindrical, kGround, slider, guide, Vec3::UnitX());
    scenes::add_clearance(m, pin, false);
    m.motion.duration = 0.1;
    return scenes::build(std::move(m));
  }
};

// Eigenvalues, since the sleeve's axes are the drawing's choice.
TEST(SecondOrder, HasTheInverseMassChangeByWhatADisplacedPinMakesOfIt) {
  const auto mechanism = StandingSliderCrank::drawn();
  const Parameters& parameters = mechanism->parameters();
  const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, parameters), parameters);
  const SceneLayout& at = prepared.scene().layout();
  const int across[] = {at.joints[0].source[0], at.joints[0].source[2]};
  ASSERT_GE(across[0], 0);
  ASSERT_GE(across[1], 0);
  const double t = 0.5 * mechanism->duration();
  std::vector<double> gain(static_cast<std::size_t>(6 * at.n));
  prepared.pose_gain(1).at(t, gain.data());
  const MatX E = Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>>(gain.data(), 6, at.n);
  const Vec3 to_pin = StandingSliderCrank::kPin - mechanism->description().bodies[1].center_of_mass;
  const Eigen::Matrix2d drawn = StandingSliderCrank::inverse_mass(StandingSliderCrank::kPin.z());
  for (const Eigen::Vector2d& offsets :
       {Eigen::Vector2d(2e-4, 3e-4), Eigen::Vector2d(-2e-4, 3e-4), Eigen::Vector2d(3e-4, -3e-4)}) {
    VecX z = VecX::Zero(at.n);
    for (int i = 0; i < 2; ++i) z[across[i]] = offsets[i];
    const Vec6 rod = E * z;
    const double up = (rod.head<3>() + rod.tail<3>().cross(to_pin)).z();
    ASSERT_GT(std::abs(up), 1e-4);
    LargestDeviations largest(mechanism->duration());
    largest.add(t, 1.0, z, VecX::Zero(at.n));
    const SecondOrder found = second_order(*mechanism, prepared, parameters, largest, PointingIndices{}, 0.0, true);
    ASSERT_EQ(found.missed.size(), 1u);
    Eigen::Matrix2d change;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) change(i, j) = found.missed[0].inverse_mass(across[i], across[j]);
    const Eigen::Matrix2d exact = StandingSliderCrank::inverse_mass(StandingSliderCrank::kPin.z() + up) - drawn;
    const Eigen::Vector2d mine = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(change).eigenvalues(),
                          theirs = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(exact).eigenvalues();
    EXPECT_LT((mine - theirs).norm(), 0.01 * theirs.norm()) << mine.transpose() << "; " << theirs.transpose();
    EXPECT_EQ(change(0, 1), change(1, 0));
  }
}

}  // namespace second_order_test
}  // namespace boresight
