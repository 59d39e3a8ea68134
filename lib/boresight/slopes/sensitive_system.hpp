// y and W columns of its sensitivity as one initial value problem for the Integrator; see
// sensitive_motion.hpp.
//
// State: y (2n), then S row by row: the W derivatives of y_0, of y_1, ... Contacts, gaps and memory are those
// of PerturbationSystem; here they gain derivatives.
#pragma once

#include <ceres/jet.h>

#include "boresight/perturbation/perturbation_system.hpp"
#include "boresight/scene/offset_dynamics.hpp"
#include "boresight/slopes/sensitive_motion.hpp"

namespace boresight {

template <int W>
class SensitiveSystem {
 public:
  using Jet = ceres::Jet<double, W>;

  // first: the first of the W directions; those from `parameters` on are components of the start state.
  SensitiveSystem(const Mechanism& mechanism, const Parameters& parameters, std::shared_ptr<const SceneTables> tables,
                  const ContactNumbers& numbers, int first, const std::vector<TablesBeside>& beside)
      : tables_(std::move(tables)),
        plain_(mechanism, parameters, tables_, false),
        row_(tables_->dynamics.width()),
        y_(plain_.size()),
        slope_(plain_.size()),
        states_(plain_.size()),
        force_(tables_->layout.n),
        acceleration_(tables_->layout.n) {
    for (std::size_t c = 0; c < numbers.joints.size(); ++c) {
      joints_.push_back(joint_with_derivatives(numbers, c, first));
      Jet least(numbers.joints[c].minimum_impact_speed);
      for (int d = 0; d < W && first + d < static_cast<int>(numbers.by.size()); ++d)
        least.v[d] = numbers.least_speed_by[first + d][c];
      least_speed_.push_back(least);
      ImpactSpeeds<Jet> speed;
      speed.fill(least);
      impact_speed_.push_back(speed);
      for (ContactPlace place : numbers.joints[c].places()) gaps_.push_back({static_cast<int>(c), place});
    }
    for (const TablesBeside& one : beside)
      if (one.parameter >= first && one.parameter < first + W) {
        beside_.push_back(one);
        beside_.back().parameter -= first;
      }
    if (beside_.empty()) return;
    less_ = more_ = row_;
    slope_of_row_.resize(beside_.size(), row_);
    force_value_ = added_ = VecX::Zero(tables_->layout.n);
  }

  int size() const { return plain_.size() * (1 + W); }

  void derivative(double t, const VecX& Y, VecX& dY) const {
    const SceneLayout& at = tables_->layout;
    scene_at(t);
    load(Y);
    std::fill(force_.begin(), force_.end(), Jet(0.0));
    PlayWrench<Jet> wrench;
    for (std::size_t c = 0; c < joints_.size(); ++c) {
      const auto& touching = memory(c).touching;
      if (!touches(touching)) continue;
      const PlayMotion<Jet> motion = play_motion(at, at.joints[c], row_.data(), states_.data(), states_.data() + at.n);
      acting(c, touching).wrench(motion, impact_speed_[c], wrench);
      add_generalised_force(at, at.joints[c], row_.data(), motion, wrench, force_.data());
    }
    coordinate_acceleration(at, row_.data(), states_.data(), states_.data() + at.n, force_.data(),
                            acceleration_.data());
    add_slopes_of_tables(Y);
    const int size = plain_.size();
    for (int i = 0; i < at.n; ++i) {
      dY[i] = Y[at.n + i];
      dY[at.n + i] = acceleration_[i].a;
      dY.segment<W>(size + W * i) = Y.segment<W>(size + W * (at.n + i));
      dY.segment<W>(size + W * (at.n + i)) = acceleration_[i].v;
    }
  }

  // Of y' by y.
  void state_jacobian(double t, const VecX& Y, MatX& J) const {
    J.resize(plain_.size(), plain_.size());
    plain_.jacobian(t, Y.head(plain_.size()), J);
  }

  void start_located(double t, const VecX& Y) {
    y_ = Y.head(plain_.size());
    plain_.start_located(t, y_);
    scene_at(t);
    load(Y);
    for (std::size_t g = 0; g < gaps_.size(); ++g)
      if (memory(gaps_[g].clearance).touching[static_cast<int>(gaps_[g].place)]) latch(gaps_[g], nullptr);
  }
  int gap_count() const { return plain_.gap_count(); }
  void gaps(double t, const VecX& Y, VecX& g) const {
    y_ = Y.head(plain_.size());
    plain_.gaps(t, y_, g);
  }

  AfterEvent on_event(const GapEvent& event, VecX& Y) {
    const Gap& gap = gaps_[event.gap];
    const bool begins = event.crossing == Crossing::closing || event.crossing == Crossing::lasting;
    y_ = Y.head(plain_.size());
    plain_.derivative(event.t, y_, slope_);
    const VecX slope_before = slope_;
    plain_.on_event(event, y_);
    scene_at(event.t);
    load(Y);
    if (begins) latch(gap, &event.t);
    plain_.derivative(event.t, y_, slope_);
    jump(gap, slope_before - slope_, Y);
    return AfterEvent::crossed;
  }

  std::vector<double> approach_speed;  // of every contact begun at an event [m/s]
  std::vector<double> approach_time;
  std::vector<int> approach_joint;

 private:
  struct Gap {
    int clearance;
    ContactPlace place;
  };

  JointPlayT<Jet> joint_with_derivatives(const ContactNumbers& numbers, std::size_t c, int first) const {
    JointPlayT<Jet> joint = with_scalar<Jet>(numbers.joints[c]);
    const std::vector<Jet*> to = joint.numbers();
    for (std::size_t i = 0; i < to.size(); ++i)
      for (int d = 0; d < W && first + d < static_cast<int>(numbers.by.size()); ++d)
        to[i]->v[d] = numbers.by[first + d][c][i];
    joint.complete();
    return joint;
  }

  const ContactMemory& memory(std::size_t c) const {
    return const_cast<PerturbationSystem&>(plain_).trackers()[c].memory();
  }
  static bool touches(const std::array<bool, kContactPlaces>& touching) {
    return std::any_of(touching.begin(), touching.end(), [](bool b) { return b; });
  }
  // As LocatedContacts.
  JointPlayT<Jet> acting(std::size_t c, const std::array<bool, kContactPlaces>& touching) const {
    JointPlayT<Jet> joint = joints_[c];
    joint.keep_only(touching);
    return joint;
  }

  void scene_at(double t) const {
    if (t == row_time_) return;
    tables_->at(t, row_.data());
    for (std::size_t b = 0; b < beside_.size(); ++b) {
      beside_[b].less->at(t, less_.data());
      beside_[b].more->at(t, more_.data());
      // Masses do not move the joints.
      for (int k = 0; k < tables_->layout.joints_at; ++k)
        slope_of_row_[b][k] = (more_[k] - less_[k]) / beside_[b].apart;
    }
    row_time_ = t;
  }
  // The acceleration is linear in the row: what the row's slope gives is the acceleration's.
  void add_slopes_of_tables(const VecX& Y) const {
    const SceneLayout& at = tables_->layout;
    for (std::size_t b = 0; b < beside_.size(); ++b) {
      for (int i = 0; i < at.n; ++i) force_value_[i] = force_[i].a;
      coordinate_acceleration(at, slope_of_row_[b].data(), Y.data(), Y.data() + at.n, force_value_.data(),
                              added_.data());
      for (int i = 0; i < at.n; ++i) acceleration_[i].v[beside_[b].parameter] += added_[i];
    }
  }
  void load(const VecX& Y) const {
    const int size = plain_.size();
    for (int i = 0; i < size; ++i) {
      states_[i].a = Y[i];
      states_[i].v = Y.segment<W>(size + W * i);
    }
  }

  // dm/dq of the header; event_time null: at the start of the motion, whose time no quantity changes.
  void latch(const Gap& gap, const double* event_time) {
    const SceneLayout& at = tables_->layout;
    const int c = gap.clearance, place = static_cast<int>(gap.place);
    std::array<ContactState<Jet>, kContactPlaces> contact;
    joints_[c].penetrations(play_motion(at, at.joints[c], row_.data(), states_.data(), states_.data() + at.n), contact);
    const ContactState<Jet>& here = contact[place];
    Jet& speed = impact_speed_[c][place];
    speed = Jet(memory(c).impact_speed[place]);
    const bool latched = here.rate.a > joints_[c].minimum_impact_speed;
    speed.v = latched ? here.rate.v : least_speed_[c].v;
    if (latched && event_time) speed.v -= rate_of_rate(gap, *event_time) / here.rate.a * here.penetration.v;
    if (!event_time) return;
    approach_speed.push_back(here.rate.a);
    approach_time.push_back(*event_time);
    approach_joint.push_back(c);
  }

  // S+ - S- of the header, from f- - f+. An event without a rate grazes: there it has no derivative.
  void jump(const Gap& gap, const VecX& difference, VecX& Y) const {
    const SceneLayout& at = tables_->layout;
    const int c = gap.clearance, place = static_cast<int>(gap.place);
    std::array<ContactState<Jet>, kContactPlaces> contact;
    joints_[c].penetrations(play_motion(at, at.joints[c], row_.data(), states_.data(), states_.data() + at.n), contact);
    const double rate = contact[place].rate.a;
    if (std::abs(rate) < joints_[c].minimum_impact_speed) return;
    // Without a dashpot the difference is the rounding of the event's time.
    if (!(plain_.joints()[c].normal_law().dashpot > 0.0)) return;
    for (int i = 0; i < plain_.size(); ++i)
      Y.template segment<W>(plain_.size() + W * i) -= difference[i] / rate * contact[place].penetration.v;
  }

  // r_t + r_y f: along the motion, by a central difference of the geometry alone over 0.2 us, in which no gap
  // of engineering size bends (relative error 1e-8).
  double rate_of_rate(const Gap& gap, double t) const {
    constexpr double kShort = 1e-7;  // [s]
    const SceneLayout& at = tables_->layout;
    std::vector<double> row(row_.size());
    std::array<ContactState<double>, kContactPlaces> contact;
    double rate[2];
    for (int side = 0; side < 2; ++side) {
      const double dt = side == 0 ? kShort : -kShort;
      tables_->at(t + dt, row.data());
      const VecX y = y_ + dt * slope_;
      plain_.joints()[gap.clearance].penetrations(
          play_motion(at, at.joints[gap.clearance], row.data(), y.data(), y.data() + at.n), contact);
      rate[side] = contact[static_cast<int>(gap.place)].rate;
    }
    return (rate[0] - rate[1]) / (2.0 * kShort);
  }

  std::shared_ptr<const SceneTables> tables_;
  PerturbationSystem plain_;
  std::vector<JointPlayT<Jet>> joints_;
  std::vector<Jet> least_speed_;  // that a contact is damped by
  std::vector<ImpactSpeeds<Jet>> impact_speed_;
  std::vector<Gap> gaps_;
  mutable std::vector<double> row_;
  mutable double row_time_ = -1.0;
  mutable VecX y_;
  VecX slope_;
  mutable std::vector<Jet> states_, force_, acceleration_;
  std::vector<TablesBeside> beside_;  // parameter: among the W
  mutable std::vector<double> less_, more_;
  mutable std::vector<std::vector<double>> slope_of_row_;  // of each beside
  mutable VecX force_value_, added_;
};

}  // namespace boresight
