#include "boresight/contact_events/located_contacts.hpp"

namespace boresight {
namespace {

constexpr double kOutOfReach = 1e6;  // [m]

bool is_axial(ContactPlace place) { return place >= ContactPlace::axial_minus; }

}  // namespace

LocatedContacts::LocatedContacts(const std::vector<JournalInSleeve>& joints, std::vector<ContactTracker>& trackers)
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
  const ContactMemory& memory = (*trackers_)[clearance].memory();
  bool radial = false, axial = false;
  for (int g = first_[clearance]; g < gap_count() && gaps_[g].clearance == clearance; ++g)
    if (memory.touching[static_cast<int>(gaps_[g].place)]) (is_axial(gaps_[g].place) ? axial : radial) = true;
  const JournalInSleeve& own = own_[clearance];
  JournalInSleeve& acting = acting_[clearance];
  acting.radial_clearance = acting.tilted.radial_clearance = radial ? own.radial_clearance : kOutOfReach;
  acting.axial_clearance = acting.tilted.axial_clearance = axial ? own.axial_clearance : kOutOfReach;
}

}  // namespace boresight
