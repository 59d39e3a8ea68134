#include "boresight_analyses/budget/noise_course.hpp"

#include <gsl/gsl_fft_halfcomplex.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "boresight_analyses/budget/quadrature.hpp"

namespace boresight {
namespace {

constexpr std::size_t kHistories = 4;     // in a period of the grid, at least
constexpr std::size_t kFirstOfGrid = 4;   // sinusoid of the grid, below which narrower bands stand
constexpr double kSlowest = 1.0 / 200.0;  // periods in a history, below which a sinusoid is constant
constexpr double kWidthOfSlow = 1.1;      // upper over lower end of a narrow band
constexpr std::size_t kFolds = 4;         // of half the sampling's frequency, known band by band; above them evenly

// Power and root mean square frequency between two frequencies.
struct Band {
  double power, frequency;
};

Band band_of(const Noise& noise, double from, double to) {
  const double power = noise.power(from, to);
  if (power <= 0.0) return {0.0, from};
  const double low = std::max(from, noise.least()), high = std::min(to, noise.most());
  const double squares = integral([&](double f) { return f * f * noise.at(f); }, low, high);
  return {power, std::sqrt(squares / power)};
}

}  // namespace

NoiseCourse::NoiseCourse(const Noise& noise, double spacing, std::size_t samples)
    : spacing_(spacing), samples_(samples) {
  const std::size_t period = std::bit_ceil(kHistories * std::max<std::size_t>(samples, 2 * kFirstOfGrid));
  const std::size_t half = period / 2;
  const double step = 1.0 / (static_cast<double>(period) * spacing);
  const double grid_from = (static_cast<double>(kFirstOfGrid) - 0.5) * step;
  const double slowest = std::min(kSlowest / (static_cast<double>(samples) * spacing), grid_from);

  slow_.push_back({0.0, std::sqrt(noise.power(0.0, slowest))});
  for (double from = slowest; from < grid_from;) {
    double to = from * kWidthOfSlow;
    if (to * std::sqrt(kWidthOfSlow) > grid_from) to = grid_from;
    const Band band = band_of(noise, from, to);
    slow_.push_back({band.frequency, std::sqrt(band.power)});
    from = to;
  }

  std::vector<double> power(half + 1, 0.0);
  const double sampling = static_cast<double>(half) * step;  // half the frequency of sampling
  const auto folded = [&](std::size_t k) {                   // band k of all frequencies onto the grid
    const std::size_t within = k % period;
    return within <= half ? within : period - within;
  };
  const std::size_t last = kFolds * half;
  for (std::size_t k = kFirstOfGrid; k <= last; ++k) {
    const double middle = static_cast<double>(k) * step;
    if (middle - 0.5 * step > noise.most()) break;
    power[folded(k)] += noise.power(middle - 0.5 * step, middle + 0.5 * step);
  }
  const double end = (static_cast<double>(last) + 0.5) * step,
               beyond = noise.most() > end ? noise.power_from(end) : 0.0;
  for (std::size_t k = 0; k <= half; ++k)
    power[k] += beyond * (k == 0 || k == half ? 0.5 : 1.0) / static_cast<double>(half);
  for (const double p : power) deviation_.push_back(std::sqrt(p));
  const double all = variance();
  above_sampling_ = all > 0.0 && noise.most() > sampling ? noise.power_from(sampling) / all : 0.0;
}

double NoiseCourse::variance() const {
  double sum = 0.0;
  for (const Slow& s : slow_) sum += s.deviation * s.deviation;
  for (const double d : deviation_) sum += d * d;
  return sum;
}

std::vector<double> NoiseCourse::drawn(const Normals& normal) const {
  const std::size_t half = deviation_.size() - 1, period = 2 * half;
  std::vector<double> grid(period, 0.0);  // half complex: real parts from the front, imaginary ones from the back
  for (std::size_t k = 0; k <= half; ++k) {
    if (deviation_[k] == 0.0) continue;
    const std::complex<double> z = normal(slow_.size() + k);
    if (k == 0 || k == half) {
      grid[k] = deviation_[k] * z.real();
      continue;
    }
    grid[k] = 0.5 * deviation_[k] * z.real();
    grid[period - k] = 0.5 * deviation_[k] * z.imag();
  }
  gsl_fft_halfcomplex_radix2_backward(grid.data(), 1, period);
  grid.resize(samples_);
  for (std::size_t s = 0; s < slow_.size(); ++s) {
    if (slow_[s].deviation == 0.0) continue;
    const std::complex<double> turn = std::polar(1.0, 2.0 * M_PI * slow_[s].frequency * spacing_);
    // Of the constant the real part alone.
    std::complex<double> z = slow_[s].deviation * normal(s);
    for (double& e : grid) {
      e += z.real();
      z *= turn;
    }
  }
  return grid;
}

}  // namespace boresight
