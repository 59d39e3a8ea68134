// Piecewise quintic Hermite interpolation, on a uniform grid or between any knots: value, rate and acceleration are met exactly
// at every knot, so the curve is twice continuously differentiable and its error between knots is h^6 |f^(6)| / 46080.
// Source: de Boor (1978), A Practical Guide to Splines, chapter IV (osculatory interpolation).
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "boresight/math/time_function.hpp"

namespace boresight {

// Several functions of time at once; `width` numbers per knot.
class QuinticSpline {
 public:
  QuinticSpline() = default;
  // value, rate, acceleration: knots x width, row after row, at t = start, start + spacing, ...
  QuinticSpline(double start, double spacing, int width, const std::vector<double>& value,
                const std::vector<double>& rate, const std::vector<double>& acceleration)
      : start_(start), spacing_(spacing), width_(width) {
    fit(value, rate, acceleration);
  }
  // The same at the times `knots`, in increasing order.
  QuinticSpline(std::vector<double> knots, int width, const std::vector<double>& value, const std::vector<double>& rate,
                const std::vector<double>& acceleration)
      : width_(width), knots_(std::move(knots)) {
    fit(value, rate, acceleration);
  }

  int width() const { return width_; }
  bool empty() const { return coefficients_.empty(); }

  // Outside the grid the end pieces go on. out: `width` values.
  void at(double t, TimeValue* out) const { at(t, 0, width_, out); }
  TimeValue at(double t, int component) const {
    TimeValue result;
    at(t, component, 1, &result);
    return result;
  }
  void at(double t, int first, int count, TimeValue* out) const {
    double s, per_h;
    int k;
    if (knots_.empty()) {
      const double x = (t - start_) / spacing_;
      k = std::clamp(static_cast<int>(std::floor(x)), 0, intervals_ - 1);
      s = x - k, per_h = 1.0 / spacing_;
    } else {
      const auto after = std::upper_bound(knots_.begin(), knots_.end(), t);
      k = std::clamp(static_cast<int>(after - knots_.begin()) - 1, 0, intervals_ - 1);
      per_h = 1.0 / (knots_[k + 1] - knots_[k]);
      s = (t - knots_[k]) * per_h;
    }
    const double* c = &coefficients_[(static_cast<std::size_t>(k) * width_ + first) * 6];
    for (int j = 0; j < count; ++j, c += 6) {
      out[j].value = c[0] + s * (c[1] + s * (c[2] + s * (c[3] + s * (c[4] + s * c[5]))));
      out[j].rate = per_h * (c[1] + s * (2.0 * c[2] + s * (3.0 * c[3] + s * (4.0 * c[4] + s * 5.0 * c[5]))));
      out[j].acceleration = per_h * per_h * (2.0 * c[2] + s * (6.0 * c[3] + s * (12.0 * c[4] + s * 20.0 * c[5])));
    }
  }

 private:
  void fit(const std::vector<double>& value, const std::vector<double>& rate, const std::vector<double>& acceleration) {
    const int width = width_, knots = static_cast<int>(value.size()) / width;
    intervals_ = knots - 1;
    coefficients_.resize(static_cast<std::size_t>(intervals_) * width * 6);
    for (int k = 0; k < intervals_; ++k) {
      const double h = knots_.empty() ? spacing_ : knots_[k + 1] - knots_[k];
      for (int j = 0; j < width; ++j) {
        const std::size_t a = static_cast<std::size_t>(k) * width + j, b = a + width;
        const double f0 = value[a], d0 = h * rate[a], s0 = 0.5 * h * h * acceleration[a];
        const double rest = value[b] - f0 - d0 - s0;
        const double drest = h * rate[b] - d0 - 2.0 * s0;
        const double srest = 0.5 * h * h * acceleration[b] - s0;
        double* c = &coefficients_[a * 6];
        c[0] = f0;
        c[1] = d0;
        c[2] = s0;
        c[3] = 10.0 * rest - 4.0 * drest + srest;
        c[4] = -15.0 * rest + 7.0 * drest - 2.0 * srest;
        c[5] = 6.0 * rest - 3.0 * drest + srest;
      }
    }
  }

  double start_ = 0.0, spacing_ = 1.0;
  int width_ = 0, intervals_ = 0;
  std::vector<double> knots_;         // empty: uniform
  std::vector<double> coefficients_;  // [interval][component][power of (t - knot) / spacing]
};

}  // namespace boresight
