// Brown, McPhee (2016), Journal of Computational and Nonlinear Dynamics 11: one smooth line with a static peak at v_d,
//   F / F_n = mu tanh(4 v / v_d) + (mu_s - mu) (v / v_d) / ((v / (2 v_d))^2 + 3/4)^2
// At v = v_d: 0.99933 mu + (mu_s - mu). Their viscous term is left out: a journal's oil film is another model.
#pragma once

#include <cmath>

#include "boresight/math/scalar.hpp"

namespace boresight {

// Friction force over normal force [-]. speed >= 0.
template <typename T>
T brown_mcphee(const T& speed, const T& kinetic, const T& stiction, const T& transition_speed) {
  using std::tanh;
  const T x = speed / transition_speed;
  const T base = T(0.25) * x * x + T(0.75);
  return kinetic * tanh(T(4.0) * x) + (stiction - kinetic) * x / (base * base);
}

}  // namespace boresight
