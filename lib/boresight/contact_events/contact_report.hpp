// What `check` says of the contacts before anything is integrated: stiffness, frequency, largest stable step.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

struct ContactFrequency {
  std::string joint;
  double hertz_stiffness = 0.0;  // K of the radial contact [N/m^1.5]; 0 where the law is not Hertz's
  double axial_stiffness = 0.0;  // K_c [N/m]; 0 where there is no axial contact
  double effective_mass = 0.0;   // smallest over directions of the offset [kg]
  double typical_load = 0.0;     // RMS of the ideal joint reaction along the motion [N]
  double largest_load = 0.0;     // of it [N]
  // Of its part along the axis, where a contact carries that, and of the rest, which the contact across the axis carries [N].
  double typical_axial_load = 0.0, largest_axial_load = 0.0, typical_radial_load = 0.0, largest_radial_load = 0.0;
  double typical_penetration = 0.0;  // the deeper one under these typical loads [m]
  double angular_frequency = 0.0;    // of the stiffest contact, at the deepest penetration foreseen [rad/s]
  double largest_stable_step = 0.0;  // of RK4: 2.785 / angular_frequency [s]
  double validity_speed = 0.0;       // Eq. 26 [m/s]
};

std::vector<ContactFrequency> analyse_contacts(const Mechanism& mechanism, const Parameters& parameters);
std::vector<ContactFrequency> analyse_contacts(const Mechanism& mechanism, const Parameters& parameters,
                                               const IdealMotion& ideal);

}  // namespace boresight
