// What a contact's friction is asked: where, under what normal force, sliding how; it answers with the force in the contact's
// plane. One shape for laws that are functions of the sliding speed and for LuGre, whose bristles have a state.
#pragma once

#include <array>
#include <utility>

#include "boresight/contact/contact_memory.hpp"
#include "boresight/contact/friction_law.hpp"
#include "boresight/contact/lugre.hpp"

namespace boresight {

template <typename T>
struct SlidingFriction {
  const FrictionLawT<T>& law;

  // place: a ContactPlace; a, b: sliding velocity in the contact's plane [m/s]. Returns the force [N]. M: the motion's scalar.
  template <typename M>
  std::pair<M, M> operator()(int, const M& normal_force, const M& a, const M& b) const {
    const M pull = normal_force * law.force_per_velocity(length_from_square(M(a * a + b * b)));
    return {-pull * a, -pull * b};
  }
};

// Bristle deflections, or their rates, by ContactPlace.
template <typename T>
using Bristles = std::array<Vec2T<T>, kContactPlaces>;

template <typename T>
struct BristleFriction {
  const LuGreT<T>& law;
  const Bristles<T>& bristles;
  Bristles<T>& rate;
  const T& largest_rate;

  std::pair<T, T> operator()(int place, const T& normal_force, const T& a, const T& b) const {
    const auto traction = law.traction(Vec2T<T>(a, b), bristles[place], largest_rate);
    rate[place] = traction.rate;
    return {normal_force * traction.force[0], normal_force * traction.force[1]};
  }
};

}  // namespace boresight
