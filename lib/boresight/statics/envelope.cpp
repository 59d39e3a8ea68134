#include "boresight/statics/envelope.hpp"

#include <optional>

#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/statics/measured_by_dynamics.hpp"
#include "boresight/statics/reaction_table.hpp"
#include "boresight/statics/tied_gaps.hpp"
#include "boresight/statics/tied_rest.hpp"
#include "boresight/statics/worst_offset.hpp"

namespace boresight {
namespace {

using Gain = Eigen::Matrix<double, 3, 3>;

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
  RunResult follow(const PreparedScene& prepared, const StandingDisplacement& standing, const Parameters& parameters,
                   const RunOptions& options) const override {
    const ReactionTable reactions(mechanism(), prepared, standing, parameters);
    const std::vector<JointPlay>& joints = reactions.joints();
    MotionRecorder recorder(mechanism(), prepared.ideal(), options, reactions.instants());
    std::vector<ContactSummary> summary = reactions.summaries();
    std::vector<RestingPlay> worst_rest(joints.size()), at_rest(joints.size());
    std::optional<TiedRest> tied;
    if (reactions.tied()) tied.emplace(prepared, standing, parameters, reactions);
    TiedGaps gaps;
    VecX z, worst_z;
    bool interrupted = false;
    for (int i = 0; i < reactions.instants() && !interrupted; ++i) {
      const ReactionTable::Instant now = reactions.at(i);
      interrupted = i % kInstantsBetweenLooks == 0 && options.progress &&
                    !options.progress({now.t, mechanism().duration(), recorder.position_error_max()});
      BodyAcceleration acceleration;
      const BodyMotion ideal = prepared.ideal().body(now.t, mechanism().boresight_body(), &acceleration);
      const auto& line = mechanism().pointing().line_of_sight;
      const auto gain_of = [&](PointingQuantity quantity) {
        return error_gain(quantity, {ideal.p, Quat(ideal.R)}, ideal.R * mechanism().boresight_B(), line);
      };
      Eigen::Matrix<double, 3, 6> sight = Eigen::Matrix<double, 3, 6>::Zero();
      if (line) sight = gain_of(PointingQuantity::line_of_sight_error);
      const Mat3 across = gain_of(PointingQuantity::boresight_error).rightCols<3>();  // turn -> change of axis

      PoseError bound;
      if (tied) {
        TiedRest::Rest rest = tied->at(now, i == 0 ? nullptr : &z);
        z = rest.z;
        gaps.take(tied->balance(), rest.joint);
        const TiedGaps::Gain moves = now.pose_gain.topRows<3>(), turns = now.pose_gain.bottomRows<3>();
        bound.orientation = gaps.bound(turns, 0);
        bound.boresight = gaps.bound(across * turns, 1);
        if (line) bound.line_of_sight = gaps.bound(sight * now.pose_gain, 2);
        bound.position = gaps.bound(moves, 3);
        // What is worst for the position stands for all in the pictures.
        worst_z = gaps.place(moves, moves * z);
        for (std::size_t c = 0; c < joints.size(); ++c) {
          reactions.note(rest.joint[c], summary[c]);
          worst_rest[c].motion = tied->balance().motion_of(c, worst_z);
          joints[c].penetrations(worst_rest[c].motion, worst_rest[c].contact);
        }
      }
      for (std::size_t c = 0; c < joints.size() && !tied; ++c) {
        const RestingPlay rest = joints[c].rest_under(now.load[c].force, now.load[c].slide, at_rest[c]);
        at_rest[c] = rest;
        reactions.note(rest, summary[c]);
        const Eigen::Matrix<double, 6, kMostOffsets> gain = reactions.joint_gain(now, static_cast<int>(c));
        PlayOffsets offset = PlayOffsets::Zero();
        const Vec3 resting = gain.topRows<3>() * offsets_of(rest.motion);
        for (const GapPart& part : joints[c].gap_parts(rest, now.load[c].slide)) {
          const Gain moves = gain.topRows<3>() * part.offset, turns = gain.bottomRows<3>() * part.offset;
          const auto worst = [&](const Gain& G) { return (G * worst_offset(G, part)).norm(); };
          // The place that is worst for the position stands for the joint in the pictures: of the two opposite ones, the one
          // on the side where the journal rests.
          Vec3 place = worst_offset(moves, part);
          if (resting.dot(moves * place) < 0.0) place = -place;
          offset += part.offset * place;
          bound.position += (moves * place).norm();
          bound.orientation += worst(turns);
          bound.boresight += worst(across * turns);
          bound.line_of_sight += worst(sight.leftCols<3>() * moves + sight.rightCols<3>() * turns);
        }
        worst_rest[c].motion = at_rest_at(offset);
        joints[c].penetrations(worst_rest[c].motion, worst_rest[c].contact);
      }
      // What the errors displace is known, and not bounded: the play adds to it in the worst way.
      const Vec6 errors = standing.at(now.t, mechanism().boresight_body());
      if (standing) {
        bound.position += errors.head<3>().norm();
        bound.orientation += errors.tail<3>().norm();
        bound.boresight += (across * errors.tail<3>()).norm();
        bound.line_of_sight += (sight * errors).norm();
      }
      if (!tied) worst_z = reactions.coordinates(worst_rest);
      const DisplacedBodies displaced(prepared, standing, now.t, worst_z);
      bound.displacement = now.pose_gain.topRows<3>() * worst_z + errors.head<3>();
      bound.rotation = now.pose_gain.bottomRows<3>() * worst_z + errors.tail<3>();
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
