// The contacts of all clearance joints as the gaps that an integrator watches: one gap for each place at which a joint
// can touch.
//
// A contact that the memory calls open must give no force, even where a trial step dips below zero: the step is then
// smooth up to its event. So the laws that act() differ from the joints' own: JointPlay::keep_only().
#pragma once

#include "boresight/contact_events/contact_tracker.hpp"
#include "boresight/integrate/system.hpp"

namespace boresight {

class LocatedContacts {
 public:
  LocatedContacts(const std::vector<JointPlay>& joints, std::vector<ContactTracker>& trackers);

  int gap_count() const { return static_cast<int>(gaps_.size()); }
  // Of one joint, from JointPlay::penetrations: into the places that gap_count() counts. Open where positive [m].
  void read(int clearance, const std::array<ContactState<double>, kContactPlaces>& contact, VecX& gaps) const;

  // Tells the trackers. contact: of the joint that joint_of() names, at the event.
  int joint_of(const GapEvent& event) const { return gaps_[event.gap].clearance; }
  void change(const GapEvent& event, const std::array<ContactState<double>, kContactPlaces>& contact);
  // At the start: contacts that begin closed.
  void start(int clearance, double t, const std::array<ContactState<double>, kContactPlaces>& contact);

  bool touches(int clearance) const { return (*trackers_)[clearance].touching(); }
  const JointPlay& acting(int clearance) const { return acting_[clearance]; }

 private:
  struct Gap {
    int clearance;
    ContactPlace place;
  };
  void act(int clearance);

  std::vector<Gap> gaps_;
  std::vector<int> first_;  // gap of each joint
  std::vector<JointPlay> own_, acting_;
  std::vector<ContactTracker>* trackers_;
};

}  // namespace boresight
