// What one motion on one rung gives: the indices, the contacts, the histories, and what it cost. SI throughout.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "boresight/contact/contact_memory.hpp"
#include "boresight/pointing/indices.hpp"

namespace boresight {

// One contact from its start to its end (or to the end of the motion).
struct ContactEvent {
  int clearance = 0;  // index among the mechanism's clearances
  ContactPlace place = ContactPlace::radial;
  double start = 0.0;            // [s]
  double start_speed = 0.0;      // approach speed at the start [m/s]
  double duration = 0.0;         // [s]
  double max_penetration = 0.0;  // [m]
  double max_force = 0.0;        // [N]
  double end_speed = 0.0;  // separation speed at the end, positive when parting [m/s]; 0 if still in contact at the end
};

struct ContactSummary {
  std::string joint;
  double contact_fraction = 0.0;  // share of the time in radial or axial contact
  std::int64_t impacts = 0;       // contacts begun; not those that a motion starts with
  double max_penetration = 0.0;   // [m]
  double max_force = 0.0;         // of one contact [N]
  double max_radial_force = 0.0;  // of one contact across the joint's axis, where the law that the file names acts [N]
  double max_load = 0.0;          // resultant of all its contacts, with their friction [N]
  double max_impact_speed = 0.0;  // [m/s]
  double validity_speed = 0.0;    // bound of Eq. 26 for this pair [m/s]
  std::int64_t impact_speed_above_validity = 0;
  // A journal that starts free of its sleeve has settled by now: it has lain on it once for longer than it took to get there;
  // where it never does, its first contact is over [s].
  double settled_from = 0.0;
};

// One row of timeseries.csv for one body.
struct PoseSample {
  Pose pose, ideal;
  PoseError error;
  Vec3 v = Vec3::Zero(), w = Vec3::Zero();  // world axes [m/s], [rad/s]
  Vec3 a = Vec3::Zero();                    // of the centre of mass, world axes [m/s^2]
  Vec3 alpha = Vec3::Zero();                // angular acceleration, world axes [rad/s^2]
  Vec3 ideal_a = Vec3::Zero(), ideal_alpha = Vec3::Zero();
};

struct ClearanceSample {
  Vec3 offset = Vec3::Zero();       // journal centre from sleeve centre, sleeve frame, y along the axis [m]
  double penetration = 0.0;         // deepest of its contacts; negative: the smallest gap [m]
  double normal_force = 0.0;        // sum over its contacts [N]
  int contact = 0;                  // 0 free, 1 radial, 2 axial, 3 both
  Vec3 offset_rate = Vec3::Zero();  // as seen from the sleeve [m/s]
};

struct BodyHistory {
  int body = 0;
  std::string name;
  std::vector<PoseSample> samples;  // one per entry of RunResult::time
};

// Where every body is at one sample, for pictures of the motion.
struct Frame {
  std::size_t sample = 0;         // index in RunResult::time
  std::vector<Pose> pose, ideal;  // per body of the mechanism
};

struct RunCost {
  std::int64_t steps = 0, rejected_steps = 0, evaluations = 0;
  std::int64_t shared_evaluations =
      0;  // of these, what further runs of the same rung are spared: it was found for them too
  double cpu_seconds = 0.0, wall_seconds = 0.0;
};

// ErrorEstimate::discretisation: what steps, or the instants of a rung without steps, do to its indices no single run can tell.
inline constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

// What a rung thinks its own indices are wrong by, relative, before anything else has checked it.
struct ErrorEstimate {
  PerQuantity model = {};       // by what the rung leaves out
  double discretisation = 0.0;  // by its steps or instants
  std::string basis;            // in words
  // The share of its indices that the play makes, where a rung adds what standing errors displace to a bound of it; else all.
  PerQuantity of_play = {1.0, 1.0, 1.0, 1.0};

  double model_of(PointingQuantity quantity) const { return model[static_cast<std::size_t>(quantity)]; }
  double largest_model() const { return *std::max_element(model.begin(), model.end()); }
};

struct RunResult {
  std::string rung;         // "multibody", ...
  std::string formulation;  // "paper", ... ; "" where a rung has one only
  std::string integrator;   // "RK4, h = 0.1 ms"
  // A contact was damped faster than the steps follow, as a rule (damped_contact.hpp).
  bool damped_beyond_steps = false;
  std::string integrator_taken;  // "rosenbrock": it took over from the integrator of no options; "": none did
  PointingIndices index;
  PeaksOfParts peaks = {};                        // from `start` on; zero where a rung does not follow a motion
  std::vector<ContactSummary> contact;            // per clearance
  Vec3 platform_acceleration_max = Vec3::Zero();  // of the boresight body's centre of mass, per world axis [m/s^2]
  double constraint_drift = 0.0;                  // largest violation of a position constraint met [m or rad]
  double energy_error = 0.0;  // largest |energy balance| relative to the largest energy met; 0 where not tracked
  double start = 0.0;         // indices, contact summaries and peaks count from here on [s]
  double settled_from = 0.0;  // the last of ContactSummary::settled_from [s]
  double end_time = 0.0;      // the motion was followed up to here [s]
  bool interrupted = false;   // stopped by the caller before the end

  ErrorEstimate error;

  std::vector<double> time;                              // sample times [s]
  BodyHistory boresight;                                 // of the boresight body
  std::vector<BodyHistory> others;                       // bodies asked for besides
  std::vector<Frame> frames;                             // in the order of time, where asked for
  std::vector<std::vector<ClearanceSample>> clearances;  // [clearance][sample]
  std::vector<ContactEvent> events;                      // in the order of their starts
  std::vector<std::string> warnings;
  RunCost cost;
};

}  // namespace boresight
