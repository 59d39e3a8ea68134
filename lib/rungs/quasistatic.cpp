#include "boresight/rungs/quasistatic.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/rungs/reaction_table.hpp"
#include "boresight/rungs/resting_journal.hpp"
#include "boresight/rungs/scene_rung.hpp"

namespace boresight {
namespace {

class Quasistatic final : public SceneRung {
 public:
  explicit Quasistatic(std::shared_ptr<const Mechanism> mechanism) : SceneRung(std::move(mechanism)) {}

  std::string name() const override { return "quasistatic"; }
  std::string leaves_out() const override {
    return "Impacts and vibration: the journal rests where the ideal joint's reaction pushes it, so maxima that impacts set "
           "come out low. Velocities and accelerations shown are those of the ideal motion.";
  }

 private:
  RunResult follow(const Parameters& parameters, const RunOptions& options) const override {
    const ReactionTable reactions(mechanism(), scene(), parameters);
    const std::vector<JournalInSleeve>& joints = reactions.joints();
    MotionRecorder recorder(mechanism(), ideal(), options, reactions.instants());
    std::vector<Rest> rest(joints.size());
    std::vector<ContactSummary> summary = reactions.summaries();
    for (int i = 0; i < reactions.instants(); ++i) {
      const ReactionTable::Instant now = reactions.at(i);
      VecX xi(3 * static_cast<int>(joints.size()));
      for (std::size_t c = 0; c < joints.size(); ++c) {
        rest[c] = rest_under(joints[c], now.reaction.segment<3>(3 * static_cast<int>(c)), rest[c]);
        xi.segment<3>(3 * static_cast<int>(c)) = rest[c].offset;
        reactions.note(rest[c], summary[c]);
      }
      BodyAcceleration acceleration;
      BodyMotion body = ideal().body(now.t, mechanism().boresight_body(), &acceleration);
      displace(body, now.pose_gain * xi);
      recorder.accept(now.t, body, acceleration);
      if (!recorder.sampling()) continue;
      for (std::size_t c = 0; c < joints.size(); ++c) {
        JournalMotion<double> motion{rest[c].offset, Vec3::Zero(), Vec3::Zero()};
        std::array<ContactState<double>, kContactPlaces> contact;
        joints[c].gaps(motion, contact);
        contact[static_cast<int>(ContactPlace::radial)].normal_force = rest[c].radial_force;
        contact[static_cast<int>(rest[c].offset.y() > 0.0 ? ContactPlace::axial_minus : ContactPlace::axial_plus)]
            .normal_force = rest[c].axial_force;
        recorder.sample_clearance(static_cast<int>(c), motion, contact);
      }
    }
    RunResult result = recorder.finish();
    result.integrator = "none: one static balance an instant";
    result.contact = std::move(summary);
    result.cost.steps = result.cost.evaluations = reactions.instants();
    return result;
  }
};

}  // namespace

std::unique_ptr<Rung> make_quasistatic(std::shared_ptr<const Mechanism> mechanism) {
  return std::make_unique<Quasistatic>(std::move(mechanism));
}

}  // namespace boresight
