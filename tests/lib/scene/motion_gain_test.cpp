#include "boresight/scene/motion_gain.hpp"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "boresight/contact_events/contact_jacobian.hpp"
#include "boresight/scene/offset_dynamics.hpp"

namespace boresight {
namespace motion_gain_test {

constexpr int kDependent = DeviationCoordinates::kDependent, kSlides = DeviationCoordinates::kSlides;

struct Play {
  const char* name;
  std::vector<int> source;  // of each offset
  int spins;
  bool gains_move;
  bool twists = false;
};

// The numbers of one joint, one block after the other, and nothing else.
SceneLayout layout_of(const Play& play, int n) {
  SceneLayout at;
  at.n = n;
  SceneLayout::Joint joint;
  joint.offsets = static_cast<int>(play.source.size());
  joint.tilts = joint.offsets >= 5;
  joint.rolls = joint.offsets == 6;
  for (int k = 0; k < joint.offsets; ++k) {
    joint.source[k] = play.source[k];
    joint.has_dependent = joint.has_dependent || play.source[k] == kDependent;
    joint.slides += play.source[k] == kSlides;
  }
  joint.spins = play.spins;
  joint.gains_move = play.gains_move;
  joint.twists = play.twists;
  const auto take = [&at](int numbers) { return std::exchange(at.width, at.width + numbers); };
  joint.spin = take(joint.spins);
  joint.spin_gain = take(joint.spins * n);
  joint.spin_drift = take(joint.spins * n);
  joint.slide = take(2 * joint.slides);
  joint.slide_gain = take(joint.slides * n);
  joint.slide_drift = take(joint.slides * n);
  joint.twist = take(2);
  joint.dependent = take(2 * joint.offsets * n);
  joint.shift = take(2 * joint.offsets);
  at.joints = {joint};
  return at;
}

// Every number of a row is another one, so that none stands in for its neighbour. The motion is linear in the state, and its difference is exact.
TEST(MotionGain, IsWhatAJointsMotionChangesByWithEachCoordinateAndRateWhateverItsPlayFrees) {
  constexpr int n = 4;
  const Play plays[] = {{"journal", {0, 1, 2}, 1, false},
                        {"journal that slides", {3, kSlides, 1}, 1, true},
                        {"pad", {kSlides, 2, kSlides}, 1, true},
                        {"pad whose corners turn with it", {kSlides, 2, kSlides}, 1, true, true},
                        {"the same where it tilts", {kSlides, 2, kSlides, 0, kDependent}, 3, true, true},
                        {"tied journal", {kDependent, 0, kDependent}, 1, true},
                        {"tilting journal", {0, 1, 2, 3, kDependent}, 3, false},
                        {"tied tilting journal", {kDependent, 3, kDependent, 0, kDependent}, 3, true},
                        {"rolling slider", {0, kSlides, 1, 2, 3, kDependent}, 3, true},
                        {"rolling slider by a coordinate", {kDependent, kSlides, 1, 2, kDependent, 3}, 3, true}};
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const Play& play : plays) {
    const SceneLayout at = layout_of(play, n);
    std::vector<double> row(static_cast<std::size_t>(at.width));
    for (double& number : row) number = any(random);
    VecX state(2 * n);
    for (double& number : state) number = any(random);
    const auto motion_at = [&](const VecX& y) {
      return numbers(play_motion(at, at.joints[0], row.data(), y.data(), y.data() + n));
    };
    MatX gain(kMotionNumbers, 2 * n);
    motion_gain(at, at.joints[0], row.data(), gain);
    double found = 0.0;
    for (int j = 0; j < 2 * n; ++j) {
      VecX moved = state;
      moved[j] += 1.0;
      const Eigen::Matrix<double, kMotionNumbers, 1> change = motion_at(moved) - motion_at(state);
      EXPECT_LT((gain.col(j) - change).norm(), 1e-13) << play.name << ", column " << j << "\n"
                                                      << gain.col(j).transpose() << "\n"
                                                      << change.transpose();
      found += change.norm();
    }
    EXPECT_GT(found, 1.0) << play.name;
  }
}

}  // namespace motion_gain_test
}  // namespace boresight
