// All that a run gives, as numbers to be kept: numbers.hpp.
#pragma once

#include "boresight/rungs/run_result.hpp"
#include "boresight_analyses/runs/numbers.hpp"

namespace boresight {

inline void fields(Numbers& n, Statistics& s) { n(s.max, s.rms, s.mean, s.p9973, s.time_of_max); }
inline void fields(Numbers& n, PointingIndices& i) {
  n(i.position_error, i.orientation_error, i.boresight_error, i.line_of_sight_error, i.has_line_of_sight);
}
inline void fields(Numbers& n, Pose& p) { n(p.p, p.q); }
inline void fields(Numbers& n, PoseError& e) {
  n(e.displacement, e.rotation, e.position, e.orientation, e.boresight, e.line_of_sight);
}
inline void fields(Numbers& n, ContactEvent& e) {
  n(e.clearance, e.place, e.start, e.start_speed, e.duration, e.max_penetration, e.max_force, e.end_speed);
}
inline void fields(Numbers& n, ContactSummary& c) {
  n(c.joint, c.contact_fraction, c.impacts, c.max_penetration, c.max_force, c.max_radial_force, c.max_load,
    c.max_impact_speed, c.validity_speed, c.impact_speed_above_validity, c.settled_from);
}
inline void fields(Numbers& n, PoseSample& s) {
  n(s.pose, s.ideal, s.error, s.v, s.w, s.a, s.alpha, s.ideal_a, s.ideal_alpha);
}
inline void fields(Numbers& n, ClearanceSample& s) {
  n(s.offset, s.penetration, s.normal_force, s.contact, s.offset_rate);
}
inline void fields(Numbers& n, BodyHistory& h) { n(h.body, h.name, h.samples); }
inline void fields(Numbers& n, Frame& f) { n(f.sample, f.pose, f.ideal); }
inline void fields(Numbers& n, RunCost& c) {
  n(c.steps, c.rejected_steps, c.evaluations, c.cpu_seconds, c.wall_seconds);
}
inline void fields(Numbers& n, ErrorEstimate& e) {
  for (double& share : e.model) n(share);
  n(e.discretisation, e.basis);
}
inline void fields(Numbers& n, RunResult& r) {
  n(r.rung, r.formulation, r.integrator, r.damped_beyond_steps, r.integrator_taken, r.index, r.contact,
    r.platform_acceleration_max, r.constraint_drift, r.energy_error, r.start, r.settled_from, r.end_time, r.interrupted,
    r.error, r.time, r.boresight, r.others, r.frames, r.clearances, r.events, r.warnings, r.cost);
}

}  // namespace boresight
