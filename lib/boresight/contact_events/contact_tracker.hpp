// Follows the contacts of one clearance joint over the accepted steps: keeps their memory (impact speeds), and writes the
// events and the summary.
//
// With steps that do not stop at contact, a start inside a step is placed by carrying the free flight on: the rate of the
// gap as the parabola through its last three free values, an error of O(h^3) in the impact speed, so that latching does not
// lower the order of the integrator through contact (a speed latched one step late would make it 1). What lies beyond the
// start is not used: the contact's force has already bent it. An end, where the force fades smoothly, is placed by the cubic
// that meets gap and rate at both ends of the step.
//
// Beginnings and ends of contacts are found in three ways, one a way of stepping, and kept here for the first two: by accept(),
// where steps do not stop at contacts; by the Integrator's events (LocatedContacts), found on a method's dense output; and in
// lanes (lanes/lane_contacts.hpp), where every sample of a register has its own step and no branch of its own, by one cubic
// with four rounds of Newton. They share ContactState and what a joint's places are; what tells them apart is the stepping.
#pragma once

#include <vector>

#include "boresight/play/joint_play.hpp"
#include "boresight/rungs/run_result.hpp"

namespace boresight {

class ContactTracker {
 public:
  // start: the summary leaves out what comes before [s]; events are kept from t = 0 on.
  ContactTracker(int clearance, std::string joint_name, const JointPlay& law, bool keep_events, double start = 0.0);

  // The state of the contacts at an accepted time, from JointPlay::penetrations. Call at the start, then after every step.
  // Returns true if a contact began or ended.
  bool accept(double t, const std::array<ContactState<double>, kContactPlaces>& contact);
  // Forces at the state accepted last: normal_force of each place, and what they come to with their friction.
  void observe_forces(const PlayWrench<double>& wrench);

  // Where the integrator locates the contacts itself, in place of accept(): observe() at the end of every step and
  // wherever else a state is at hand, then begin() and end() of what changes there. speed: of approach, of separation
  // [m/s]. A contact that is open may act inside a trial step, where another one of its direction is closed (the other end
  // of a tilting journal): like accept(), observe() keeps for it the speed at which it would begin now, not that of the
  // contact before.
  void observe(double t, const std::array<ContactState<double>, kContactPlaces>& contact);
  void begin(ContactPlace place, double t, double speed);
  // A contact that the motion starts with: none has struck.
  void begin_at_start(ContactPlace place, double t, double speed);
  void end(ContactPlace place, double t, double speed);

  const ContactMemory& memory() const { return memory_; }
  bool touching() const;
  // Whether the joint has been touched without a break since before this time [s].
  bool touching_since(double t) const { return touching() && touched_since_ <= t; }

  // Closes contacts still in force and returns what was seen.
  ContactSummary finish(double t_end, std::vector<ContactEvent>& events);

 private:
  void open(ContactPlace place, double t, double speed);
  void deepen(ContactEvent& event, double t, double penetration);
  void add_touching(double from, double to);
  void note_first_rest(double from, double to);
  bool counts(double t) const { return t >= start_; }

  int clearance_;
  std::vector<ContactPlace> places_;
  double minimum_impact_speed_;
  bool keep_events_, started_ = false;
  double start_;
  // Of the whole joint: when it was first touched, since when it is, when the first contact ended, when one first lasted [s].
  double first_touched_ = -1.0, touched_since_ = -1.0, first_parted_ = -1.0, settled_ = -1.0;
  ContactMemory memory_;
  double t_ = 0.0, touching_time_ = 0.0;
  struct FreeFlight {  // the last free values of one gap, newest first
    int count = 0;
    std::array<double, 3> t{}, rate{};
    double penetration = 0.0;
  };
  std::array<FreeFlight, kContactPlaces> flight_{};
  std::array<ContactState<double>, kContactPlaces> last_{};
  std::array<ContactEvent, kContactPlaces> open_{};
  std::vector<ContactEvent> closed_;
  ContactSummary summary_;
};

}  // namespace boresight
