// What each lane's standing errors add to the index: x(t) = error_gain(t) G(t) eps, three numbers, at the lane's own time.
//
// The errors of a sample are contracted once, before it begins (perturbation_lanes.cpp): 3 products a knot and error, 30,000 for forty errors
// on 250 knots, some 10 us. From then on their number costs nothing. An attempt reads two knots at its middle and two at its end, 128 bytes
// each (a scene's row takes 4 cubics of 32 columns, 512 bytes in single precision), and takes 3 cubics of some 12 operations at
// either: a hundred operations beside the thousands of a step. A sample keeps 64 bytes a knot, 16 kB.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>

#include "boresight/lanes/lane_batch.hpp"
#include "boresight/lanes/lane_numbers.hpp"

namespace boresight {

template <typename T>
class LaneStandingErrors {
 public:
  static constexpr int W = T::kWidth;

  LaneStandingErrors() { of_.fill(LaneStanding{}); }
  void set(int lane, const LaneStanding& standing) {
    of_[lane] = standing;
    any_ = any_ || standing.knots != nullptr;
  }

  // x: three numbers, each lane's at its own t; zero where a lane has no errors.
  void at(const double* t, T* x) const {
    if (!any_) {
      for (int i = 0; i < 3; ++i) x[i] = T(0.0);
      return;
    }
    std::array<std::array<Number, W>, 3> lanes{};
    for (int l = 0; l < W; ++l) {
      const LaneStanding& s = of_[l];
      if (s.knots == nullptr) continue;
      const double place = t[l] * s.per_spacing;
      const int k = std::clamp(static_cast<int>(place), 0, s.cells - 1);
      const double share = place - k, *from = s.knots + std::size_t{8} * static_cast<std::size_t>(k), *to = from + 8;
      for (int i = 0; i < 3; ++i) {
        const double f0 = from[i], d0 = from[4 + i], rise = to[i] - f0, d1 = to[4 + i];
        const double square = 3.0 * rise - 2.0 * d0 - d1, cube = d0 + d1 - 2.0 * rise;
        lanes[i][l] = static_cast<Number>(f0 + share * (d0 + share * (square + share * cube)));
      }
    }
    for (int i = 0; i < 3; ++i) std::memcpy(&x[i].v, lanes[i].data(), sizeof x[i].v);
  }

 private:
  using Number = typename T::Number;
  std::array<LaneStanding, W> of_;
  bool any_ = false;
};

}  // namespace boresight
