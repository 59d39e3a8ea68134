#include "boresight/perturbation/perturbation_system.hpp"

#include <algorithm>

#include "boresight/contact_events/contact_jacobian.hpp"
#include "boresight/integrate/partial_derivatives.hpp"
#include "boresight/scene/motion_gain.hpp"
#include "boresight/scene/offset_dynamics.hpp"
#include "boresight/scene/resting_start.hpp"

namespace boresight {
namespace {

constexpr int kFirstSlope = 9;  // of the numbers of a motion

std::vector<ContactTracker> trackers_of(const Mechanism& mechanism, const std::vector<JointPlay>& joints,
                                        bool keep_events, double start) {
  std::vector<ContactTracker> trackers;
  const MechanismDescription& m = mechanism.description();
  for (int c = 0; c < mechanism.clearances(); ++c)
    trackers.emplace_back(c, m.joints[m.clearances[c].joint].name, joints[c], keep_events, start);
  return trackers;
}

}  // namespace

PerturbationSystem::PerturbationSystem(const Mechanism& mechanism, const Parameters& parameters,
                                       std::shared_ptr<const SceneTables> tables, bool keep_events, double start)
    : tables_(std::move(tables)),
      joints_(joint_plays(mechanism.description(), parameters)),
      trackers_(trackers_of(mechanism, joints_, keep_events, start)),
      contacts_(joints_, trackers_),
      motion_(joints_.size()),
      wrench_(joints_.size()),
      memory_(joints_.size()),
      bristle_rate_(joints_.size()),
      row_(tables_->dynamics.width()),
      force_(VecX::Zero(tables_->layout.n)),
      gain_(kMotionNumbers, 2 * tables_->layout.n),
      virtual_gain_(6, tables_->layout.n),
      force_gradient_(tables_->layout.n, 2 * tables_->layout.n) {
  elements_.add(std::make_unique<BristleState>(joints_, memory_, [this](int c) -> const Bristles<double>& {
    return bristle_rate_[static_cast<std::size_t>(c)];
  }));
}

VecX PerturbationSystem::start_state(const Mechanism& mechanism, double offset, std::string& warning) const {
  VecX y = VecX::Zero(size());
  y.head(2 * tables_->layout.n) = start_coordinates(mechanism, tables_->layout, tables_->start, joints_, warning);
  y.head(tables_->layout.n).array() += offset;
  return y;
}

bool PerturbationSystem::touching() const {
  return std::any_of(trackers_.begin(), trackers_.end(), [](const ContactTracker& c) { return c.touching(); });
}

// Two stages of a step share their time, and so do a step's end and the next one's start.
void PerturbationSystem::scene_at(double t) const {
  if (t == row_time_) return;
  tables_->at(t, row_.data());
  row_time_ = t;
}

void PerturbationSystem::derivative(double t, const VecX& y, VecX& dy) const {
  scene_at(t);
  const SceneLayout& at = tables_->layout;
  const double *z = y.data(), *rate = z + at.n;
  elements_.take(y.tail(elements_.size()), step_);
  force_.setZero();
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    motion_[c] = play_motion(at, at.joints[c], row_.data(), z, rate);
    const bool free = located_ && !contacts_.touches(static_cast<int>(c));
    if (free) {
      joints_[c].penetrations(motion_[c], wrench_[c].contact);
      for (Vec2T<double>& bending : bristle_rate_[c]) bending.setZero();
      continue;
    }
    const JointPlay& law = located_ ? contacts_.acting(static_cast<int>(c)) : joints_[c];
    if (law.sticks)
      law.wrench(motion_[c], trackers_[c].memory().impact_speed, memory_[c].bristle, wrench_[c], bristle_rate_[c],
                 memory_[c].largest_bristle_rate);
    else
      law.wrench(motion_[c], trackers_[c].memory().impact_speed, wrench_[c]);
    add_generalised_force(at, at.joints[c], row_.data(), motion_[c], wrench_[c], force_.data());
  }
  std::copy(rate, rate + at.n, dy.data());
  coordinate_acceleration(at, row_.data(), z, rate, force_.data(), dy.data() + at.n);
  elements_.rates(dy.tail(elements_.size()));
}

void PerturbationSystem::jacobian(double t, const VecX& y, MatX& J) const {
  if (!elements_.empty()) {  // the laws' own derivatives know nothing of what elements remember
    VecX base(y.size()), shifted, slope(y.size());
    derivative(t, y, base);
    return jacobian_by_differences(*this, t, y, base, shifted, slope, J);
  }
  scene_at(t);
  const SceneLayout& at = tables_->layout;
  const int n = at.n;
  const double* scene = row_.data();
  force_gradient_.setZero();
  ContactJacobian of_motion;
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    if (located_ && !contacts_.touches(static_cast<int>(c))) continue;
    const SceneLayout::Joint& joint = at.joints[c];
    const PlayMotion<double> motion = play_motion(at, joint, scene, y.data(), y.data() + n);
    const JointPlay& law = located_ ? contacts_.acting(static_cast<int>(c)) : joints_[c];
    contact_jacobian(law, motion, trackers_[c].memory().impact_speed, MomentAbout::insert, of_motion);
    if (joint.tilts) {  // moment_along_insert()
      PlayWrench<double> wrench;
      law.wrench(motion, trackers_[c].memory().impact_speed, wrench);
      of_motion.row(4) += motion.slope[0] * of_motion.row(3) + motion.slope[1] * of_motion.row(5);
      of_motion.row(4).segment<2>(kFirstSlope) +=
          Eigen::RowVector2d(moment_about_insert(motion, wrench, 0), moment_about_insert(motion, wrench, 2));
    }
    motion_gain(at, joint, scene, gain_);
    // A wrench works on e_dot and w: it acts on the coordinates as these follow their rates.
    virtual_gain_.topRows<3>() = gain_.block(3, n, 3, n);
    virtual_gain_.bottomRows<3>() = gain_.block(6, n, 3, n);
    force_gradient_.noalias() += virtual_gain_.transpose() * (of_motion * gain_);
  }
  using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  J.setZero();
  J.topRightCorner(n, n).setIdentity();
  at.inverse_mass(scene, inverse_mass_);
  J.bottomRows(n).noalias() = inverse_mass_ * force_gradient_;
  J.bottomRightCorner(n, n) -= Rows(scene + at.AC, n, n);
  if (at.stiff) J.bottomLeftCorner(n, n) -= Rows(scene + at.AK, n, n);
}

void PerturbationSystem::accept(double t, VecX& y) {
  scene_at(t);
  const SceneLayout& at = tables_->layout;
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    motion_[c] = play_motion(at, at.joints[c], row_.data(), y.data(), y.data() + at.n);
    joints_[c].penetrations(motion_[c], contact_);
    trackers_[c].accept(t, contact_);
    memory_[c].touching = trackers_[c].memory().touching;
  }
  elements_.accept(y.tail(elements_.size()));
}

void PerturbationSystem::start_located(double t, const VecX& y) {
  located_ = true;
  scene_at(t);
  const SceneLayout& at = tables_->layout;
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    joints_[c].penetrations(play_motion(at, at.joints[c], row_.data(), y.data(), y.data() + at.n), contact_);
    contacts_.start(static_cast<int>(c), t, contact_);
    memory_[c].touching = trackers_[c].memory().touching;
  }
}

void PerturbationSystem::gaps(double t, const VecX& y, VecX& g) const {
  scene_at(t);
  const SceneLayout& at = tables_->layout;
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    joints_[c].penetrations(play_motion(at, at.joints[c], row_.data(), y.data(), y.data() + at.n), contact_);
    contacts_.read(static_cast<int>(c), contact_, g);
  }
}

AfterEvent PerturbationSystem::on_event(const GapEvent& event, VecX& y) {
  scene_at(event.t);
  const SceneLayout& at = tables_->layout;
  const int c = contacts_.joint_of(event);
  joints_[c].penetrations(play_motion(at, at.joints[c], row_.data(), y.data(), y.data() + at.n), contact_);
  contacts_.change(event, contact_);
  memory_[c].touching = trackers_[c].memory().touching;
  elements_.accept(y.tail(elements_.size()));
  return AfterEvent::crossed;
}

void PerturbationSystem::observe(double t) {
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    joints_[c].penetrations(motion_[c], contact_);
    trackers_[c].observe(t, contact_);
    // The law that acts may not see the contacts that are open.
    for (int k = 0; k < kContactPlaces; ++k) {
      wrench_[c].contact[k].penetration = contact_[k].penetration;
      wrench_[c].contact[k].rate = contact_[k].rate;
    }
    trackers_[c].observe_forces(wrench_[c]);
  }
}

}  // namespace boresight
