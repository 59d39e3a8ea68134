// The fastest vibration of the contacts where they stand, which bounds the step of an explicit method.
//
//   omega^2 = largest eigenvalue of  N^T A N
// with A the offset compliance (Formulation::offset_compliance) and one column of N per way in which a touching contact is
// stiff: the gradient of its penetration with respect to the offsets, times the root of its tangent stiffness: 1.5 K sqrt(d)
// radial (K / 2 at each end of a tilting journal), K_c axial, and of a tilted face three columns (derivatives of
// ring_contact). Joints that share a light link are so taken together: two stiff contacts on one light body vibrate faster
// than either alone.
#pragma once

#include "boresight/formulations/force_elements.hpp"
#include "boresight/mechanism/offset_layout.hpp"

namespace boresight {

struct StiffestContact {
  double angular_frequency = 0.0;  // [rad/s]; 0 if nothing touches
  int clearance = -1;              // the contact with the largest share in that vibration
  ContactPlace place = ContactPlace::radial;
};

StiffestContact stiffest_contact(const OffsetLayout& layout, const std::vector<JointPlay>& joints,
                                 const std::vector<PlayMotion<double>>& motion,
                                 const Eigen::Ref<const MatX>& compliance);

// An upper bound of the same angular frequency squared [1/s^2], without an eigenvalue: the trace.
double stiffest_contact_bound(const OffsetLayout& layout, const std::vector<JointPlay>& joints,
                              const std::vector<PlayMotion<double>>& motion, const Eigen::Ref<const MatX>& compliance);

}  // namespace boresight
