// The multibody rung's motion as an initial value problem for an Integrator: a formulation's state and right-hand side,
// the gaps of the clearance joints, and their memory, which changes at located events alone. Serves one run.
#pragma once

#include "boresight/rungs/contact_jacobian.hpp"
#include "boresight/rungs/formulation.hpp"
#include "boresight/rungs/located_contacts.hpp"

namespace boresight {

// How long the slow part of a Jacobian is kept [s]: that of a motion of about a second changes by about a hundredth.
inline constexpr double kSlowTime = 1e-2;

// And what unit wrenches on the journals accelerate, which multiplies the stiffness of the contacts [s].
inline constexpr double kUnitTime = 1e-3;

class MultibodySystem {
 public:
  // trackers: one per clearance, the caller's.
  MultibodySystem(Formulation& formulation, std::vector<ContactTracker>& trackers);

  void start(double t, const VecX& y);

  // Not a number where the formulation cannot follow (a trial step into a singular pose): the step is then rejected.
  void derivative(double t, const VecX& y, VecX& dy) const;
  // The contacts' part exactly, from the laws' own derivatives; the rest, which is slow, by differences with the
  // contacts' wrenches held, and kept for kSlowTime.
  void jacobian(double t, const VecX& y, MatX& J) const;
  // Where jacobian() was called last.
  void time_derivative(double t, const VecX& y, VecX& ft) const;
  long evaluations() const { return evaluations_; }  // of the right-hand side, in the two above

  int gap_count() const { return contacts_.gap_count(); }
  void gaps(double t, const VecX& y, VecX& g) const;
  AfterEvent on_event(const GapEvent& event, VecX& y);
  void settle(double t, VecX& y) { formulation_.settle(t, y); }

  // Makes sure that accelerations and forces are those of (t, y), for whoever reads them from the formulation.
  void evaluate(double t, const VecX& y);
  // Shows the trackers a state; with forces only if evaluate() was called there.
  void observe(double t, const VecX& y, bool with_forces);

  const std::vector<JournalInSleeve>& joints() const { return joints_; }
  // Why a trial step failed last; empty if none did.
  const std::string& fault() const { return fault_; }

 private:
  struct Held;  // the contacts' wrenches, while it lives
  void remember_motion(double t, const VecX& y) const;
  void respond(double t, const VecX& y) const;
  void read(int clearance, double t, const VecX& y) const;

  Formulation& formulation_;
  std::vector<ContactTracker>& trackers_;
  std::vector<JournalInSleeve> joints_;
  LocatedContacts contacts_;
  mutable std::vector<ContactMemory> memory_;
  mutable std::array<ContactState<double>, kContactPlaces> contact_;
  mutable double evaluated_time_ = -1.0;
  mutable VecX evaluated_, slope_;
  mutable std::string fault_;
  mutable long evaluations_ = 0;
  mutable MatX slow_;
  mutable double slow_time_ = -1.0;
  mutable VecX shifted_, base_, response_;
  mutable std::vector<double> unit_time_;
  mutable std::vector<MatX> unit_;
  mutable std::vector<Eigen::Matrix<double, kMotionNumbers, 1>> here_;
  // Per joint with a closed contact: what its wrench makes of the state's rate (size x 6), times the wrench's
  // derivatives by the journal's motion (6 x kMotionNumbers).
  mutable std::vector<MatX> of_motion_;
};

}  // namespace boresight
