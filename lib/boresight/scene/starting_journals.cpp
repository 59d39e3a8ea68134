#include "boresight/scene/starting_journals.hpp"

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/scene/clearance_scene.hpp"
#include "boresight/scene/offset_dynamics.hpp"
#include "boresight/scene/resting_start.hpp"
#include "boresight/scene/tipping.hpp"

namespace boresight {

StartingJournals starting_journals(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal) {
  const MechanismDescription& m = mechanism.description();
  StartingJournals start;
  for (const ClearanceDescription& c : m.clearances)
    start.journals.push_back({m.joints[c.joint].name, Vec3::Zero(), Vec3::Zero()});
  if (m.journals == JournalStart::centred || m.clearances.empty()) return start;
  // No other than the drawn ones without errors. Neither is owned: they outlive this.
  const BuiltMotion built =
      built_motion({std::shared_ptr<void>(), &mechanism}, {std::shared_ptr<void>(), &ideal}, parameters);
  try {
    const ClearanceScene::Start scene = ClearanceScene::at_start(*built.mechanism, *built.motion, parameters);
    start.remark = tipping_sentence(mechanism, scene.layout);
    if (start.remark.empty()) start.undecided = undecided_sentence(mechanism, scene.layout);
    const VecX state =
        start_coordinates(mechanism, scene.layout, scene.numbers, joint_plays(m, parameters), start.warning);
    for (std::size_t c = 0; c < start.journals.size(); ++c) {
      const PlayMotion<double> motion = play_motion(scene.layout, scene.layout.joints[c], scene.numbers.row.data(),
                                                    state.data(), state.data() + scene.layout.n);
      start.journals[c].offset = motion.e;
      if (m.clearances[c].axes == JournalAxes::free) start.journals[c].slope = {motion.slope[0], 0.0, motion.slope[1]};
    }
  } catch (const ComputationError& failure) {
    start.warning = centred_for_want_of(mechanism, failure.what());
  }
  return start;
}

}  // namespace boresight
