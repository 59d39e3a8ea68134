// The numbers of all contacts (JournalInSleeve) as functions of the fitted parameters, with their
// derivatives.
//
// A contact's numbers are closed-form functions of a mechanism's parameters (hertz.hpp, the laws' damping
// factors). Their derivatives, a constant of a whole motion, are taken here by central differences of eighth
// order in the logarithm of the parameter: step 1 %, truncation 1e-16, rounding some 1e-13, relative
// (Fornberg 1988, Mathematics of Computation 51, 699-706, table 1). So every law and every parameter path
// serves without a second copy of its equation. What follows from them, the motion, is differentiated by
// jets.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "boresight/contact/journal_in_sleeve.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

inline constexpr int kContactNumbers = 26;

// The numbers of a contact that a parameter may change, always in the same order.
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

struct ContactNumbers {
  std::vector<JournalInSleeve> joints;  // per clearance
  std::vector<std::vector<std::array<double, kContactNumbers>>>
      by;                      // [parameter][clearance]: d number / d parameter
  std::vector<double> values;  // of the parameters
};

// parameters_at: the mechanism's parameters at some values of those fitted. values: > 0.
ContactNumbers contact_numbers(const Mechanism& mechanism,
                               const std::function<Parameters(const std::vector<double>&)>& parameters_at,
                               const std::vector<double>& values);

}  // namespace boresight
