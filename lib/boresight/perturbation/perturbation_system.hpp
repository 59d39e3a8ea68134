// The perturbation rung's motion as an initial value problem: y = (z, zdot), its right-hand side, its Jacobian, its
// gaps and the memory of its contacts. The equations themselves are in offset_dynamics.hpp.
//
// Two ways to go: accept() after every step that did not stop at contact, or start_located() and then the events of an
// Integrator. Serves one run: holds work space.
#pragma once

#include <memory>

#include "boresight/contact_events/located_contacts.hpp"
#include "boresight/elements/bristle_state.hpp"
#include "boresight/scene/clearance_scene.hpp"

namespace boresight {

class PerturbationSystem {
 public:
  PerturbationSystem(const Mechanism& mechanism, const Parameters& parameters,
                     std::shared_ptr<const SceneTables> tables, bool keep_events, double start = 0.0);

  // Coordinates and rates as motions start with them, no bristle bent; shifted by `offset` for neighbours.
  // warning: as start_coordinates().
  VecX start_state(const Mechanism& mechanism, double offset, std::string& warning) const;

  // States of elements, if any, follow z and zdot.
  int size() const { return 2 * tables_->layout.n + static_cast<int>(elements_.size()); }
  const ElementStates& elements() const { return elements_; }
  // Of the fixed steps to come [s]: elements relax no faster than they resolve. Not called where steps follow an error estimate.
  void set_step(double h) { step_ = h; }
  void derivative(double t, const VecX& y, VecX& dy) const;
  void jacobian(double t, const VecX& y, MatX& J) const;

  void accept(double t, VecX& y);

  void start_located(double t, const VecX& y);
  int gap_count() const { return contacts_.gap_count(); }
  void gaps(double t, const VecX& y, VecX& g) const;
  AfterEvent on_event(const GapEvent& event, VecX& y);
  // Shows the trackers a state; after derivative() there.
  void observe(double t);

  // The scene's functions of time at the time last asked for.
  const double* row() const { return row_.data(); }
  const SceneTables& tables() const { return *tables_; }
  const SceneLayout& layout() const { return tables_->layout; }
  const std::vector<JointPlay>& joints() const { return joints_; }
  std::vector<ContactTracker>& trackers() { return trackers_; }
  bool touching() const;
  // Of the last derivative().
  const std::vector<PlayMotion<double>>& motion() const { return motion_; }
  const std::vector<PlayWrench<double>>& wrench() const { return wrench_; }

 private:
  PerturbationSystem(const PerturbationSystem&) = delete;  // contacts_ knows where trackers_ are
  void scene_at(double t) const;

  std::shared_ptr<const SceneTables> tables_;
  std::vector<JointPlay> joints_;
  std::vector<ContactTracker> trackers_;
  ElementStates elements_;
  double step_ = 0.0;
  LocatedContacts contacts_;
  bool located_ = false;
  mutable std::vector<PlayMotion<double>> motion_;
  mutable std::vector<PlayWrench<double>> wrench_;
  mutable std::vector<ContactMemory> memory_;  // where elements keep what they took
  mutable std::vector<Bristles<double>> bristle_rate_;
  mutable std::vector<double> row_;
  mutable double row_time_ = -1.0;
  mutable VecX force_;
  mutable std::array<ContactState<double>, kContactPlaces> contact_;
  mutable MatX gain_, virtual_gain_, force_gradient_, inverse_mass_;
};

}  // namespace boresight
