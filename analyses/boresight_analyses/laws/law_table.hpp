// Every contact and friction law side by side: what restitution it returns, how its force goes, where it
// holds.
#pragma once

#include <vector>

#include "boresight/contact/friction_law.hpp"
#include "boresight/contact/impact.hpp"
#include "boresight/contact/normal_law.hpp"

namespace boresight {

// The restitutions asked for.
inline const std::vector<double>& asked_restitutions() {
  static const std::vector<double> asked = {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99};
  return asked;
}

struct NormalLawRow {
  const NormalLawEntry* entry = nullptr;
  std::vector<double> returned;     // per asked restitution, by integrating an impact; NaN where it cannot be asked
  double good_from = 1.0;           // lowest e asked for from which on it is returned within 0.02 (2 where nowhere)
  Impact one;                       // of the joint's own restitution
  std::vector<ImpactSample> path;   // of that impact
  std::vector<double> penetration;  // [m]
  std::vector<double> force;        // without dissipation, at `penetration` [N]
};

// Of a joint: its geometry and material. mass [kg] strikes at speed [m/s]. A spring (Kelvin-Voigt) without a
// stiffness of its own takes the secant of Hertz's law at the depth of that impact, and the dashpot that
// gives the mass the restitution.
std::vector<NormalLawRow> normal_law_table(ClearanceParameters joint, double mass, double speed);

struct FrictionLawRow {
  const FrictionLawEntry* entry = nullptr;
  std::vector<double> speed;  // [m/s]
  std::vector<double> force;  // steady, over the normal force [-]
};

std::vector<FrictionLawRow> friction_law_table(const FrictionParameters& parameters);

}  // namespace boresight
