// The discrete state of a clearance joint's contacts: which touch, how fast each began, and, where friction has a state, how
// far its bristles are bent.
//
// It belongs to the state of the motion and changes only between accepted steps; a right-hand side reads it and never
// writes it, so a rejected step leaves no trace.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "boresight/math/types.hpp"

namespace boresight {

// Where in a clearance joint a contact lies. radial_minus/plus: at the sleeve's ends (free axes only). Sleeve frame: y along
// the joint's axis; plus is the end at +y.
enum class ContactPlace : std::uint8_t { radial, radial_minus, radial_plus, axial_minus, axial_plus };
inline constexpr int kContactPlaces = 5;

// "radial", "radial-", "radial+", "axial-", "axial+"
inline const char* to_string(ContactPlace place) {
  constexpr const char* names[] = {"radial", "radial-", "radial+", "axial-", "axial+"};
  return names[static_cast<int>(place)];
}

// Whether a place limits the motion along the joint's axis, and not across it.
inline bool is_axial(ContactPlace place) { return place >= ContactPlace::axial_minus; }

struct ContactMemory {
  std::array<bool, kContactPlaces> touching{};
  // Approach speed at the start of the contact; while not touching, the speed to use should a contact begin inside the
  // coming step. Always positive [m/s].
  std::array<double, kContactPlaces> impact_speed{1e-3, 1e-3, 1e-3, 1e-3, 1e-3};
  // LuGre's z [m], in the contact's plane. A continuous state: the integrator carries it and writes it here for each stage.
  std::array<Eigen::Vector2d, kContactPlaces> bristle = [] {
    std::array<Eigen::Vector2d, kContactPlaces> none;
    none.fill(Eigen::Vector2d::Zero());
    return none;
  }();
  // Bristles relax no faster than the step resolves [1/s].
  double largest_bristle_rate = std::numeric_limits<double>::infinity();
};

}  // namespace boresight
