#include "boresight/multibody/multibody_motion.hpp"

#include <algorithm>
#include <cstdio>

#include "boresight/rungs/fast_impacts.hpp"
#include "boresight/rungs/start_up.hpp"

namespace boresight {
namespace {

// More than this share of the largest energy is worth a word: as much of what carries the motion as is mostly asked of an index.
constexpr double kEnergyLost = 0.01;

void note_lost_energy(RunResult& result) {
  if (!(result.energy_error > kEnergyLost)) return;
  char text[200];
  std::snprintf(
      text, sizeof text,
      "the steps make or lose up to %.2g %% of the largest energy of this motion; a shorter --step, or a smaller "
      "--tolerance of an --integrator with error control, keeps it",
      100.0 * result.energy_error);
  result.warnings.push_back(text);
}

}  // namespace

std::vector<ContactTracker> MultibodyMotion::make_trackers(const ForceElements& forces) const {
  std::vector<ContactTracker> trackers;
  const MechanismDescription& m = mechanism.description();
  for (int c = 0; c < mechanism.clearances(); ++c)
    trackers.emplace_back(c, m.joints[m.clearances[c].joint].name, forces.joint(c), options.events, options.start);
  return trackers;
}

void MultibodyMotion::complete(RunResult& result, std::vector<ContactTracker>& trackers) const {
  result.rung = kMultibody;
  result.formulation = options.formulation.empty() ? "tree" : options.formulation;
  for (ContactTracker& tracker : trackers) result.contact.push_back(tracker.finish(result.end_time, result.events));
  std::stable_sort(result.events.begin(), result.events.end(),
                   [](const ContactEvent& a, const ContactEvent& b) { return a.start < b.start; });
  note_lost_energy(result);
  note_fast_impacts(result);
  note_start_up(mechanism, result);
}

std::unique_ptr<Formulation> MultibodyMotion::make_formulation() const {
  const bool paper = options.formulation == "paper";
  // Each formulation's own habit where nothing is asked for: the paper's is Baumgarte's, the tree's projection.
  const bool project = options.stabilisation.empty() ? !paper : options.stabilisation == "projection";
  const Stabilisation stabilisation = project ? Stabilisation::projection : Stabilisation::baumgarte;
  if (paper)
    return make_paper_formulation(mechanism, parameters, &ideal,
                                  {true, stabilisation, options.baumgarte_alpha, options.baumgarte_beta});
  return make_tree_formulation(mechanism, parameters, &ideal,
                               {true, stabilisation, options.baumgarte_alpha, options.baumgarte_beta});
}

void MultibodyMotion::record(Formulation& formulation, const VecX& y, double t, MotionRecorder& recorder) const {
  const std::vector<BodyMotion>& bodies = formulation.bodies(t, y);
  const std::vector<BodyAcceleration>& acceleration = formulation.acceleration();
  const int b = mechanism.boresight_body();
  recorder.accept(t, bodies[b], acceleration[b]);
  if (!recorder.sampling()) return;
  const std::vector<int>& wanted = recorder.bodies_wanted();
  for (std::size_t k = 0; k < wanted.size(); ++k)
    recorder.sample_body(static_cast<int>(k), bodies[wanted[k]], acceleration[wanted[k]]);
  const ForceElements& forces = formulation.forces();
  for (int c = 0; c < forces.clearances(); ++c)
    recorder.sample_clearance(c, forces.motion(c), forces.contact(c).contact);
}

}  // namespace boresight
