// Random numbers of the generator: the same on every machine and standard library, for a seed is a scene.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "boresight/math/types.hpp"

namespace boresight::gauntlet {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : bits_(seed * 0x9E3779B97F4A7C15ull + 0xD1B54A32D192ED03ull) { bits_.discard(16); }

  double unit() { return static_cast<double>(bits_() >> 11) * 0x1.0p-53; }  // in [0, 1)
  double between(double low, double high) { return low + (high - low) * unit(); }
  double log_between(double low, double high) { return low * std::pow(high / low, unit()); }
  int whole(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }  // both ends included
  bool chance(double probability) { return unit() < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  template <typename T>
  const T& one_of(const std::vector<T>& values) {
    return values[static_cast<std::size_t>(whole(0, static_cast<int>(values.size()) - 1))];
  }
  Vec3 direction() {
    const double z = between(-1.0, 1.0), angle = between(0.0, 2.0 * std::numbers::pi), r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
  Mat3 rotation() { return Eigen::AngleAxisd(between(0.0, std::numbers::pi), direction()).toRotationMatrix(); }
  Vec3 inside_box(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

 private:
  std::mt19937_64 bits_;  // its output is fixed by the standard; the distributions of <random> are not
};

// Some unit vector across this one.
inline Vec3 across(const Vec3& axis) { return axis.unitOrthogonal(); }

inline Vec3 turned(const Vec3& v, const Vec3& axis, double angle) { return Eigen::AngleAxisd(angle, axis) * v; }

}  // namespace boresight::gauntlet
