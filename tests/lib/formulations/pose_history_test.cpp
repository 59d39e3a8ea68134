// Velocities and accelerations in the perturbation rung's histories are the derivatives of its poses.
#include <gtest/gtest.h>

#include <algorithm>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"

namespace boresight {
namespace pose_history_test {

// Angular velocity that takes one orientation to another within a time, world axes.
Vec3 turn_rate(const Quat& from, const Quat& to, double time) {
  const Eigen::AngleAxisd turn(to * from.conjugate());
  const double angle = turn.angle() > M_PI ? turn.angle() - 2.0 * M_PI : turn.angle();
  return angle / time * turn.axis();
}

TEST(Perturbation, VelocitiesAndAccelerationsAreTheDerivativesOfItsPoses) {
  // Free axes turn the platform too; in free flight nothing but the missing terms could differ.
  MechanismDescription d =
      scenes::rrcpr({{"clearance.F1.radial", "2 mm"}, {"clearance.F1.axial", "2 mm"}, {"motion.duration", "0.01 s"}});
  d.clearances[0].axes = JournalAxes::free;
  const auto mechanism = scenes::build(std::move(d));
  RunOptions options;
  options.step = options.sample_spacing = 1e-5;
  options.start_offset = 3e-4;
  options.pose_bodies = {mechanism->body_index("rod1")};
  const RunResult run = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options);
  ASSERT_EQ(run.contact[0].impacts, 0);
  for (const std::vector<PoseSample>* history : {&run.boresight.samples, &run.others[0].samples}) {
    const std::vector<PoseSample>& s = *history;
    double v = 0.0, w = 0.0, a = 0.0, alpha = 0.0, v_size = 0.0, w_size = 0.0, a_size = 0.0, alpha_size = 0.0;
    for (std::size_t k = 1; k + 1 < s.size(); ++k) {
      const double time = run.time[k + 1] - run.time[k - 1];
      const Vec3 ideal_v = (s[k + 1].ideal.p - s[k - 1].ideal.p) / time,
                 ideal_w = turn_rate(s[k - 1].ideal.q, s[k + 1].ideal.q, time);
      v = std::max(v, ((s[k + 1].pose.p - s[k - 1].pose.p) / time - s[k].v).norm());
      w = std::max(w, (turn_rate(s[k - 1].pose.q, s[k + 1].pose.q, time) - s[k].w).norm());
      a = std::max(a, ((s[k + 1].v - s[k - 1].v) / time - s[k].a).norm());
      alpha = std::max(alpha, ((s[k + 1].w - s[k - 1].w) / time - s[k].alpha).norm());
      v_size = std::max(v_size, (s[k].v - ideal_v).norm());
      w_size = std::max(w_size, (s[k].w - ideal_w).norm());
      a_size = std::max(a_size, (s[k].a - s[k].ideal_a).norm());
      alpha_size = std::max(alpha_size, (s[k].alpha - s[k].ideal_alpha).norm());
    }
    EXPECT_LT(v, 1e-3 * v_size);
    EXPECT_LT(w, 1e-3 * w_size);
    EXPECT_LT(a, 2e-3 * a_size);
    EXPECT_LT(alpha, 2e-3 * alpha_size);
  }
}

}  // namespace pose_history_test
}  // namespace boresight
