// A clearance joint's law with the numbers of another sample in every lane.
#pragma once

#include <array>

#include "boresight/contact/journal_in_sleeve.hpp"

namespace boresight {

// The numbers that a sample may vary.
template <typename T>
std::array<T*, 18> law_numbers(JournalInSleeveT<T>& law) {
  TiltedJournalT<T>& t = law.tilted;
  return {&law.radial_clearance,    &law.axial_clearance,      &law.bore_radius,
          &law.half_length,         &law.radial_law.stiffness, &law.radial_law.damping_factor,
          &law.face_stiffness,      &law.friction.coefficient, &law.friction.static_speed,
          &law.friction.dynamic_speed, &t.radial_clearance,    &t.axial_clearance,
          &t.bore_radius,           &t.half_length,            &t.ring_radius,
          &t.end_law.stiffness,     &t.end_law.damping_factor, &t.face_stiffness};
}

// What is the same for all samples, and every lane the numbers of `law`.
template <typename T>
JournalInSleeveT<T> in_all_lanes(JournalInSleeve law) {
  JournalInSleeveT<T> out;
  out.has_faces = law.has_faces;
  out.tilts = law.tilts;
  out.tilted.has_faces = law.tilted.has_faces;
  out.tilted.slides = law.tilted.slides;
  // Without friction the coefficient is zero: the common law does.
  out.friction.kind = law.friction.kind == FrictionKind::none ? FrictionKind::modified_coulomb : law.friction.kind;
  const auto from = law_numbers<double>(law);
  const auto to = law_numbers<T>(out);
  for (std::size_t i = 0; i < to.size(); ++i) *to[i] = T(*from[i]);
  out.tilted.friction = out.friction;
  return out;
}

template <typename T>
void set_lane(JournalInSleeveT<T>& out, int lane, JournalInSleeve law) {
  const auto from = law_numbers<double>(law);
  const auto to = law_numbers<T>(out);
  for (std::size_t i = 0; i < to.size(); ++i) to[i]->set(lane, *from[i]);
  out.tilted.friction = out.friction;
}

}  // namespace boresight
