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
// the joint's axis; plus is the end at +y. width, height: the faces of a rectangular guide, at -x +x -z +z; of a slider that may tilt the
// edges at its ends on them, first of the end at -y (rear), then of that at +y (front). axial_minus_left_rear and so on: the corners of a
// rectangular pad on the faces of its slot, left and right at either end of its width, rear and front of its length.
enum class ContactPlace : std::uint8_t {
  radial,
  radial_minus,
  radial_plus,
  axial_minus,
  axial_plus,
  width_minus,
  width_plus,
  height_minus,
  height_plus,
  width_minus_rear,
  width_plus_rear,
  height_minus_rear,
  height_plus_rear,
  width_minus_front,
  width_plus_front,
  height_minus_front,
  height_plus_front,
  axial_minus_left_rear,
  axial_minus_right_rear,
  axial_minus_left_front,
  axial_minus_right_front,
  axial_plus_left_rear,
  axial_plus_right_rear,
  axial_plus_left_front,
  axial_plus_right_front
};
inline constexpr int kContactPlaces = 25;

// "radial", "radial-", "radial+", "axial-", "axial+", "width-", ...
inline const char* to_string(ContactPlace place) {
  constexpr const char* names[kContactPlaces] = {"radial",
                                                 "radial-",
                                                 "radial+",
                                                 "axial-",
                                                 "axial+",
                                                 "width-",
                                                 "width+",
                                                 "height-",
                                                 "height+",
                                                 "width- rear",
                                                 "width+ rear",
                                                 "height- rear",
                                                 "height+ rear",
                                                 "width- front",
                                                 "width+ front",
                                                 "height- front",
                                                 "height+ front",
                                                 "axial- left rear",
                                                 "axial- right rear",
                                                 "axial- left front",
                                                 "axial- right front",
                                                 "axial+ left rear",
                                                 "axial+ right rear",
                                                 "axial+ left front",
                                                 "axial+ right front"};
  return names[static_cast<int>(place)];
}

// Whether a place limits the motion along the joint's axis, and not across it.
inline bool is_axial(ContactPlace place) {
  return place == ContactPlace::axial_minus || place == ContactPlace::axial_plus ||
         (place >= ContactPlace::axial_minus_left_rear && place <= ContactPlace::axial_plus_right_front);
}

struct ContactMemory {
  std::array<bool, kContactPlaces> touching{};
  // Approach speed at the start of the contact; while not touching, the speed to use should a contact begin inside the
  // coming step. Always positive [m/s].
  std::array<double, kContactPlaces> impact_speed = [] {
    std::array<double, kContactPlaces> slow;
    slow.fill(1e-3);
    return slow;
  }();
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
