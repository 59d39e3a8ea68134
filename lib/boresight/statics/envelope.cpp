#include "boresight/statics/envelope.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "boresight/mechanism/error.hpp"
#include "boresight/pointing/peaks.hpp"
#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/statics/measured_by_dynamics.hpp"
#include "boresight/statics/reaction_table.hpp"
#include "boresight/statics/resting_contacts.hpp"
#include "boresight/statics/tied_gaps.hpp"
#include "boresight/statics/tied_rest.hpp"
#include "boresight/statics/worst_offset.hpp"

namespace boresight {
namespace {

using Gain = Eigen::Matrix<double, 3, 3>;

constexpr std::array kIndices = {&PoseError::position, &PoseError::orientation, &PoseError::boresight,
                                 &PoseError::line_of_sight};

class Envelope final : public SceneRung {
 public:
  explicit Envelope(std::shared_ptr<const Mechanism> mechanism) : SceneRung(std::move(mechanism)) {}

  std::string name() const override { return "envelope"; }
  bool starts_somewhere() const override { return false; }
  std::string leaves_out() const override {
    return "Everything but geometry and static deflection: a bound, each index at its own worst offset at every "
           "instant "
           "(joints added up as if all were worst at once). Impacts can overshoot it by their extra penetration.";
  }

 private:
  RunResult follow(const PreparedScene& prepared, const StandingDisplacement& standing, const Parameters& parameters,
                   const RunOptions& options) const override {
    if (prepared.scene().coordinates().leftover() > 0)
      throw ComputationError(
          "the gaps bound what deviates only where every freedom of the ideal mechanism is driven: one that nothing "
          "drives departs from the ideal motion by what no gap limits; use perturbation");
    const ReactionTable reactions(mechanism(), prepared, standing, parameters, options.share_of_longest_step);
    const std::vector<JointPlay>& joints = reactions.joints();
    MotionRecorder recorder(mechanism(), prepared.ideal(), options, reactions.instants());
    RestingContacts contacts(reactions, options.start);
    std::optional<TiedRest> tied;
    if (reactions.tied()) tied.emplace(prepared, standing, parameters, reactions);
    TiedGaps gaps;
    WhatErrorsAdd added(mechanism().pointing().line_of_sight.has_value(), options.start);
    long instants = 0;
    const auto bounded_at = [&](double t, const Bounded* before) {
      ++instants;
      const ReactionTable::Instant now = reactions.at_time(t);
      const Directions directions = directions_at(prepared, t);
      Bounded bounded = tied ? bound_of_all(reactions, *tied, gaps, now, directions, before)
                             : bound_of_each(reactions, now, directions, before);
      // What the errors displace is known, and not bounded: the play adds to it in the worst way.
      const Vec6 errors = standing.at(t, mechanism().boresight_body());
      if (standing) {
        bounded.of_errors.position = errors.head<3>().norm();
        bounded.of_errors.orientation = errors.tail<3>().norm();
        bounded.of_errors.boresight = (directions.across * errors.tail<3>()).norm();
        bounded.of_errors.line_of_sight = (directions.sight * errors).norm();
        for (const auto index : kIndices) bounded.error.*index += bounded.of_errors.*index;
      }
      bounded.error.displacement = now.pose_gain.topRows<3>() * bounded.worst_z + errors.head<3>();
      bounded.error.rotation = now.pose_gain.bottomRows<3>() * bounded.worst_z + errors.tail<3>();
      return bounded;
    };
    const auto record = [&](const Bounded& bounded) {
      if (standing) added.note(bounded);
      contacts.note(bounded.time, bounded.rest);
      const DisplacedBodies displaced(prepared, standing, bounded.time, bounded.worst_z);
      BodyAcceleration acceleration;
      const BodyMotion boresight = displaced.at_rest(mechanism().boresight_body(), acceleration);
      recorder.accept(bounded.time, boresight, acceleration, &bounded.error);
      if (!recorder.sampling()) return;
      for (std::size_t k = 0; k < recorder.bodies_wanted().size(); ++k) {
        const BodyMotion body = displaced.at_rest(recorder.bodies_wanted()[k], acceleration);
        recorder.sample_body(static_cast<int>(k), body, acceleration);
      }
      for (std::size_t c = 0; c < joints.size(); ++c)
        recorder.sample_clearance(static_cast<int>(c), bounded.worst[c].motion, bounded.worst[c].contact);
    };
    PeakSeeker<Bounded> seeker(
        options.start, [&](double t, const Bounded& before) { return bounded_at(t, &before); }, record);
    Bounded before = bounded_at(0.0, nullptr);
    bool interrupted = false;
    for (int i = 1; i < reactions.instants() && !interrupted; ++i) {
      seeker.accept(before);
      interrupted = i % kInstantsBetweenLooks == 0 && options.progress &&
                    !options.progress({before.time, mechanism().duration(), recorder.position_error_max()});
      before = bounded_at(i * reactions.spacing(), &before);
    }
    seeker.accept(std::move(before));
    seeker.finish();
    RunResult result = recorder.finish();
    result.interrupted = interrupted;
    if (standing) added.state(result);
    result.integrator = "none: the worst offset an instant";
    result.contact = contacts.finish();
    result.cost.steps = result.cost.evaluations = instants;
    return result;
  }

  // How a small displacement of the boresight body changes its indices.
  struct Directions {
    Mat3 across;  // turn -> change of the pointing axis
    Eigen::Matrix<double, 3, 6>
        sight;  // displacement and turn -> turn of the line of sight; zero where nothing is sighted
  };
  Directions directions_at(const PreparedScene& prepared, double t) const {
    const BodyMotion ideal = prepared.ideal().body(t, mechanism().boresight_body());
    const auto& line = mechanism().pointing().line_of_sight;
    const auto gain_of = [&](PointingQuantity quantity) {
      return error_gain(quantity, {ideal.p, Quat(ideal.R)}, ideal.R * mechanism().boresight_B(), line);
    };
    return {gain_of(PointingQuantity::boresight_error).rightCols<3>(),
            line ? gain_of(PointingQuantity::line_of_sight_error) : Eigen::Matrix<double, 3, 6>::Zero().eval()};
  }

  // The bound at one instant.
  struct Bounded {
    double time;
    PoseError error;      // the bound of each index
    PoseError of_errors;  // of that, what standing errors make; indices alone
    std::vector<RestingPlay> rest,
        worst;        // per joint: where it rests, and the place that stands for its worst one in the pictures
    VecX z, worst_z;  // the same in coordinates; z where joints are tied
    double t() const { return time; }
  };

  // What a bound cannot know beside standing errors: whether the play adds to them or takes from them. Of an index that errors make e of and
  // the play up to p of, the truth is between |e - p| and e + p.
  class WhatErrorsAdd {
   public:
    WhatErrorsAdd(bool sighted, double start) : play_(sighted, start), taken_(sighted, start) {}

    void note(const Bounded& bounded) {
      PoseError play, taken;
      for (const auto index : kIndices) {
        play.*index = bounded.error.*index - bounded.of_errors.*index;
        taken.*index = 2.0 * std::min(play.*index, bounded.of_errors.*index);
      }
      play_.add(bounded.time, play);
      taken_.add(bounded.time, taken);
    }
    void state(RunResult& result) const {
      const PointingIndices play = play_.result(), taken = taken_.result();
      for (int k = 0; k < kPointingQuantities; ++k) {
        const auto quantity = static_cast<PointingQuantity>(k);
        double of_play = 0.0, unknown = 0.0;
        for (const auto statistic : {&Statistics::max, &Statistics::rms, &Statistics::mean})
          if (const double whole = result.index.of(quantity).*statistic; whole > 0.0) {
            of_play = std::max(of_play, play.of(quantity).*statistic / whole);
            unknown = std::max(unknown, taken.of(quantity).*statistic / whole);
          }
        result.error.of_play[static_cast<std::size_t>(k)] = std::min(1.0, of_play);
        result.error.model[static_cast<std::size_t>(k)] += unknown;
      }
    }

   private:
    IndicesOverTime play_, taken_;
  };

  // Joints added up as if all were worst at once.
  static Bounded bound_of_each(const ReactionTable& reactions, const ReactionTable::Instant& now,
                               const Directions& directions, const Bounded* before) {
    const std::vector<JointPlay>& joints = reactions.joints();
    Bounded bounded{now.t, {}, {}, {}, std::vector<RestingPlay>(joints.size()), {}, {}};
    PoseError& bound = bounded.error;
    for (std::size_t c = 0; c < joints.size(); ++c) {
      bounded.rest.push_back(
          joints[c].rest_under(now.load[c].force, now.load[c].joint, before ? before->rest[c] : RestingPlay{}));
      const RestingPlay& rest = bounded.rest.back();
      const Eigen::Matrix<double, 6, kMostOffsets> gain = reactions.joint_gain(now, static_cast<int>(c));
      PlayOffsets offset = PlayOffsets::Zero();
      const Vec3 resting = gain.topRows<3>() * offsets_of(rest.motion);
      std::vector<PlayOffsets> lines;
      for (const GapPart& part : joints[c].gap_parts(rest, now.load[c].joint)) {
        if (part.shape == GapPart::Shape::cylinder && part.radial == 0.0) {
          lines.push_back(part.axial * part.offset.col(1));
          continue;
        }
        const Gain moves = gain.topRows<3>() * part.offset, turns = gain.bottomRows<3>() * part.offset;
        const auto worst = [&](const Gain& G) { return (G * worst_offset(G, part)).norm(); };
        // The place that is worst for the position stands for the joint in the pictures: of the two opposite ones, the one
        // on the side where the journal rests.
        Vec3 place = worst_offset(moves, part);
        if (resting.dot(moves * place) < 0.0) place = -place;
        offset += part.offset * place;
        bound.position += (moves * place).norm();
        bound.orientation += worst(turns);
        bound.boresight += worst(directions.across * turns);
        bound.line_of_sight += worst(directions.sight.leftCols<3>() * moves + directions.sight.rightCols<3>() * turns);
      }
      if (!lines.empty()) {
        const Eigen::Matrix<double, 3, kMostOffsets> moves = gain.topRows<3>(), turns = gain.bottomRows<3>();
        PlayOffsets place = worst_corner(moves, lines);
        if (resting.dot(moves * place) < 0.0) place = -place;
        offset += place;
        const auto worst = [&](const Eigen::Matrix<double, 3, kMostOffsets>& G) {
          return (G * worst_corner(G, lines)).norm();
        };
        bound.position += (moves * place).norm();
        bound.orientation += worst(turns);
        bound.boresight += worst(directions.across * turns);
        bound.line_of_sight += worst(directions.sight.leftCols<3>() * moves + directions.sight.rightCols<3>() * turns);
      }
      if (now.load[c].slides) offset[1] = now.load[c].joint.slide;  // where its ends are
      bounded.worst[c].motion = at_rest_at(offset, now.load[c].joint);
      joints[c].penetrations(bounded.worst[c].motion, bounded.worst[c].contact);
    }
    bounded.worst_z = reactions.coordinates(bounded.worst);
    return bounded;
  }

  // All places that the gaps leave together, where redundant joints tie the offsets.
  static Bounded bound_of_all(const ReactionTable& reactions, TiedRest& tied, TiedGaps& gaps,
                              const ReactionTable::Instant& now, const Directions& directions, const Bounded* before) {
    const std::vector<JointPlay>& joints = reactions.joints();
    const TiedRest::Rest was = before ? TiedRest::Rest{before->z, before->rest} : TiedRest::Rest{};
    TiedRest::Rest rest = tied.at(now, before ? &was : nullptr);
    Bounded bounded{now.t, {}, {}, std::move(rest.joint), std::vector<RestingPlay>(joints.size()), std::move(rest.z),
                    {}};
    gaps.take(tied.balance(), bounded.rest);
    const TiedGaps::Gain moves = now.pose_gain.topRows<3>(), turns = now.pose_gain.bottomRows<3>();
    bounded.error.orientation = gaps.bound(turns, 0);
    bounded.error.boresight = gaps.bound(directions.across * turns, 1);
    if (!directions.sight.isZero(0.0)) bounded.error.line_of_sight = gaps.bound(directions.sight * now.pose_gain, 2);
    bounded.error.position = gaps.bound(moves, 3);
    // What is worst for the position stands for all in the pictures.
    bounded.worst_z = gaps.place(moves, moves * bounded.z);
    for (std::size_t c = 0; c < joints.size(); ++c) {
      bounded.worst[c].motion = tied.balance().motion_of(c, bounded.worst_z);
      joints[c].penetrations(bounded.worst[c].motion, bounded.worst[c].contact);
    }
    return bounded;
  }
};

}  // namespace

std::unique_ptr<Rung> make_envelope(std::shared_ptr<const Mechanism> mechanism) {
  auto rung = std::make_unique<Envelope>(mechanism);
  return with_error_measured_by_dynamics(std::move(rung), std::move(mechanism), true);
}

}  // namespace boresight
