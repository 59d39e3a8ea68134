// LuGre: Canudas de Wit, Olsson, Astrom, Lischinsky (1995), IEEE Transactions on Automatic Control 40, 419-425.
//
// The surfaces touch through elastic bristles of mean deflection z, a state of the contact, here a vector in its plane:
//   z' = v - s0 |v| z / g(|v|),   g = mu + (mu_s - mu) exp(-(|v| / v_st)^2)
//   F / F_n = s0 z + s1 exp(-(|v| / v_d)^2) z' + s2 v                    on the sliding body against v
// The decay of s1 is Olsson's (1996): without it a contact that begins in full sliding is kicked by s1 v.
// It sticks: at rest z holds any load up to mu_s, where the other laws creep. s0 [1/m] and s1, s2 [s/m] are per unit of
// normal force, so that the same bristles serve any load. |s0 z| never exceeds mu_s if it did not at the start.
// z relaxes at s0 |v| / g, in fast sliding faster than any step of the contact. `largest_rate` bounds it: where the bound
// holds, z follows its steady value g v / (s0 |v|) at that rate, a lag below what the step resolves.
#pragma once

#include <cmath>

#include "boresight/math/types.hpp"

namespace boresight {

template <typename T>
struct LuGreT {
  T kinetic{}, stiction{};                                // mu, mu_s [-]
  T stribeck_speed = T(1e-2);                             // v_st [m/s]
  T damping_speed = T(1e-3);                              // v_d [m/s]
  T bristle_stiffness{}, bristle_damping{}, viscosity{};  // s0 [1/m], s1, s2 [s/m]

  struct Traction {
    Vec2T<T> force;  // on the sliding body over the normal force [-]
    Vec2T<T> rate;   // of z [m/s]
  };

  // v: sliding velocity [m/s]; z: bristle deflection [m]; both in the contact's plane.
  Traction traction(const Vec2T<T>& v, const Vec2T<T>& z, const T& largest_rate) const {
    using std::exp;
    const T relaxation = slip_rate(v), decay = exp(-(v[0] * v[0] + v[1] * v[1]) / (damping_speed * damping_speed));
    Traction out;
    out.rate = select(relaxation > largest_rate, T(largest_rate / relaxation), T(1.0)) * (v - relaxation * z);
    out.force = -(bristle_stiffness * z + bristle_damping * decay * out.rate + viscosity * v);
    return out;
  }

  // How fast z relaxes [1/s].
  T slip_rate(const Vec2T<T>& v) const {
    using std::exp;
    using std::sqrt;
    const T square = v[0] * v[0] + v[1] * v[1];
    const T speed = sqrt(select(square > T(0.0), square, T(1e-60)));
    const T g = kinetic + (stiction - kinetic) * exp(-square / (stribeck_speed * stribeck_speed));
    return bristle_stiffness * speed / (g + T(1e-12));
  }
};

}  // namespace boresight
