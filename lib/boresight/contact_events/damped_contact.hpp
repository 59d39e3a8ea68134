// How fast the contacts' damping and friction act where they stand, which bounds the step of an explicit method as their stiffness does
// (stiffest_contact.hpp).
//
//   rate = largest eigenvalue of  A D
// with A the offset compliance and D = -d f / d (offset rates) of all touching contacts, friction included. A contact at rest under a load
// F, its impact speed v the least that the file allows, has D = chi F / v in the laws of Hunt and Crossley's family, however small v is;
// friction has mu F over the speed in which it sets in. Beyond RK4's limit (2.785 / h) such a contact is opened and shut by the steps, with
// forces of any size. Less damping is no way out, for it decides how far an impact under load goes; an implicit method is, and takes over
// (default_integrator.hpp).
#pragma once

#include <string>
#include <vector>

#include "boresight/contact_events/contact_tracker.hpp"
#include "boresight/mechanism/offset_layout.hpp"

namespace boresight {

struct DampedContact {
  double rate = 0.0;   // [1/s]; 0 if nothing touches
  int clearance = -1;  // the joint with the largest share in what is damped so fast
};

DampedContact most_damped_contact(const OffsetLayout& layout, const std::vector<JointPlay>& joints,
                                  const std::vector<PlayMotion<double>>& motion,
                                  const std::vector<ContactTracker>& trackers,
                                  const Eigen::Ref<const MatX>& compliance);

// Looks now and then along a motion with fixed steps, and says where they did not follow.
class DampingWatch {
 public:
  // step [s]; limit: the method's, on the negative real axis.
  DampingWatch(const Mechanism& mechanism, double step, double limit);

  void look(double t, const OffsetLayout& layout, const std::vector<JointPlay>& joints,
            const std::vector<PlayMotion<double>>& motion, const std::vector<ContactTracker>& trackers,
            const Eigen::Ref<const MatX>& compliance);
  // Whether a contact was damped beyond the limit as a rule, not in single impacts; or one that rested, at the start of the motion or for long
  // and at two looks on end (a journal that comes to rest swings, and its damping with it): the steps then throw the journal off, and what it
  // strikes later on is damped less.
  bool beyond() const;
  // Whether it will be, whatever that many further looks find.
  bool surely_beyond(long looks_left) const;
  // Then a sentence; else empty.
  std::string warning() const;

 private:
  const Mechanism& mechanism_;
  double step_, limit_;
  int looks_ = 0, beyond_ = 0;
  bool rests_beyond_ = false, rested_ = false;  // at the last look, for long; ever
  DampedContact fastest_;
};

}  // namespace boresight
