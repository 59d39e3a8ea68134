// The numbers of a clearance joint's contacts that a parameter may change: what samples vary, and what is fitted.
#pragma once

#include <array>

#include "boresight/contact/journal_in_sleeve.hpp"

namespace boresight {

inline constexpr int kContactNumbers = 26;

// Always in the same order.
template <typename T>
std::array<T*, kContactNumbers> numbers_of(JournalInSleeveT<T>& j) {
  return {&j.radial_clearance,
          &j.axial_clearance,
          &j.bore_radius,
          &j.half_length,
          &j.radial_law.stiffness,
          &j.radial_law.damping_factor,
          &j.radial_law.length,
          &j.radial_law.exponent,
          &j.radial_law.dashpot,
          &j.face_stiffness,
          &j.friction.coefficient,
          &j.friction.static_speed,
          &j.friction.dynamic_speed,
          &j.friction.stiction,
          &j.friction.stribeck_speed,
          &j.tilted.radial_clearance,
          &j.tilted.axial_clearance,
          &j.tilted.bore_radius,
          &j.tilted.half_length,
          &j.tilted.ring_radius,
          &j.tilted.face_stiffness,
          &j.tilted.end_law.stiffness,
          &j.tilted.end_law.damping_factor,
          &j.tilted.end_law.length,
          &j.tilted.end_law.exponent,
          &j.tilted.end_law.dashpot};
}

}  // namespace boresight
