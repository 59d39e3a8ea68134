// Many smooth functions of time at once, tabulated on a uniform grid and interpolated by cubics.
//
// Each cell's cubic meets the values at its ends and slopes taken from the neighbouring values by fourth-order differences,
// so the curve is once continuously differentiable and its error falls with the fourth power of the spacing. The
// coefficients of all functions in a cell lie side by side: one evaluation is three multiply-adds a function over
// contiguous memory, which the compiler turns into vector instructions.
// Source: de Boor (1978), A Practical Guide to Splines, chapter IV.
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace boresight {

class TimeTable {
 public:
  TimeTable() = default;
  // values: knots x width, row after row, at t = 0, spacing, ...; at least five knots.
  TimeTable(double spacing, int width, const std::vector<double>& values) : spacing_(spacing), width_(width) {
    const int knots = static_cast<int>(values.size()) / width;
    cells_ = knots - 1;
    const auto at = [&](int k, int j) { return values[static_cast<std::size_t>(k) * width + j]; };
    const auto slope = [&](int k, int j) { return slope_at_knot(k, knots, [&](int i) { return at(i, j); }); };
    coefficients_.resize(static_cast<std::size_t>(cells_) * 4 * width);
    for (int k = 0; k < cells_; ++k) {
      double* c = &coefficients_[static_cast<std::size_t>(k) * 4 * width];
      for (int j = 0; j < width; ++j) {
        const double f0 = at(k, j), f1 = at(k + 1, j), d0 = slope(k, j), d1 = slope(k + 1, j);
        c[j] = f0;
        c[width + j] = d0;
        c[2 * width + j] = 3.0 * (f1 - f0) - 2.0 * d0 - d1;
        c[3 * width + j] = 2.0 * (f0 - f1) + d0 + d1;
      }
    }
  }

  // Slope times spacing at knot k of `knots`, from the values at(i) there: central where there are neighbours, one-sided of the same
  // order at the ends. at() may give numbers or arrays of them.
  template <typename At, typename Value = std::remove_cvref_t<std::invoke_result_t<At, int>>>
  static Value slope_at_knot(int k, int knots, const At& at) {
    if (k >= 2 && k <= knots - 3) return Value((at(k - 2) - 8.0 * at(k - 1) + 8.0 * at(k + 1) - at(k + 2)) / 12.0);
    const int first = k < 2 ? 0 : knots - 5, i = k - first;
    static constexpr double weights[5][5] = {
        {-25, 48, -36, 16, -3}, {-3, -10, 18, -6, 1}, {1, -8, 0, 8, -1}, {-1, 6, -18, 10, 3}, {3, -16, 36, -48, 25}};
    Value sum = weights[i][0] * at(first);
    for (int n = 1; n < 5; ++n) sum += weights[i][n] * at(first + n);
    return Value(sum / 12.0);
  }

  int width() const { return width_; }
  double spacing() const { return spacing_; }
  int cells() const { return cells_; }
  // Of one cell: the factors of s^0, s^1, s^2, s^3 with s from 0 to 1 across the cell, `width` numbers each.
  const double* cell(int k) const { return &coefficients_[static_cast<std::size_t>(k) * 4 * width_]; }

  // The sums over blocks of weights.size() functions that lie side by side, each times its weight: as many functions as there are blocks.
  TimeTable contracted(const std::vector<double>& weights) const {
    TimeTable sums;
    sums.spacing_ = spacing_;
    sums.cells_ = cells_;
    const std::size_t block = weights.size();
    sums.width_ = static_cast<int>(width_ / block);
    sums.coefficients_.assign(static_cast<std::size_t>(cells_) * 4 * sums.width_, 0.0);
    const double* from = coefficients_.data();
    for (double& sum : sums.coefficients_) {
      for (std::size_t e = 0; e < block; ++e) sum += weights[e] * from[e];
      from += block;
    }
    return sums;
  }

  // The functions from `first` on become those of another table on the same grid.
  void replace(int first, const TimeTable& by) {
    for (int k = 0; k < cells_; ++k)
      for (int power = 0; power < 4; ++power)
        std::copy_n(by.cell(k) + static_cast<std::size_t>(power) * by.width_, by.width_,
                    &coefficients_[(static_cast<std::size_t>(k) * 4 + power) * width_ + first]);
  }

  // out: `width` rates of change at t.
  void slopes(double t, double* out) const {
    const double x = t / spacing_;
    const int k = std::clamp(static_cast<int>(x), 0, cells_ - 1);
    const double s = x - k, *c = cell(k) + width_;
    for (int j = 0; j < width_; ++j)
      out[j] = (c[j] + s * (2.0 * c[width_ + j] + s * 3.0 * c[2 * width_ + j])) / spacing_;
  }

  // out: `width` values at t.
  void at(double t, double* out) const {
    const double* c;
    const double s = share_of_cell(t, c);
    const double *c1 = c + width_, *c2 = c1 + width_, *c3 = c2 + width_;
    for (int j = 0; j < width_; ++j) out[j] = c[j] + s * (c1[j] + s * (c2[j] + s * c3[j]));
  }
  // The same added to what there is.
  void add(double t, double* out) const {
    const double* c;
    const double s = share_of_cell(t, c);
    const double *c1 = c + width_, *c2 = c1 + width_, *c3 = c2 + width_;
    for (int j = 0; j < width_; ++j) out[j] += c[j] + s * (c1[j] + s * (c2[j] + s * c3[j]));
  }

 private:
  double share_of_cell(double t, const double*& coefficients) const {
    const double x = t / spacing_;
    const int k = std::clamp(static_cast<int>(x), 0, cells_ - 1);
    coefficients = cell(k);
    return x - k;
  }

  double spacing_ = 1.0;
  int width_ = 0, cells_ = 0;
  std::vector<double> coefficients_;  // [cell][power][function]
};

}  // namespace boresight
