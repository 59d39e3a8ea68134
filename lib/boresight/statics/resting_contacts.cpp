#include "boresight/statics/resting_contacts.hpp"

#include <algorithm>

namespace boresight {

RestingContacts::RestingContacts(const ReactionTable& reactions, double start)
    : start_(start),
      summary_(reactions.joints().size()),
      touches_(summary_.size(), false),
      touching_(summary_.size(), 0.0) {
  for (std::size_t c = 0; c < summary_.size(); ++c) {
    summary_[c].joint = reactions.joint_name(static_cast<int>(c));
    summary_[c].validity_speed = reactions.joints()[c].validity_speed;
  }
}

void RestingContacts::note(double t, const std::vector<RestingPlay>& rest) {
  if (t < start_) return;
  if (!noted_) first_ = last_ = t;
  for (std::size_t c = 0; c < summary_.size(); ++c) {
    ContactSummary& of = summary_[c];
    of.max_load = std::max(of.max_load, rest[c].carried);
    of.max_penetration = std::max(of.max_penetration, rest[c].penetration());
    for (int k = 0; k < kContactPlaces; ++k) {
      const double force = rest[c].contact[k].normal_force;
      of.max_force = std::max(of.max_force, force);
      if (!is_axial(static_cast<ContactPlace>(k))) of.max_radial_force = std::max(of.max_radial_force, force);
    }
    // Half of a step in which a contact begins or ends.
    const bool touches = rest[c].normal_force() > 0.0;
    touching_[c] += 0.5 * (t - last_) * ((noted_ && touches_[c]) + touches);
    touches_[c] = touches;
  }
  noted_ = true;
  last_ = t;
}

std::vector<ContactSummary> RestingContacts::finish() const {
  std::vector<ContactSummary> result = summary_;
  for (std::size_t c = 0; c < result.size(); ++c)
    result[c].contact_fraction = last_ > first_ ? std::min(1.0, touching_[c] / (last_ - first_)) : touches_[c];
  return result;
}

}  // namespace boresight
