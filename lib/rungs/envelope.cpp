#include "boresight/rungs/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/rungs/reaction_table.hpp"
#include "boresight/rungs/scene_rung.hpp"

namespace boresight {
namespace {

using Gain = Eigen::Matrix<double, 3, 3>;

// The offset in a joint's gap (a cylinder of radius `radial`, half length `axial`, axis y) with the largest |G xi|. A convex
// function is largest on the rim; its square is a second-order trigonometric polynomial of the angle, so the best of 32
// starts followed by Newton steps is the global maximum.
Vec3 worst_offset(const Gain& G, double radial, double axial) {
  const Vec3 gx = radial * G.col(0), gz = radial * G.col(2), gy = axial * G.col(1);
  const auto value = [&](double s) { return (std::cos(s) * gx + std::sin(s) * gz + gy).squaredNorm(); };
  double best = 0.0;
  for (int k = 1; k < 32; ++k) {
    const double s = k * std::numbers::pi / 16.0;
    if (value(s) > value(best)) best = s;
  }
  for (int k = 0; k < 8; ++k) {
    const Vec3 g = std::cos(best) * gx + std::sin(best) * gz + gy;
    const Vec3 d = -std::sin(best) * gx + std::cos(best) * gz, dd = gy - g;
    const double slope = 2.0 * g.dot(d), curvature = 2.0 * (d.squaredNorm() + g.dot(dd));
    if (!(curvature < 0.0)) break;
    const double next = best - slope / curvature;
    if (!(value(next) >= value(best))) break;
    best = next;
  }
  return {radial * std::cos(best), axial, radial * std::sin(best)};
}

class Envelope final : public SceneRung {
 public:
  explicit Envelope(std::shared_ptr<const Mechanism> mechanism) : SceneRung(std::move(mechanism)) {}

  std::string name() const override { return "envelope"; }
  std::string leaves_out() const override {
    return "Everything but geometry and static deflection: a bound, each index at its own worst offset at every instant "
           "(joints added up as if all were worst at once). Impacts can overshoot it by their extra penetration.";
  }

 private:
  RunResult follow(const Parameters& parameters, const RunOptions& options) const override {
    const ReactionTable reactions(mechanism(), scene(), parameters);
    const std::vector<JournalInSleeve>& joints = reactions.joints();
    MotionRecorder recorder(mechanism(), ideal(), options, reactions.instants());
    std::vector<ContactSummary> summary = reactions.summaries();
    for (int i = 0; i < reactions.instants(); ++i) {
      const ReactionTable::Instant now = reactions.at(i);
      BodyAcceleration acceleration;
      BodyMotion body = ideal().body(now.t, mechanism().boresight_body(), &acceleration);
      const Vec3 axis = body.R * mechanism().boresight_B();
      const double range = body.p.norm();
      Mat3 across, sideways = Mat3::Zero();
      across << 0.0, axis.z(), -axis.y(), -axis.z(), 0.0, axis.x(), axis.y(), -axis.x(), 0.0;  // turn -> change of axis
      if (range > 0.0) sideways = (Mat3::Identity() - body.p * body.p.transpose() / (range * range)) / range;

      PoseError bound;
      std::vector<Vec3> offset(joints.size());
      VecX xi(3 * static_cast<int>(joints.size()));
      for (std::size_t c = 0; c < joints.size(); ++c) {
        const int at = 3 * static_cast<int>(c);
        const Rest rest = rest_under(joints[c], now.reaction.segment<3>(at), {});
        reactions.note(rest, summary[c]);
        const Gain moves = now.pose_gain.block<3, 3>(0, at), turns = now.pose_gain.block<3, 3>(3, at);
        const auto worst = [&](const Gain& G) { return (G * worst_offset(G, rest.radial_reach, rest.axial_reach)).norm(); };
        offset[c] = worst_offset(moves, rest.radial_reach, rest.axial_reach);
        xi.segment<3>(at) = offset[c];
        bound.position += (moves * offset[c]).norm();
        bound.orientation += worst(turns);
        bound.boresight += worst(across * turns);
        bound.line_of_sight += worst(sideways * moves);
      }
      bound.displacement = now.pose_gain.topRows<3>() * xi;
      bound.rotation = now.pose_gain.bottomRows<3>() * xi;
      displace(body, now.pose_gain * xi);
      recorder.accept(now.t, body, acceleration, &bound);
      if (!recorder.sampling()) continue;
      for (std::size_t c = 0; c < joints.size(); ++c) {
        const JournalMotion<double> motion{offset[c], Vec3::Zero(), Vec3::Zero()};
        std::array<ContactState<double>, kContactPlaces> contact;
        joints[c].gaps(motion, contact);
        recorder.sample_clearance(static_cast<int>(c), motion, contact);
      }
    }
    RunResult result = recorder.finish();
    result.integrator = "none: the worst offset an instant";
    result.contact = std::move(summary);
    result.cost.steps = result.cost.evaluations = reactions.instants();
    return result;
  }
};

}  // namespace

std::unique_ptr<Rung> make_envelope(std::shared_ptr<const Mechanism> mechanism) {
  return std::make_unique<Envelope>(std::move(mechanism));
}

}  // namespace boresight
