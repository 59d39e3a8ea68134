// A journal pressed onto its sleeve's bore by a steady load, with the mechanism's own effective mass and
// contact law:
//   m x'' = -P + K d^1.5 (1 - h x' / v0),   d = -x,   x the gap
// Dropped from a small height it bounces, chatters, and comes to lasting contact, whose vibration
//   omega = sqrt(1.5 K sqrt(d_s) / m),   d_s = (P / K)^(2/3)
// an explicit method has to follow to its end, and an L-stable one steps over.
#pragma once

#include <string>

#include "boresight/contact/normal_law.hpp"
#include "boresight/contact_events/contact_report.hpp"
#include "boresight/integrate/integrator.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

class SettlingContact {
 public:
  double mass = 1.0, load = 0.0;  // [kg], [N]
  NormalLaw law;
  double minimum_impact_speed = 1e-3;  // [m/s]

  // Of one clearance of a mechanism under its typical ideal reaction; where that is nothing, under the weight
  // of the mass.
  static SettlingContact of(const Mechanism& mechanism, const Parameters& parameters, int clearance,
                            const ContactFrequency& contact);

  double rest_depth() const;         // d_s [m]
  double angular_frequency() const;  // at rest [rad/s]

  // The problem, as integrators ask for it (boresight/integrate/system.hpp). y = (x, x').
  static constexpr bool autonomous = true;
  int gap_count() const { return 1; }
  void gaps(double, const VecX& y, VecX& g) const { g[0] = y[0]; }
  void derivative(double, const VecX& y, VecX& dy) const;
  AfterEvent on_event(const GapEvent& event, VecX& y);

  // Discrete memory, and what was seen of its changes.
  bool touching = false;
  double impact_speed = 1e-3;  // latched at the start of this contact [m/s]
  double settled_at = -1.0;    // time from which contact lasts [s]; negative: it never came to that
};

struct Settling {
  std::string method;
  bool completed = false;
  std::string why_not;  // where it did not complete
  long steps = 0, rejected = 0, evaluations = 0, contacts = 0;
  double settled_at = -1.0;           // [s]
  double smallest_step = 0.0;         // [s]
  double largest_step_settled = 0.0;  // times omega, in lasting contact [-]
  double mean_step_settled = 0.0;     // times omega, in lasting contact [-]
  double end_depth = 0.0;             // [m]
};

// From `height` above the bore at rest, over `duration`, with error control at a relative tolerance.
// Explicit: Dormand and Prince's pair; else the L-stable Rosenbrock method.
Settling stabilise(SettlingContact contact, double height, double duration, double tolerance, bool explicit_pair);

}  // namespace boresight
