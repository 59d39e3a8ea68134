// One motion of the multibody rung, by a method with fixed steps or by one that locates its contacts: what both are made of.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight/contact_events/contact_tracker.hpp"
#include "boresight/formulations/formulation.hpp"
#include "boresight/rungs/motion_recorder.hpp"
#include "boresight/rungs/rung.hpp"
#include "boresight/stepping/default_integrator.hpp"

namespace boresight {

// What is followed, and how. Refers to things that outlive it.
struct MultibodyMotion {
  const Mechanism& mechanism;
  const Parameters& parameters;
  const RunOptions& options;
  const IdealMotion& ideal;      // of this mechanism: its drives, and where it starts
  const IdealMotion& commanded;  // of the drawn mechanism: what poses are held against

  std::unique_ptr<Formulation> make_formulation() const;
  std::vector<ContactTracker> make_trackers(const ForceElements& forces) const;
  // Shows poses, and the contacts as they were last evaluated, to the recorder.
  void record(Formulation& formulation, const VecX& y, double t, MotionRecorder& recorder) const;
  // What both ways of integrating report alike.
  void complete(RunResult& result, std::vector<ContactTracker>& trackers) const;
};

inline constexpr char kMultibody[] = "multibody";

// RK4 with steps of `wanted_step` [s], shortened evenly so that whole steps reach the end. Throws UnstableStep.
RunResult follow_in_fixed_steps(const MultibodyMotion& motion, double wanted_step, WhereDampedBeyond where_beyond);
// By an integrator that locates its contacts. Throws ComputationError.
RunResult follow_locating_contacts(const MultibodyMotion& motion, const std::string& integrator);

}  // namespace boresight
