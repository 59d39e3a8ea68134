#include "boresight/contact/impact.hpp"

#include <algorithm>
#include <cmath>

namespace boresight {
namespace {

// Deepest penetration of an impact without dissipation: all energy elastic.
double elastic_depth(const NormalLaw& law, double energy) {
  double high = 1e-9;
  while (law.elastic_energy(high) < energy) high *= 2.0;
  double low = 0.0;
  for (int k = 0; k < 80; ++k) {
    const double middle = 0.5 * (low + high);
    (law.elastic_energy(middle) < energy ? low : high) = middle;
  }
  return high;
}

}  // namespace

Impact impact(const NormalLaw& law, double mass, double speed, int steps, std::vector<ImpactSample>* path) {
  const double scale = elastic_depth(law, 0.5 * mass * speed * speed);
  const double h = 3.0 * scale / speed / steps;
  const auto a = [&](double d, double rate) { return -law.force(d, rate, speed) / mass; };
  // Just inside: a dashpot pushes from the first instant on.
  double x = 1e-12 * scale, v = speed, x_before = 0.0, v_before = v;
  Impact result;
  long k = 0;
  for (; k < 400L * steps && !(k > 0 && x <= 0.0); ++k) {
    x_before = x, v_before = v;
    const double k1 = a(x, v), l1 = v;
    const double k2 = a(x + 0.5 * h * l1, v + 0.5 * h * k1), l2 = v + 0.5 * h * k1;
    const double k3 = a(x + 0.5 * h * l2, v + 0.5 * h * k2), l3 = v + 0.5 * h * k2;
    const double k4 = a(x + h * l3, v + h * k3), l4 = v + h * k3;
    x += h / 6.0 * (l1 + 2 * l2 + 2 * l3 + l4);
    v += h / 6.0 * (k1 + 2 * k2 + 2 * k3 + k4);
    if (path != nullptr && k % std::max(1, steps / 200) == 0 && x_before > 0.0)
      path->push_back({static_cast<double>(k) * h, x_before, law.force(x_before, v_before, speed)});
    result.depth = std::max(result.depth, x);
    result.force = std::max(result.force, law.force(x, v, speed));
  }
  const double share = x_before / (x_before - x);
  result.restitution = -(v_before + share * (v - v_before)) / speed;
  result.duration = (static_cast<double>(k) - 1.0 + share) * h;
  return result;
}

}  // namespace boresight
