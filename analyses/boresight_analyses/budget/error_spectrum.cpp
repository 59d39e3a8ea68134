#include "boresight_analyses/budget/error_spectrum.hpp"

#include <gsl/gsl_fft_real.h>

#include <bit>
#include <cmath>

namespace boresight {

ErrorSpectrum spectrum_of(const std::vector<PointingHistory>& histories, double per_decade) {
  ErrorSpectrum out;
  if (histories.empty() || histories.front().error.size() < 4) return out;
  const std::size_t samples = histories.front().error.size(), padded = std::bit_ceil(samples);
  const double spacing = histories.front().spacing;
  std::vector<double> window, power(padded / 2 + 1, 0.0);
  double squares = 0.0;
  for (std::size_t k = 0; k < samples; ++k) {
    window.push_back(0.5 *
                     (1.0 - std::cos(2.0 * M_PI * (static_cast<double>(k) + 0.5) / static_cast<double>(samples))));
    squares += window.back() * window.back();
  }
  std::vector<double> x(padded);
  for (const PointingHistory& history : histories) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& e : history.error) mean += e / static_cast<double>(samples);
    for (int axis = 0; axis < 3; ++axis) {
      std::fill(x.begin(), x.end(), 0.0);
      for (std::size_t k = 0; k < samples; ++k) x[k] = window[k] * (history.error[k][axis] - mean[axis]);
      gsl_fft_real_radix2_transform(x.data(), 1, padded);  // half complex
      for (std::size_t k = 1; k < padded / 2; ++k) power[k] += x[k] * x[k] + x[padded - k] * x[padded - k];
    }
  }
  // Bands of the padded transform that lie within the resolution of the history repeat each other; what is joined does no harm.
  const double one_sided = 2.0 * spacing / (squares * static_cast<double>(histories.size()));
  const double step = 1.0 / (spacing * static_cast<double>(padded));
  const double least = 1.0 / (spacing * static_cast<double>(samples)), ratio = std::pow(10.0, 1.0 / per_decade);
  for (std::size_t k = 1; k < padded / 2;) {
    double sum = 0.0, middle = 0.0, count = 0.0;
    const double from = static_cast<double>(k) * step;
    for (; k < padded / 2 && (count == 0.0 || static_cast<double>(k) * step < from * ratio); ++k) {
      sum += power[k];
      middle += static_cast<double>(k) * step;
      count += 1.0;
    }
    if (middle / count < least) continue;
    out.frequency.push_back(middle / count);
    out.density.push_back(one_sided * sum / count);
  }
  return out;
}

}  // namespace boresight
