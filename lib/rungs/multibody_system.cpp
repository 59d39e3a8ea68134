#include "boresight/rungs/multibody_system.hpp"

#include <limits>

#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

std::vector<JournalInSleeve> joints_of(const ForceElements& forces) {
  std::vector<JournalInSleeve> joints;
  for (int c = 0; c < forces.clearances(); ++c) joints.push_back(forces.joint(c));
  return joints;
}

}  // namespace

MultibodySystem::MultibodySystem(Formulation& formulation, std::vector<ContactTracker>& trackers)
    : formulation_(formulation),
      trackers_(trackers),
      joints_(joints_of(formulation.forces())),
      contacts_(joints_, trackers_),
      memory_(trackers.size()),
      slope_(VecX::Zero(formulation.state_size())) {}

void MultibodySystem::read(int clearance, double t, const VecX& y) const {
  joints_[clearance].gaps(formulation_.forces().journal_motion(clearance, formulation_.bodies(t, y)), contact_);
}

void MultibodySystem::start(double t, const VecX& y) {
  for (int c = 0; c < static_cast<int>(joints_.size()); ++c) {
    read(c, t, y);
    contacts_.start(c, t, contact_);
    memory_[c] = trackers_[c].memory();
    formulation_.forces().act(c, contacts_.acting(c));
  }
}

void MultibodySystem::derivative(double t, const VecX& y, VecX& dy) const {
  try {
    formulation_.derivative(t, y, memory_, dy);
    evaluated_time_ = t;
    evaluated_ = y;
  } catch (const ComputationError& failure) {
    fault_ = failure.what();
    dy.setConstant(std::numeric_limits<double>::quiet_NaN());
    evaluated_time_ = -1.0;
  }
}

void MultibodySystem::gaps(double t, const VecX& y, VecX& g) const {
  for (int c = 0; c < static_cast<int>(joints_.size()); ++c) {
    read(c, t, y);
    contacts_.read(c, contact_, g);
  }
}

AfterEvent MultibodySystem::on_event(const GapEvent& event, VecX& y) {
  const int c = contacts_.joint_of(event);
  read(c, event.t, y);
  contacts_.change(event, contact_);
  memory_[c] = trackers_[c].memory();
  formulation_.forces().act(c, contacts_.acting(c));
  return AfterEvent::crossed;
}

void MultibodySystem::evaluate(double t, const VecX& y) {
  if (t == evaluated_time_ && y == evaluated_) return;
  derivative(t, y, slope_);
}

void MultibodySystem::observe(double t, const VecX& y, bool with_forces) {
  for (int c = 0; c < static_cast<int>(joints_.size()); ++c) {
    read(c, t, y);
    trackers_[c].observe(t, contact_);
    if (with_forces) trackers_[c].observe_forces(formulation_.forces().contact(c).contact);
  }
}

}  // namespace boresight
