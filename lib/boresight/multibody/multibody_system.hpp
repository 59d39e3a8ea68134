// The multibody rung's motion as an initial value problem for an Integrator: a formulation's state and right-hand side,
// the gaps of the clearance joints, and their memory, which changes at located events alone. Serves one run.
#pragma once

#include "boresight/contact_events/contact_jacobian.hpp"
#include "boresight/contact_events/located_contacts.hpp"
#include "boresight/elements/bristle_state.hpp"
#include "boresight/formulations/formulation.hpp"

namespace boresight {

// How far the bodies may move before the slow part of a Jacobian is taken anew: turns in rad, displacements over the
// mechanism's size; and so what their speeds have changed by, over the time since. It then is wrong by about this share.
inline constexpr double kSlowShare = 1e-2;

// And before what unit wrenches on the journals accelerate is, which multiplies the stiffness of the contacts.
inline constexpr double kUnitShare = 1e-3;

// Where the bodies were when a part of a Jacobian was computed.
class BodiesThen {
 public:
  void set(double t, const std::vector<BodyMotion>& bodies) {
    t_ = t;
    bodies_ = bodies;
  }
  // By how much the mechanism, of this size [m], has changed since: the larger of what kSlowShare names. Infinite before set().
  double change(double t, const std::vector<BodyMotion>& bodies, double size) const;

 private:
  double t_ = 0.0;
  std::vector<BodyMotion> bodies_;
};

class MultibodySystem {
 public:
  // trackers: one per clearance, the caller's. size: of the mechanism [m].
  MultibodySystem(Formulation& formulation, std::vector<ContactTracker>& trackers, double size);

  // The formulation's state, then those of elements: as long as this where the motion starts.
  int size() const { return formulation_.state_size() + static_cast<int>(elements_.size()); }
  const ElementStates& elements() const { return elements_; }
  // The formulation's part. The reference holds until the next call.
  const VecX& bodies_part(const VecX& y) const;

  void start(double t, const VecX& y);

  // Not a number where the formulation cannot follow (a trial step into a singular pose), nor the derivatives in jacobian(): the step is
  // then rejected.
  void derivative(double t, const VecX& y, VecX& dy) const;
  // The contacts' part exactly, from the laws' own derivatives; the rest, which is slow, by differences with the
  // contacts' wrenches held, and kept until the mechanism has moved by kSlowShare.
  void jacobian(double t, const VecX& y, MatX& J) const;
  // Where jacobian() was called last.
  void time_derivative(double t, const VecX& y, VecX& ft) const;
  long evaluations() const { return evaluations_; }  // of the right-hand side, in the two above

  int gap_count() const { return contacts_.gap_count(); }
  void gaps(double t, const VecX& y, VecX& g) const;
  AfterEvent on_event(const GapEvent& event, VecX& y);
  long events() const { return events_; }  // so far
  void stabilise(double t, VecX& y);

  // Makes sure that accelerations and forces are those of (t, y), for whoever reads them from the formulation.
  void evaluate(double t, const VecX& y);
  // Shows the trackers a state; with forces only if evaluate() was called there.
  void observe(double t, const VecX& y, bool with_forces);

  const std::vector<JointPlay>& joints() const { return joints_; }
  // Why a trial step failed last; empty if none did.
  const std::string& fault() const { return fault_; }

 private:
  struct Held;  // the contacts' wrenches, while it lives
  void remember_motion(double t, const VecX& y) const;
  void respond(double t, const VecX& y) const;
  void derivative_of_all(double t, const VecX& y, VecX& dy) const;
  void jacobian_of_all(double t, const VecX& y, MatX& J) const;
  void read(int clearance, double t, const VecX& y) const;

  Formulation& formulation_;
  std::vector<ContactTracker>& trackers_;
  std::vector<JointPlay> joints_;
  LocatedContacts contacts_;
  mutable std::vector<ContactMemory> memory_;
  ElementStates elements_;
  mutable VecX head_, head_dot_;
  mutable std::array<ContactState<double>, kContactPlaces> contact_;
  mutable double evaluated_time_ = -1.0;
  mutable VecX evaluated_, slope_;
  mutable std::string fault_;
  mutable long evaluations_ = 0;
  long events_ = 0;
  double size_;
  mutable MatX slow_;
  mutable BodiesThen slow_then_;
  mutable std::vector<BodyMotion> bodies_now_;
  mutable VecX shifted_, base_, response_;
  mutable std::vector<BodiesThen> unit_then_;
  mutable std::vector<MatX> unit_;
  mutable std::vector<Eigen::Matrix<double, kMotionNumbers, 1>> here_;
  // Per joint with a closed contact: what its wrench makes of the state's rate (size x 6), times the wrench's
  // derivatives by the journal's motion (6 x kMotionNumbers).
  mutable std::vector<MatX> of_motion_;
};

}  // namespace boresight
