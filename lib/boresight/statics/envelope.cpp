#include "boresight/statics/envelope.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/statics/measured_by_dynamics.hpp"
#include "boresight/statics/reaction_table.hpp"

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

// A joint's gap as independent parts, each with its own gain: a cylinder of centre offsets where axes are parallel; where the
// journal tilts, a disc at each end of the sleeve and the axial play.
struct GapParts {
  struct Part {
    Gain moves, turns;                   // columns x y z of what the part offers
    double radial, axial;                // its reach
    Eigen::Matrix<double, 5, 3> offset;  // the joint's offsets per unit of it
  };
  std::vector<Part> parts;
};

GapParts parts_of(const JournalInSleeve& joint, const RestingJournal& rest, double slide,
                  const Eigen::Matrix<double, 6, 5>& gain) {
  GapParts gap;
  const auto add = [&](const Eigen::Matrix<double, 5, 3>& offset, double radial, double axial) {
    gap.parts.push_back({gain.topRows<3>() * offset, gain.bottomRows<3>() * offset, radial, axial, offset});
  };
  Eigen::Matrix<double, 5, 3> offset = Eigen::Matrix<double, 5, 3>::Zero();
  if (!joint.tilts) {
    offset.topRows<3>().setIdentity();
    add(offset, rest.radial_reach[0], rest.axial_reach);
    return gap;
  }
  // Centre e = (rho+ + rho-) / 2 + e_y sigma, sigma = (rho+ - rho-) / L_b.
  const double length = 2.0 * joint.half_length;
  for (int side : {-1, 1}) {
    offset.setZero();
    offset(0, 0) = offset(2, 2) = 0.5 + side * slide / length;
    offset(3, 0) = offset(4, 2) = side / length;
    add(offset, rest.radial_reach[side < 0 ? 0 : 1], 0.0);
  }
  offset.setZero();
  offset(1, 1) = 1.0;
  add(offset, 0.0, rest.axial_reach);
  return gap;
}

constexpr int kInstantsBetweenLooks = 256;  // at whether to go on

class Envelope final : public SceneRung {
 public:
  explicit Envelope(std::shared_ptr<const Mechanism> mechanism) : SceneRung(std::move(mechanism)) {}

  std::string name() const override { return "envelope"; }
  std::string leaves_out() const override {
    return "Everything but geometry and static deflection: a bound, each index at its own worst offset at every "
           "instant "
           "(joints added up as if all were worst at once). Impacts can overshoot it by their extra penetration.";
  }

 private:
  RunResult follow(const PreparedScene& prepared, const Parameters& parameters,
                   const RunOptions& options) const override {
    const ReactionTable reactions(mechanism(), prepared.scene(), parameters);
    const std::vector<JournalInSleeve>& joints = reactions.joints();
    MotionRecorder recorder(mechanism(), prepared.ideal(), options, reactions.instants());
    std::vector<ContactSummary> summary = reactions.summaries();
    std::vector<RestingJournal> worst_rest(joints.size()), at_rest(joints.size());
    bool interrupted = false;
    for (int i = 0; i < reactions.instants() && !interrupted; ++i) {
      const ReactionTable::Instant now = reactions.at(i);
      interrupted = i % kInstantsBetweenLooks == 0 && options.progress &&
                    !options.progress({now.t, mechanism().duration(), recorder.position_error_max()});
      BodyAcceleration acceleration;
      const BodyMotion ideal = prepared.ideal().body(now.t, mechanism().boresight_body(), &acceleration);
      const Vec3 axis = ideal.R * mechanism().boresight_B();
      Eigen::Matrix<double, 3, 6> sight = Eigen::Matrix<double, 3, 6>::Zero();
      if (const auto& line = mechanism().pointing().line_of_sight) sight = line->gain({ideal.p, Quat(ideal.R)});
      Mat3 across;
      across << 0.0, axis.z(), -axis.y(), -axis.z(), 0.0, axis.x(), axis.y(), -axis.x(), 0.0;  // turn -> change of axis

      PoseError bound;
      for (std::size_t c = 0; c < joints.size(); ++c) {
        const RestingJournal rest = resting_journal_under(joints[c], now.load[c].force, now.load[c].slide, at_rest[c]);
        at_rest[c] = rest;
        reactions.note(rest, summary[c]);
        const GapParts gap =
            parts_of(joints[c], rest, now.load[c].slide, reactions.joint_gain(now, static_cast<int>(c)));
        Eigen::Matrix<double, 5, 1> offset = Eigen::Matrix<double, 5, 1>::Zero(), rest_offset;
        rest_offset << rest.motion.e, rest.motion.slope;
        const Vec3 resting = reactions.joint_gain(now, static_cast<int>(c)).topRows<3>() * rest_offset;
        for (const GapParts::Part& part : gap.parts) {
          const auto worst = [&](const Gain& G) { return (G * worst_offset(G, part.radial, part.axial)).norm(); };
          // The place that is worst for the position stands for the joint in the pictures: of the two opposite ones, the one
          // on the side where the journal rests.
          Vec3 place = worst_offset(part.moves, part.radial, part.axial);
          if (resting.dot(part.moves * place) < 0.0) place = -place;
          offset += part.offset * place;
          bound.position += (part.moves * place).norm();
          bound.orientation += worst(part.turns);
          bound.boresight += worst(across * part.turns);
          bound.line_of_sight += worst(sight.leftCols<3>() * part.moves + sight.rightCols<3>() * part.turns);
        }
        JournalMotion<double>& m = worst_rest[c].motion;
        m.e = offset.head<3>();
        m.slope = offset.tail<2>();
        joints[c].penetrations(m, worst_rest[c].contact);
      }
      const VecX z = reactions.coordinates(worst_rest);
      const DisplacedBodies displaced(prepared, now.t, z);
      bound.displacement = now.pose_gain.topRows<3>() * z;
      bound.rotation = now.pose_gain.bottomRows<3>() * z;
      recorder.accept(now.t, displaced.at_rest(mechanism().boresight_body(), acceleration), acceleration, &bound);
      if (!recorder.sampling()) continue;
      for (std::size_t k = 0; k < recorder.bodies_wanted().size(); ++k) {
        const BodyMotion body = displaced.at_rest(recorder.bodies_wanted()[k], acceleration);
        recorder.sample_body(static_cast<int>(k), body, acceleration);
      }
      for (std::size_t c = 0; c < joints.size(); ++c)
        recorder.sample_clearance(static_cast<int>(c), worst_rest[c].motion, worst_rest[c].contact);
    }
    RunResult result = recorder.finish();
    result.interrupted = interrupted;
    result.integrator = "none: the worst offset an instant";
    result.contact = std::move(summary);
    result.cost.steps = result.cost.evaluations = reactions.instants();
    return result;
  }
};

}  // namespace

std::unique_ptr<Rung> make_envelope(std::shared_ptr<const Mechanism> mechanism) {
  auto rung = std::make_unique<Envelope>(mechanism);
  return with_error_measured_by_dynamics(std::move(rung), std::move(mechanism), true);
}

}  // namespace boresight
