// Functions of time that each lane's sample has for itself, at the lane's own time: what its standing errors add to the index,
// x(t) = error_gain(t) G(t) eps, and to the loads on the coordinates, dr(t).
//
// The errors of a sample are contracted once, before it begins (perturbation_lanes.cpp): 3 + n products a knot and error, some 50,000 for forty
// errors, some 20 us. From then on their number costs nothing. An attempt reads two knots at its middle and two at its end for the index, two
// at its end for the loads, and takes cubics of some 12 operations: a hundred or two beside the thousands of a step. A sample keeps 48
// and 16 n bytes a knot.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#include "boresight/lanes/lane_batch.hpp"
#include "boresight/lanes/lane_numbers.hpp"

namespace boresight {

template <typename T>
class LaneOwnCourses {
 public:
  static constexpr int W = T::kWidth;

  explicit LaneOwnCourses(int count) : count_(count), lanes_(static_cast<std::size_t>(count) * W) {
    of_.fill(LaneCourses{});
  }
  void set(int lane, const LaneCourses& courses) {
    of_[lane] = courses;
    any_ = any_ || courses.knots != nullptr;
  }
  // Whether any lane has had any.
  bool any() const { return any_; }

  // x: the functions, each lane's at its own t; zero where a lane has none.
  void at(const double* t, T* x) {
    if (!any_) {
      for (int i = 0; i < count_; ++i) x[i] = T(0.0);
      return;
    }
    for (int l = 0; l < W; ++l)
      one(l, t[l], [&](int i, double value) { lanes_[at(i, l)] = static_cast<Number>(value); });
    for (int i = 0; i < count_; ++i) std::memcpy(&x[i].v, &lanes_[at(i, 0)], sizeof x[i].v);
  }
  // One lane's, added to numbers side by side.
  template <typename Real>
  void add(int lane, double t, Real* to) const {
    if (of_[lane].knots != nullptr) one(lane, t, [&](int i, double value) { to[i] += static_cast<Real>(value); });
  }

 private:
  using Number = typename T::Number;

  std::size_t at(int i, int lane) const { return static_cast<std::size_t>(i) * W + static_cast<std::size_t>(lane); }

  template <typename Take>
  void one(int l, double t, const Take& take) const {
    const LaneCourses& s = of_[l];
    if (s.knots == nullptr) {
      for (int i = 0; i < count_; ++i) take(i, 0.0);
      return;
    }
    const double place = t * s.per_spacing;
    const int k = std::clamp(static_cast<int>(place), 0, s.cells - 1);
    const std::size_t width = 2 * static_cast<std::size_t>(count_);
    const double share = place - k, *from = s.knots + width * static_cast<std::size_t>(k), *to = from + width;
    for (int i = 0; i < count_; ++i) {
      const double f0 = from[i], d0 = from[count_ + i], rise = to[i] - f0, d1 = to[count_ + i];
      const double square = 3.0 * rise - 2.0 * d0 - d1, cube = d0 + d1 - 2.0 * rise;
      take(i, f0 + share * (d0 + share * (square + share * cube)));
    }
  }

  int count_;
  std::array<LaneCourses, W> of_;
  std::vector<Number> lanes_;
  bool any_ = false;
};

}  // namespace boresight
