// One joint with play, of whatever kind: all that rungs, derivatives and reports know of it.
//
//   const std::vector<JointPlay> plays = joint_plays(mechanism.description(), parameters);
//   plays[c].wrench(motion, impact_speed, wrench);
#pragma once

#include <string>
#include <vector>

#include "boresight/play/kinds.hpp"

namespace boresight {

template <typename T>
struct JointPlayT {
  PlayKinds<T> kind;
  LuGreT<T> lugre;                     // in place of the kind's friction where `sticks`
  bool sticks = false;                 // the friction has a state: wrench() with bristles
  double minimum_impact_speed = 1e-3;  // [m/s]
  double validity_speed = 0.0;         // Eq. 26 [m/s]

  // impact_speed: by ContactPlace [m/s]. M: the scalar of the motion, T itself or one that carries derivatives besides.
  // Out: PlayWrench<M>, or PlayLoad<M> where what each contact carries is not asked for.
  template <typename M, typename Out>
  void wrench(const PlayMotion<M>& motion, const ImpactSpeeds<T>& impact_speed, Out& out) const {
    std::visit([&](const auto& k) { k.wrench(motion, impact_speed, SlidingFriction<T>{k.friction}, out); }, kind);
  }
  // With LuGre's bristles, and how fast they bend.
  void wrench(const PlayMotion<T>& motion, const ImpactSpeeds<T>& impact_speed, const Bristles<T>& bristles,
              PlayWrench<T>& out, Bristles<T>& bristle_rate, const T& largest_rate) const {
    for (Vec2T<T>& rate : bristle_rate) rate.setConstant(T(0.0));
    const BristleFriction<T> friction_with_state{lugre, bristles, bristle_rate, largest_rate};
    std::visit([&](const auto& k) { k.wrench(motion, impact_speed, friction_with_state, out); }, kind);
  }
  // How deep every place is; used to see where contacts stand without their forces.
  template <typename M>
  void penetrations(const PlayMotion<M>& motion, ContactStates<M>& contact) const {
    std::visit([&](const auto& k) { k.penetrations(motion, contact); }, kind);
  }
  // What does not touch is out of reach: it gives no force, even where a trial step dips below its surface.
  void keep_only(const std::array<bool, kContactPlaces>& touching) {
    std::visit([&](auto& k) { k.keep_only(touching); }, kind);
  }
  // The numbers that parameters change, always in the same order.
  std::vector<T*> numbers() {
    return std::visit(
        [](auto& k) {
          const auto all = k.numbers();
          return std::vector<T*>(all.begin(), all.end());
        },
        kind);
  }
  // Once they were set.
  void complete() {
    std::visit([](auto& k) { k.complete(); }, kind);
  }
};

struct JointPlay : JointPlayT<double> {
  JointPlay() = default;
  JointPlay(const ClearanceDescription& description, JointType joint, const ClearanceParameters& parameters);

  // Whether there is a kind of play for this type of joint.
  static bool serves(const ClearanceDescription& description, JointType joint);
  // What the parts of such a joint's play are called. Throws std::invalid_argument where no kind serves it.
  static PlayWords words(const ClearanceDescription& description, JointType joint);
  PlayWords words() const;

  // The contacts it can have.
  std::vector<ContactPlace> places() const;
  // Which numbers of a motion its wrench hangs on.
  MotionInputs inputs() const;
  // Of all contacts [J].
  double elastic_energy(const PlayMotion<double>& motion) const;
  // The same without what dissipates and rubs.
  JointPlay elastic_only() const;
  ContactTangent tangent(const PlayMotion<double>& motion) const;
  // load: on the offsets, zero where one is none [N, N m]. before: its rest a moment ago, for the place that friction keeps.
  RestingPlay rest_under(const PlayOffsets& load, const JointCoordinates& joint, const RestingPlay& before) const;
  // The room around it, deflection under its load included.
  std::vector<GapPart> gap_parts(const RestingPlay& rest, const JointCoordinates& joint) const;
  // The gaps that limit it, and the widest and the narrowest of them [m].
  std::vector<double> clearances() const;
  double widest() const;
  double narrowest() const;
  // Of each offset, the clearance that it crosses; `other` where that is zero [m, -].
  PlayOffsets widths(double other) const;
  OffsetGroups pushed_together() const;
  double lever() const;                 // a slope times it is a displacement [m]
  double size() const;                  // radius of the seat [m]
  const NormalLaw& normal_law() const;  // of the contact that carries the loads across its axis
  double axial_stiffness() const;       // of the contact that carries them along it [N/m]; 0 where there is none
  PlayOffsets root_stiffness(
      double load) const;  // per offset, the root of the tangent stiffness under twice the load [N]
};

// A joint's play with another scalar: the same numbers, of which the caller then changes what varies.
template <typename T>
JointPlayT<T> with_scalar(JointPlay plain) {
  JointPlayT<T> play;
  play.minimum_impact_speed = plain.minimum_impact_speed;
  play.validity_speed = plain.validity_speed;
  std::visit(
      [&](auto& own) {
        auto shape = [&]<template <typename> typename Kind>(const Kind<double>& of) {
          Kind<T> other;
          other.take_shape_of(of);
          play.kind = other;
        };
        shape(own);
      },
      plain.kind);
  const std::vector<double*> from = plain.numbers();
  const std::vector<T*> to = play.numbers();
  for (std::size_t i = 0; i < to.size(); ++i) *to[i] = T(*from[i]);
  play.complete();
  return play;
}

// Of every clearance of a mechanism.
std::vector<JointPlay> joint_plays(const MechanismDescription& mechanism, const Parameters& parameters);

}  // namespace boresight
