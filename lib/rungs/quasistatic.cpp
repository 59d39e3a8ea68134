#include "boresight/rungs/quasistatic.hpp"

#include <algorithm>

#include "boresight/rungs/measured_by_dynamics.hpp"
#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/rungs/reaction_table.hpp"
#include "boresight/rungs/scene_rung.hpp"

namespace boresight {
namespace {

constexpr int kInstantsBetweenLooks = 256;  // at whether to go on

class Quasistatic final : public SceneRung {
 public:
  explicit Quasistatic(std::shared_ptr<const Mechanism> mechanism) : SceneRung(std::move(mechanism)) {}

  std::string name() const override { return "quasistatic"; }
  std::string leaves_out() const override {
    return "Impacts and vibration: the journal rests where the ideal joint's reaction pushes it, so maxima that impacts set "
           "come out low. Velocities and accelerations shown are those of the ideal motion.";
  }

 private:
  RunResult follow(const PreparedScene& prepared, const Parameters& parameters, const RunOptions& options) const override {
    const ReactionTable reactions(mechanism(), prepared.scene(), parameters);
    const std::vector<JournalInSleeve>& joints = reactions.joints();
    MotionRecorder recorder(mechanism(), prepared.ideal(), options, reactions.instants());
    std::vector<Rest> rest(joints.size());
    std::vector<ContactSummary> summary = reactions.summaries();
    bool interrupted = false;
    for (int i = 0; i < reactions.instants() && !interrupted; ++i) {
      const ReactionTable::Instant now = reactions.at(i);
      interrupted = i % kInstantsBetweenLooks == 0 && options.progress &&
                    !options.progress({now.t, mechanism().duration(), recorder.position_error_max()});
      for (std::size_t c = 0; c < joints.size(); ++c) {
        rest[c] = rest_under(joints[c], now.load[c].force, now.load[c].slide, rest[c]);
        reactions.note(rest[c], summary[c]);
      }
      const VecX z = reactions.coordinates(rest);
      const DisplacedBodies displaced(prepared, now.t, z);
      BodyAcceleration acceleration;
      BodyMotion body = displaced.at_rest(mechanism().boresight_body(), acceleration);
      recorder.accept(now.t, body, acceleration);
      if (!recorder.sampling()) continue;
      for (std::size_t k = 0; k < recorder.bodies_wanted().size(); ++k) {
        body = displaced.at_rest(recorder.bodies_wanted()[k], acceleration);
        recorder.sample_body(static_cast<int>(k), body, acceleration);
      }
      for (std::size_t c = 0; c < joints.size(); ++c)
        recorder.sample_clearance(static_cast<int>(c), rest[c].motion, rest[c].contact);
    }
    RunResult result = recorder.finish();
    result.interrupted = interrupted;
    result.integrator = "none: one static balance an instant";
    result.contact = std::move(summary);
    result.cost.steps = result.cost.evaluations = reactions.instants();
    return result;
  }
};

}  // namespace

std::unique_ptr<Rung> make_quasistatic(std::shared_ptr<const Mechanism> mechanism) {
  auto rung = std::make_unique<Quasistatic>(mechanism);
  return with_error_measured_by_dynamics(std::move(rung), std::move(mechanism), false);
}

}  // namespace boresight
