// Many smooth functions of time at once on a uniform grid, interpolated by the polynomial of degree seven through the eight values around.
//
// Where a TimeTable's cubics are good to 2e-6 of a function, these are good to 1e-9 on the same grid: the error falls with the eighth
// power of the spacing. They cost more than twice as much and their slope has steps at the knots, so they serve where digits decide: a load
// that passes through next to nothing is the difference of large ones, and its direction is all that a journal at rest goes by.
// Source: Berrut and Trefethen (2004), Barycentric Lagrange Interpolation, SIAM Review 46, Eq. 4.2, with the weights of Eq. 5.1.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace boresight {

class EightPointTable {
 public:
  static constexpr int kPoints = 8;

  EightPointTable() = default;
  // values: knots x width, row after row, at t = 0, spacing, ...; at least eight knots.
  EightPointTable(double spacing, int width, std::vector<double> values)
      : spacing_(spacing),
        width_(width),
        knots_(static_cast<int>(values.size()) / std::max(width, 1)),
        values_(std::move(values)) {}

  int width() const { return width_; }
  int knots() const { return knots_; }
  double spacing() const { return spacing_; }

  // out: `width` values at t; one-sided near the ends.
  void at(double t, double* out) const {
    const double x = t / spacing_;
    const int first = std::clamp(static_cast<int>(x) - (kPoints / 2 - 1), 0, knots_ - kPoints);
    const std::array<double, kPoints> w = weights(x - first);
    std::fill_n(out, width_, 0.0);
    for (int i = 0; i < kPoints; ++i) {
      const double* from = &values_[static_cast<std::size_t>(first + i) * width_];
      for (int j = 0; j < width_; ++j) out[j] += w[i] * from[j];
    }
  }

 private:
  // Of the eight values, for the place x from the first of them, in spacings.
  static std::array<double, kPoints> weights(double x) {
    static constexpr std::array<double, kPoints> kBarycentric = {-1.0, 7.0, -21.0, 35.0, -35.0, 21.0, -7.0, 1.0};
    std::array<double, kPoints> w{};
    const double nearest = std::round(x);
    if (std::abs(x - nearest) < 1e-12 && nearest >= 0.0 && nearest < kPoints) {
      w[static_cast<std::size_t>(nearest)] = 1.0;
      return w;
    }
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i) sum += w[i] = kBarycentric[i] / (x - i);
    for (double& weight : w) weight /= sum;
    return w;
  }

  double spacing_ = 1.0;
  int width_ = 0, knots_ = 0;
  std::vector<double> values_;
};

}  // namespace boresight
