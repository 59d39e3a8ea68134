#include "boresight_analyses/budget/window_filter.hpp"

#include <cmath>

namespace boresight {
namespace {

// 2 (1 - cos x) / x^2
double mean_of_sinusoid(double x) {
  const double half = 0.5 * x;
  const double sinc = half == 0.0 ? 1.0 : std::sin(half) / half;
  return sinc * sinc;
}

// x - 1 + exp(-x), for |x|
double doubly_integrated(double x) {
  x = std::abs(x);
  return x < 1e-3 ? x * x * (0.5 - x / 6.0 + x * x / 24.0) : x - 1.0 + std::exp(-x);
}

// Covariance of two windows' means, their beginnings `apart` (in correlation times, as the window x), over the
// variance.
double covariance_of_means(double apart, double x) {
  return (doubly_integrated(apart + x) - 2.0 * doubly_integrated(apart) + doubly_integrated(apart - x)) / (x * x);
}

}  // namespace

double kept_of_sinusoid(ErrorIndex index, double angular_frequency, const Windows& windows) {
  if (index == ErrorIndex::ape) return 1.0;
  const double mean = mean_of_sinusoid(angular_frequency * windows.window);
  if (index == ErrorIndex::mpe) return mean;
  if (index == ErrorIndex::rpe) return 1.0 - mean;
  const double sine = std::sin(0.5 * angular_frequency * windows.apart(index));
  return 4.0 * sine * sine * mean;
}

double peak_of_sinusoid(ErrorIndex index, double angular_frequency, const Windows& windows) {
  if (index != ErrorIndex::rpe) return std::sqrt(kept_of_sinusoid(index, angular_frequency, windows));
  const double end = 0.5 * angular_frequency * windows.window;
  const double s = end == 0.0 ? 1.0 : std::sin(end) / end;
  // Largest where s cos(theta) is least: at the ends of the window, half a period from its middle, or in the middle itself.
  const double least = s < 0.0 ? s : s * std::cos(std::min(end, M_PI));
  return std::sqrt(std::max(0.0, 1.0 - 2.0 * least + s * s));
}

double kept_of_noise(ErrorIndex index, double correlation_time, const Windows& windows) {
  if (index == ErrorIndex::ape) return 1.0;
  const double x = windows.window / correlation_time;
  const double mean = covariance_of_means(0.0, x);
  if (index == ErrorIndex::mpe) return mean;
  if (index == ErrorIndex::rpe) return 1.0 - mean;
  return 2.0 * (mean - covariance_of_means(windows.apart(index) / correlation_time, x));
}

}  // namespace boresight
