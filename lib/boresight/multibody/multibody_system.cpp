#include "boresight/multibody/multibody_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/integrate/partial_derivatives.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

std::vector<JointPlay> joints_of(const ForceElements& forces) {
  std::vector<JointPlay> joints;
  for (int c = 0; c < forces.clearances(); ++c) joints.push_back(forces.joint(c));
  return joints;
}

// Of differences, in turns, slides and their speeds: what they differentiate is smooth.
constexpr double kIncrement = 1e-7;

}  // namespace

struct MultibodySystem::Held {
  explicit Held(ForceElements& of) : forces(of) { forces.hold_contact(true); }
  ~Held() { forces.hold_contact(false); }
  ForceElements& forces;
};

double BodiesThen::change(double t, const std::vector<BodyMotion>& bodies, double size) const {
  if (bodies_.empty()) return std::numeric_limits<double>::infinity();
  double moved = 0.0, sped = 0.0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyMotion &now = bodies[b], &then = bodies_[b];
    // For a small turn the difference of two rotations is the turn itself.
    moved = std::max({moved, (now.R - then.R).cwiseAbs().maxCoeff(), (now.p - then.p).cwiseAbs().maxCoeff() / size});
    sped = std::max({sped, (now.w - then.w).cwiseAbs().maxCoeff(), (now.v - then.v).cwiseAbs().maxCoeff() / size});
  }
  return std::max(moved, sped * std::abs(t - t_));
}

MultibodySystem::MultibodySystem(Formulation& formulation, std::vector<ContactTracker>& trackers, double size)
    : formulation_(formulation),
      trackers_(trackers),
      joints_(joints_of(formulation.forces())),
      contacts_(joints_, trackers_),
      memory_(trackers.size()),
      slope_(VecX::Zero(formulation.state_size())),
      size_(size),
      slow_(formulation.state_size(), formulation.state_size()),
      shifted_(slope_),
      base_(slope_),
      response_(slope_),
      unit_then_(trackers.size()),
      unit_(trackers.size(), MatX::Zero(formulation.state_size(), 6)),
      here_(trackers.size()),
      of_motion_(trackers.size(), MatX::Zero(formulation.state_size(), kMotionNumbers)) {
  elements_.add(std::make_unique<BristleState>(
      joints_, memory_, [this](int c) -> const Bristles<double>& { return formulation_.forces().bristle_rate(c); }));
  head_dot_ = VecX::Zero(formulation.state_size());
}

const VecX& MultibodySystem::bodies_part(const VecX& y) const {
  if (elements_.empty()) return y;
  head_ = y.head(formulation_.state_size());
  return head_;
}

void MultibodySystem::read(int clearance, double t, const VecX& y) const {
  const std::vector<BodyMotion>& bodies = formulation_.bodies(t, bodies_part(y));
  joints_[clearance].penetrations(formulation_.forces().play_motion(clearance, bodies), contact_);
}

void MultibodySystem::stabilise(double t, VecX& y) {
  if (elements_.empty()) return formulation_.stabilise(t, y);
  bodies_part(y);
  formulation_.stabilise(t, head_);
  y.head(head_.size()) = head_;
}

void MultibodySystem::start(double t, const VecX& y) {
  for (int c = 0; c < static_cast<int>(joints_.size()); ++c) {
    read(c, t, y);
    contacts_.start(c, t, contact_);
    memory_[c] = trackers_[c].memory();
    formulation_.forces().act(c, contacts_.acting(c));
  }
}

void MultibodySystem::derivative_of_all(double t, const VecX& y, VecX& dy) const {
  if (elements_.empty()) return formulation_.derivative(t, y, memory_, dy);
  elements_.take(y.tail(elements_.size()), 0.0);
  formulation_.derivative(t, bodies_part(y), memory_, head_dot_);
  dy.head(head_dot_.size()) = head_dot_;
  elements_.rates(dy.tail(elements_.size()));
}

void MultibodySystem::derivative(double t, const VecX& y, VecX& dy) const {
  try {
    derivative_of_all(t, y, dy);
    evaluated_time_ = t;
    evaluated_ = y;
  } catch (const ComputationError& failure) {
    fault_ = failure.what();
    dy.setConstant(std::numeric_limits<double>::quiet_NaN());
    evaluated_time_ = -1.0;
  }
}

// Fills base_ (the rate at (t, y)) and of_motion_.
void MultibodySystem::respond(double t, const VecX& y) const {
  ForceElements& forces = formulation_.forces();
  derivative(t, y, base_);
  ++evaluations_;
  evaluated_time_ = -1.0;  // what follows leaves the formulation elsewhere
  const Held held(forces);
  bodies_now_ = formulation_.bodies(t, y);
  ContactJacobian law;
  for (int c = 0; c < static_cast<int>(joints_.size()); ++c) {
    if (!contacts_.touches(c)) continue;
    const PlayMotion<double> motion = forces.motion(c);
    contact_jacobian(contacts_.acting(c), motion, memory_[c].impact_speed, MomentAbout::seat, law);
    const PlayWrench<double> wrench = forces.contact(c);
    if (unit_then_[c].change(t, bodies_now_, size_) <= kUnitShare) {
      of_motion_[c].noalias() = unit_[c] * law;
      continue;
    }
    unit_then_[c].set(t, bodies_now_);
    // Linear in the wrench: a difference of any size is exact. One as large as the wrench itself loses no digits.
    const double size = std::max(1.0, wrench.force.norm());
    for (int k = 0; k < 6; ++k) {
      const Vec3 axis = Vec3::Unit(k % 3) * size;
      PlayWrench<double>& changed = forces.contact(c);
      (k < 3 ? changed.force : changed.moment) += axis;
      formulation_.derivative(t, y, memory_, response_);
      unit_[c].col(k) = (response_ - base_) / size;
      changed = wrench;
    }
    evaluations_ += 6;
    of_motion_[c].noalias() = unit_[c] * law;
  }
}

void MultibodySystem::remember_motion(double t, const VecX& y) const {
  const std::vector<BodyMotion>& bodies = formulation_.bodies(t, y);
  for (int c = 0; c < static_cast<int>(joints_.size()); ++c)
    here_[c] = numbers(formulation_.forces().play_motion(c, bodies));
}

void MultibodySystem::jacobian(double t, const VecX& y, MatX& J) const {
  try {
    jacobian_of_all(t, y, J);
  } catch (const ComputationError& failure) {
    fault_ = failure.what();
    J.setConstant(std::numeric_limits<double>::quiet_NaN());
    evaluated_time_ = -1.0;
    slow_then_ = {};  // what is kept may be half of here
    unit_then_.assign(unit_then_.size(), {});
  }
}

void MultibodySystem::jacobian_of_all(double t, const VecX& y, MatX& J) const {
  if (!elements_.empty()) {  // the laws' own derivatives know nothing of what elements remember
    VecX shifted, slope(y.size());
    base_.resize(y.size());
    derivative(t, y, base_);
    evaluations_ += y.size() + 1;
    return jacobian_by_differences(*this, t, y, base_, shifted, slope, J);
  }
  ForceElements& forces = formulation_.forces();
  respond(t, y);
  const int size = static_cast<int>(y.size());
  bodies_now_ = formulation_.bodies(t, y);
  if (!(slow_then_.change(t, bodies_now_, size_) <= kSlowShare)) {
    const Held held(forces);
    for (int k = 0; k < size; ++k) {
      shifted_ = y;
      shifted_[k] += kIncrement;
      formulation_.derivative(t, shifted_, memory_, response_);
      slow_.col(k) = (response_ - base_) / (shifted_[k] - y[k]);
    }
    evaluations_ += size;
    slow_then_.set(t, bodies_now_);
  }
  J = slow_;
  remember_motion(t, y);
  const bool touching =
      std::any_of(trackers_.begin(), trackers_.end(), [](const ContactTracker& c) { return c.touching(); });
  for (int k = 0; k < size && touching; ++k) {
    shifted_ = y;
    shifted_[k] += kIncrement;
    const std::vector<BodyMotion>& moved = formulation_.bodies(t, shifted_);
    for (int c = 0; c < static_cast<int>(joints_.size()); ++c)
      if (contacts_.touches(c))
        J.col(k).noalias() +=
            of_motion_[c] * ((numbers(forces.play_motion(c, moved)) - here_[c]) / (shifted_[k] - y[k]));
  }
}

void MultibodySystem::time_derivative(double t, const VecX& y, VecX& ft) const {
  if (!elements_.empty()) {
    const double after = t + difference_increment(t);
    VecX slope(y.size());
    derivative(after, y, slope);
    ++evaluations_;
    ft = (slope - base_) / (after - t);
    return;
  }
  ForceElements& forces = formulation_.forces();
  remember_motion(t, y);
  const double later = t + kIncrement;
  {
    const Held held(forces);
    formulation_.derivative(later, y, memory_, response_);
    ++evaluations_;
  }
  ft = (response_ - base_) / (later - t);
  const std::vector<BodyMotion>& bodies = formulation_.bodies(later, y);
  for (int c = 0; c < static_cast<int>(joints_.size()); ++c)
    if (contacts_.touches(c))
      ft.noalias() += of_motion_[c] * ((numbers(forces.play_motion(c, bodies)) - here_[c]) / (later - t));
}

void MultibodySystem::gaps(double t, const VecX& y, VecX& g) const {
  for (int c = 0; c < static_cast<int>(joints_.size()); ++c) {
    read(c, t, y);
    contacts_.read(c, contact_, g);
  }
}

AfterEvent MultibodySystem::on_event(const GapEvent& event, VecX& y) {
  ++events_;
  const int c = contacts_.joint_of(event);
  read(c, event.t, y);
  contacts_.change(event, contact_);
  memory_[c] = trackers_[c].memory();
  elements_.accept(y.tail(elements_.size()));
  formulation_.forces().act(c, contacts_.acting(c));
  return AfterEvent::crossed;
}

void MultibodySystem::evaluate(double t, const VecX& y) {
  if (t == evaluated_time_ && y == evaluated_) return;
  slope_.resize(y.size());
  derivative(t, y, slope_);
}

void MultibodySystem::observe(double t, const VecX& y, bool with_forces) {
  for (int c = 0; c < static_cast<int>(joints_.size()); ++c) {
    read(c, t, y);
    trackers_[c].observe(t, contact_);
    memory_[c] = trackers_[c].memory();
    if (!with_forces) continue;
    // The law that acts may not see the contacts that are open.
    PlayWrench<double>& wrench = formulation_.forces().contact(c);
    for (int k = 0; k < kContactPlaces; ++k) {
      wrench.contact[k].penetration = contact_[k].penetration;
      wrench.contact[k].rate = contact_[k].rate;
    }
    trackers_[c].observe_forces(wrench);
  }
}

}  // namespace boresight
