#include "boresight/statics/quasistatic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "boresight/play/play_words.hpp"
#include "boresight/pointing/peaks.hpp"
#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/statics/measured_by_dynamics.hpp"
#include "boresight/statics/passing_rest.hpp"
#include "boresight/statics/reaction_table.hpp"
#include "boresight/statics/resting_contacts.hpp"
#include "boresight/statics/tied_rest.hpp"

namespace boresight {
namespace {

// Where journals rest moves those that slide along their axes, and that moves where these rest by their tilt times it: each look leaves that
// share of what the one before left.
constexpr int kLooksAtSlides = 3;
// From one instant to the next the body moves by no more than this share of its largest error, and the same loads are large enough to decide
// where their journals rest; else there are instants between, as close as this share of their spacing. Closer (2^26 was tried) resolves
// jumps that only rounding decides.
constexpr double kTurns = 0.005, kMostBetween = 1024.0;

class Quasistatic final : public SceneRung {
 public:
  explicit Quasistatic(std::shared_ptr<const Mechanism> mechanism) : SceneRung(std::move(mechanism)) {}

  std::string name() const override { return "quasistatic"; }
  std::string leaves_out() const override {
    return "Impacts and vibration: the " + parts_in_play(mechanism().description()).insert +
           " rests where the ideal joint's reaction pushes it, without friction, so maxima that impacts set come out "
           "low. Velocities and accelerations shown are those of the ideal motion.";
  }

 private:
  RunResult follow(const PreparedScene& prepared, const StandingDisplacement& standing, const Parameters& parameters,
                   const RunOptions& options) const override {
    const ReactionTable reactions(mechanism(), prepared, standing, parameters, options.share_of_longest_step);
    std::optional<TiedRest> tied;
    if (reactions.tied()) tied.emplace(prepared, standing, parameters, reactions);
    const auto balance_at = [&](double t, const Balance* before) {
      return tied ? balance_of_all(reactions, *tied, t, before)
                  : balance_of_each(reactions, t, before, mechanism().description().journals != JournalStart::centred);
    };
    MotionRecorder recorder(mechanism(), prepared.ideal(), options, reactions.instants());
    RestingContacts contacts(reactions, options.start);
    const auto placed = [&](Balance balance) { return place(prepared, standing, std::move(balance)); };
    bool interrupted = false;
    double largest = 0.0;  // position error [m]
    long instants = 1;
    PeakSeeker<Placed> seeker(
        options.start,
        [&](double t, const Placed& before) { return ++instants, placed(balance_at(t, &before.balance)); },
        [&](const Placed& at) { record(prepared, standing, at, contacts, recorder); });
    Balance before = balance_at(0.0, nullptr);
    seeker.accept(placed(before));
    for (int i = 1; i < reactions.instants() && !interrupted; ++i) {
      interrupted = i % kInstantsBetweenLooks == 0 && options.progress &&
                    !options.progress({before.now.t, mechanism().duration(), recorder.position_error_max()});
      // Where loads turn a journal goes round its sleeve within an instant, through places that are farther out.
      std::vector<double> ahead = {i * reactions.spacing()};
      while (!ahead.empty()) {
        const double shortest = reactions.spacing() / kMostBetween, t = ahead.back();
        Balance balance = balance_at(t, &before);
        if (t - before.now.t > shortest &&
            (balance.decided != before.decided ||
             (balance.moved - before.moved).norm() > kTurns * options.share_of_longest_step * largest)) {
          ahead.push_back(0.5 * (before.now.t + t));
          continue;
        }
        ahead.pop_back();
        before = std::move(balance);
        seeker.accept(placed(before));
        largest = std::max(largest, before.moved.norm());
        ++instants;
      }
    }
    seeker.finish();
    RunResult result = recorder.finish();
    result.interrupted = interrupted;
    result.integrator = "none: one static balance an instant";
    result.contact = contacts.finish();
    if (!interrupted)
      for (const Passage& passage :
           passages(reactions, result.index, [&](double t, const Balance*from) { return placed(balance_at(t, from)); }))
        result.warnings.push_back(passage_sentence(passage));
    result.cost.steps = result.cost.evaluations = instants;
    return result;
  }

  // Where the journals rest at one instant, and by how much that displaces the body of the boresight.
  struct Balance {
    ReactionTable::Instant now;
    std::vector<RestingPlay> rest;
    VecX z;
    Vec3 moved;
    std::vector<bool> decided;  // whether a load decides where its joint rests; empty where joints are tied
  };
  // rests: whether journals start where they rest, which is where nothing rubs, as on every rung; else friction may hold them at their middle.
  static Balance balance_of_each(const ReactionTable& reactions, double t, const Balance* before, bool rests) {
    Balance balance{reactions.at_time(t), std::vector<RestingPlay>(reactions.joints().size()), {}, {}, {}};
    for (std::size_t c = 0; c < balance.rest.size(); ++c)
      balance.decided.push_back(reactions.decides(balance.now, static_cast<int>(c)));
    balance.z = VecX::Zero(balance.now.reaction.size());
    for (int look = 0; look < (reactions.slides() ? kLooksAtSlides : 1); ++look) {
      for (std::size_t c = 0; c < balance.rest.size(); ++c) {
        const ReactionTable::Load& load = balance.now.load[c];
        JointCoordinates joint = load.joint;
        joint.slide += load.slide_gain.dot(balance.z);
        // Where next to nothing pushes it, a journal stays where it was.
        if (before && !balance.decided[c])
          balance.rest[c] = before->rest[c];
        else
          balance.rest[c] = reactions.joints()[c].rest_under(
              load.force, joint,
              before  ? before->rest[c]
              : rests ? reactions.joints()[c].elastic_only().rest_under(load.force, joint, RestingPlay{})
                      : RestingPlay{});
        if (load.slides) balance.rest[c].motion.e.y() = joint.slide;
        balance.rest[c].motion.twist = joint.twist;
      }
      balance.z = reactions.coordinates(balance.rest);
    }
    balance.moved = (balance.now.pose_gain * balance.z).head<3>();
    return balance;
  }
  // Where redundant joints tie their offsets together.
  static Balance balance_of_all(const ReactionTable& reactions, TiedRest& tied, double t, const Balance* before) {
    Balance balance{reactions.at_time(t), {}, {}, {}, {}};
    const TiedRest::Rest was = before ? TiedRest::Rest{before->z, before->rest} : TiedRest::Rest{};
    TiedRest::Rest rest = tied.at(balance.now, before ? &was : nullptr);
    balance.z = std::move(rest.z);
    balance.rest = std::move(rest.joint);
    balance.moved = (balance.now.pose_gain * balance.z).head<3>();
    return balance;
  }

  // And the boresight body there.
  struct Placed {
    Balance balance;
    BodyMotion body;
    BodyAcceleration acceleration;
    PoseError error;
    double t() const { return balance.now.t; }
  };
  Placed place(const PreparedScene& prepared, const StandingDisplacement& standing, Balance balance) const {
    const int index = mechanism().boresight_body();
    Placed placed;
    const BodyMotion ideal = prepared.ideal().body(balance.now.t, index, &placed.acceleration);
    placed.body = ideal;
    displace(placed.body, balance.now.pose_gain * balance.z + standing.at(balance.now.t, index));
    placed.error = pose_error({placed.body.p, Quat(placed.body.R)}, {ideal.p, Quat(ideal.R)}, mechanism().pointing());
    placed.balance = std::move(balance);
    return placed;
  }

  // The maxima that are of no place where the journals stay: an instant of the table to either side errors are smaller, and a rest is on
  // another side of its play.
  template <typename At>
  std::vector<Passage> passages(const ReactionTable& reactions, const PointingIndices& index, const At& at) const {
    std::vector<Passage> found;
    for (int q = 0; q < kPointingQuantities; ++q) {
      const auto quantity = static_cast<PointingQuantity>(q);
      const Statistics& statistics = index.of(quantity);
      const double t = statistics.time_of_max, earlier = t - reactions.spacing(), later = t + reactions.spacing();
      if (earlier < 0.0 || later > mechanism().duration() || !(statistics.max > 0.0)) continue;
      const Placed before = at(earlier, nullptr), after = at(later, &before.balance);
      const double rise = rise_above(statistics.max, value_of(quantity, before.error), value_of(quantity, after.error));
      if (rise == 0.0) continue;
      Passage passage{t, {quantity}, {}, rise};
      for (std::size_t c = 0; c < before.balance.rest.size(); ++c)
        if (changes_sides(before.balance.rest[c], after.balance.rest[c]))
          passage.joints.push_back(reactions.joint_name(static_cast<int>(c)));
      if (passage.joints.empty()) continue;
      const auto same = std::find_if(found.begin(), found.end(), [&](const Passage& p) {
        return std::abs(p.t - t) <= reactions.spacing() && p.joints == passage.joints;
      });
      if (same == found.end()) {
        found.push_back(std::move(passage));
      } else {
        same->quantities.push_back(quantity);
        same->rise = std::max(same->rise, rise);
      }
    }
    return found;
  }
  static double value_of(PointingQuantity quantity, const PoseError& error) {
    return std::array{error.position, error.orientation, error.boresight,
                      error.line_of_sight}[static_cast<std::size_t>(quantity)];
  }

  void record(const PreparedScene& prepared, const StandingDisplacement& standing, const Placed& placed,
              RestingContacts& contacts, MotionRecorder& recorder) const {
    const Balance& balance = placed.balance;
    contacts.note(balance.now.t, balance.rest);
    recorder.accept(balance.now.t, placed.body, placed.acceleration, &placed.error);
    if (!recorder.sampling()) return;
    const DisplacedBodies displaced(prepared, standing, balance.now.t, balance.z);
    BodyAcceleration acceleration;
    for (std::size_t k = 0; k < recorder.bodies_wanted().size(); ++k) {
      const BodyMotion body = displaced.at_rest(recorder.bodies_wanted()[k], acceleration);
      recorder.sample_body(static_cast<int>(k), body, acceleration);
    }
    for (std::size_t c = 0; c < balance.rest.size(); ++c)
      recorder.sample_clearance(static_cast<int>(c), balance.rest[c].motion, balance.rest[c].contact);
  }
};

}  // namespace

std::unique_ptr<Rung> make_quasistatic(std::shared_ptr<const Mechanism> mechanism) {
  std::unique_ptr<Rung> rung = make_rests(mechanism);
  return with_error_measured_by_dynamics(std::move(rung), std::move(mechanism), false);
}

std::unique_ptr<Rung> make_rests(std::shared_ptr<const Mechanism> mechanism) {
  return std::make_unique<Quasistatic>(std::move(mechanism));
}

}  // namespace boresight
