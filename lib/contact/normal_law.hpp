// Normal contact: Hertz stiffness with dissipation, F = K d^(3/2) (1 + h ddot / ddot0), never below zero.
//
// K [N/m^1.5], d penetration [m], ddot its rate, ddot0 > 0 the approach speed at the start of this contact (a discrete
// state, latched by an event; see contact_memory.hpp), h the law's damping factor, a function of the restitution alone.
// All laws of the Hunt-Crossley family share this line and differ in h only. F is clamped at zero: no suction.
#pragma once

#include <string>
#include <vector>

#include "boresight/math/scalar.hpp"

namespace boresight {

// T: a sample's numbers may be lanes or jets.
template <typename T>
struct NormalLawT {
  T stiffness{};       // K [N/m^1.5]
  T damping_factor{};  // h [-]

  // Zero where penetration <= 0. M: the scalar of the motion, T itself or one that carries derivatives besides.
  template <typename M>
  M force(const M& penetration, const M& rate, const T& impact_speed) const {
    using std::sqrt;
    // The root is taken of a positive number in every lane: at d = 0 its derivative would be infinite.
    const M depth = select(penetration > T(0.0), penetration, M(1.0));
    const M elastic = stiffness * depth * sqrt(depth);
    const M whole = elastic * (T(1.0) + damping_factor * rate / impact_speed);
    return select(penetration > T(0.0), positive_part(whole), M(0.0));
  }
};
using NormalLaw = NormalLawT<double>;

// A law of the family, by its name in mechanism files.
struct NormalLawEntry {
  const char* name;
  const char* source;
  double (*damping_factor)(double restitution);
  double lowest_restitution;  // exclusive: the factor grows without bound towards it; -1: takes zero too
};

const std::vector<NormalLawEntry>& normal_laws();
// Throws std::invalid_argument for an unknown name.
const NormalLawEntry& normal_law(const std::string& name);

}  // namespace boresight
