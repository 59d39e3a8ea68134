// The fastest vibration of the contacts where they stand, which bounds the step of an explicit method.
//
//   omega^2 = largest eigenvalue of  D^(1/2) N^T A N D^(1/2)
// with A the offset compliance [1/kg] (Formulation::offset_compliance), one column of N per touching contact (its normal, in
// its joint's sleeve frame), D the tangent stiffnesses [N/m]: 1.5 K sqrt(d) radial, K_c axial. Joints that share a light
// link are so taken together: two stiff contacts on one light body vibrate faster than either alone.
#pragma once

#include "boresight/rungs/force_elements.hpp"

namespace boresight {

struct StiffestContact {
  double angular_frequency = 0.0;  // [rad/s]; 0 if nothing touches
  int clearance = -1;              // the contact with the largest share in that vibration
  ContactPlace place = ContactPlace::radial;
};

StiffestContact stiffest_contact(const std::vector<JournalInSleeve>& joints,
                                 const std::vector<JournalMotion<double>>& motion,
                                 const MatX& offset_compliance);

// An upper bound of the same angular frequency squared [1/s^2], without an eigenvalue: the trace.
double stiffest_contact_bound(const std::vector<JournalInSleeve>& joints, const std::vector<JournalMotion<double>>& motion,
                              const Eigen::Ref<const MatX>& offset_compliance);

}  // namespace boresight
