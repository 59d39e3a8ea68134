// Maximum, mean and mean square of the index |G z + x| over time, one sample a lane; x: what standing errors add.
//
// A step gives the value at its middle (z by the cubic through both ends' z and zdot) and at its end; the integrals are
// Simpson's, the maximum that of the parabola through three values. What comes before a start is left out: of a step across it
// the part behind it counts, on that parabola.
#pragma once

#include "boresight/lanes/lane_numbers.hpp"
#include "boresight/math/lanes.hpp"

namespace boresight {

template <typename T>
struct LaneStatistics {
  T value{0.0};  // at the last accepted time
  T max{0.0}, time_of_max{0.0}, integral{0.0}, square{0.0};

  // The index at the start of the motion.
  template <typename Mask>
  void begin(const Mask& lanes, const T& at_start, bool counts) {
    value = select(lanes, at_start, value);
    if (counts) max = select(lanes, at_start, max);
  }

  // As add(), from `start` on.
  template <typename Mask>
  void add_from(const T& start, const Mask& accepted, const T& t, const T& h, const T& middle, const T& end) {
    const T before = larger(T(0.0), smaller(T(1.0), (start - t) / h));  // share of the step
    const Mask across = accepted & (before > T(0.0));
    const T slope = T(4.0) * middle - T(3.0) * value - end, bend = T(2.0) * (value + end - T(2.0) * middle);
    const auto at = [&](const T& s) { return value + s * (slope + s * bend); };
    const T rest = T(1.0) - before;
    value = select(across, at(before), value);
    // Where it only falls from there on, its value at `start` is the largest.
    const Mask first = across & (before < T(1.0)) & (value > max);
    max = select(first, value, max);
    time_of_max = select(first, t + before * h, time_of_max);
    const T middle_of_rest = select(across, at(before + T(0.5) * rest), middle);
    add(accepted & (before < T(1.0)), t + before * h, rest * h, middle_of_rest, end);
    value = select(accepted, end, value);
  }

  template <typename Mask>
  void add(const Mask& accepted, const T& t, const T& h, const T& middle, const T& end) {
    const T sixth = h * T(1.0 / 6.0);
    integral = select(accepted, integral + sixth * (value + T(4.0) * middle + end), integral);
    square = select(accepted, square + sixth * (value * value + T(4.0) * middle * middle + end * end), square);
    // Peak of the parabola, where it lies inside the step.
    const T slope = end - value, bend = T(2.0) * middle - value - end;  // bend > 0: it has a peak
    const T divisor = select(bend > T(0.0), bend, T(1.0));
    const T shift = T(0.25) * slope / divisor;  // from the middle, in steps
    const Mask inside = (bend > T(0.0)) & (abs(shift) < T(0.5));
    const T peak = select(inside, middle + T(0.5) * slope * shift, larger(middle, end));
    const T peak_time = t + h * select(inside, T(0.5) + shift, select(middle > end, T(0.5), T(1.0)));
    const Mask higher = accepted & (peak > max);
    max = select(higher, peak, max);
    time_of_max = select(higher, peak_time, time_of_max);
    value = select(accepted, end, value);
  }
};

// What the index is taken of at one time: the coordinates, and what standing errors add (three numbers).
template <typename T>
struct IndexPlace {
  const T* z;
  const T* standing;
};

// |G z + standing| for G = gain, 3 x n row by row.
template <typename T>
T index_value(int n, const T* gain, const T* z, const T* standing) {
  T square(0.0);
  for (int i = 0; i < 3; ++i) {
    T x = standing[i];
    for (int j = 0; j < n; ++j) x = fused(gain[i * n + j], z[j], x);
    square = fused(x, x, square);
  }
  return sqrt(square);
}

}  // namespace boresight
