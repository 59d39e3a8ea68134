#include "boresight/contact_events/located_contacts.hpp"

namespace boresight {
LocatedContacts::LocatedContacts(const std::vector<JointPlay>& joints, std::vector<ContactTracker>& trackers)
    : own_(joints), acting_(joints), trackers_(&trackers) {
  for (std::size_t c = 0; c < joints.size(); ++c) {
    first_.push_back(gap_count());
    for (ContactPlace place : joints[c].places()) gaps_.push_back({static_cast<int>(c), place});
    act(static_cast<int>(c));
  }
  first_.push_back(gap_count());
}

void LocatedContacts::read(int clearance, const std::array<ContactState<double>, kContactPlaces>& contact,
                           VecX& gaps) const {
  for (int g = first_[clearance]; g < first_[clearance + 1]; ++g)
    gaps[g] = -contact[static_cast<int>(gaps_[g].place)].penetration;
}

void LocatedContacts::change(const GapEvent& event, const std::array<ContactState<double>, kContactPlaces>& contact) {
  const Gap& gap = gaps_[event.gap];
  const double rate = contact[static_cast<int>(gap.place)].rate;
  ContactTracker& tracker = (*trackers_)[gap.clearance];
  if (event.crossing == Crossing::closing || event.crossing == Crossing::lasting)
    tracker.begin(gap.place, event.t, rate);
  else
    tracker.end(gap.place, event.t, -rate);
  act(gap.clearance);
}

void LocatedContacts::start(int clearance, double t, const std::array<ContactState<double>, kContactPlaces>& contact) {
  for (int g = first_[clearance]; g < first_[clearance + 1]; ++g) {
    const ContactState<double>& at = contact[static_cast<int>(gaps_[g].place)];
    if (at.penetration >= 0.0) (*trackers_)[clearance].begin_at_start(gaps_[g].place, t, at.rate);
  }
  act(clearance);
}

void LocatedContacts::act(int clearance) {
  acting_[clearance] = own_[clearance];
  acting_[clearance].keep_only((*trackers_)[clearance].memory().touching);
}

}  // namespace boresight
