#include "boresight_analyses/budget/noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "boresight_analyses/budget/quadrature.hpp"
#include "boresight_analyses/budget/window_filter.hpp"

namespace boresight {
namespace {

// |F|^2 = factor times the sum of weight cos(omega lag), where `over_square` over (omega window)^2.
struct Cosine {
  double weight, lag;
};

// 2 (1 - cos omega T) of the mean, and times 2 (1 - cos omega s) of two means s apart.
std::vector<Cosine> cosines_of_mean(double window) { return {{2.0, 0.0}, {-2.0, window}}; }

std::vector<Cosine> cosines_of_difference(double window, double apart) {
  return {{4.0, 0.0}, {-4.0, window}, {-4.0, apart}, {2.0, apart + window}, {2.0, std::abs(apart - window)}};
}

}  // namespace

Noise::Noise(PowerDensity density, std::vector<TransferFunction> through)
    : density_(std::move(density)), through_(std::move(through)), corners_(density_.corners()) {
  for (const TransferFunction& h : through_)
    for (const double corner : h.corners()) corners_.push_back(corner);
  std::sort(corners_.begin(), corners_.end());
}

std::string Noise::unbounded() const {
  double at_zero = density_.power_at_zero(), at_infinity = density_.power_at_infinity();
  for (const TransferFunction& h : through_) {
    at_zero += 2.0 * h.order_at_zero();
    at_infinity += 2.0 * h.order_at_infinity();
  }
  if (density_.least() == 0.0 && at_zero <= -1.0) return "a lower frequency, without which the variance has no bound";
  if (std::isinf(density_.most()) && at_infinity >= -1.0)
    return "an upper frequency, without which the variance has no bound";
  return "";
}

double Noise::at(double f) const {
  double s = density_.at(f);
  for (const TransferFunction& h : through_) s *= h.power(f);
  return s;
}

// The ends, the corners between them, and from one to the next in steps of at most an octave; from zero on the first is far below all
// corners.
std::vector<double> Noise::pieces(double from, double to) const {
  constexpr double kFarBelow = 1e-4;
  std::vector<double> ends = {from};
  for (const double corner : corners_)
    if (corner > from && corner < to) ends.push_back(corner);
  ends.push_back(to);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<double> out = {from};
  for (std::size_t k = 1; k < ends.size(); ++k) {
    if (out.back() == 0.0) out.push_back(kFarBelow * ends[k]);
    while (ends[k] > 2.0 * out.back()) out.push_back(2.0 * out.back());
    out.push_back(ends[k]);
  }
  return out;
}

double Noise::power(double from, double to) const {
  from = std::max(from, least());
  to = std::min(to, most());
  if (!(to > from)) return 0.0;
  if (std::isinf(to)) return power_from(from);
  const std::vector<double> ends = pieces(from, to);
  double sum = 0.0;
  for (std::size_t k = 1; k < ends.size(); ++k)
    sum += integral([this](double f) { return at(f); }, ends[k - 1], ends[k]);
  return sum;
}

double Noise::power_from(double from) const {
  if (std::isfinite(most())) return power(from, most());
  const double last = std::max({from, least(), corners_.empty() ? 0.0 : corners_.back()});
  const double end = last > 0.0 ? last : 1.0;
  return power(from, end) + integral_to_infinity([this](double f) { return at(f); }, end);
}

double Noise::variance(ErrorIndex index, const Windows& w) const {
  if (index == ErrorIndex::ape) return power_from(0.0);
  const bool relative = index == ErrorIndex::rpe;
  const double apart = w.apart(index);
  const std::vector<Cosine> cosines = apart > 0.0 ? cosines_of_difference(w.window, apart) : cosines_of_mean(w.window);
  // Below the first frequency the filter turns less than once, and is as smooth as the density; above, the cosines.
  const double turns = std::min(most(), 1.0 / (w.window + apart));
  double sum = 0.0;
  if (turns > least()) {
    const std::vector<double> ends = pieces(least(), turns);
    const Integrand kept = [&](double f) { return at(f) * kept_of_sinusoid(index, 2.0 * M_PI * f, w); };
    for (std::size_t k = 1; k < ends.size(); ++k) sum += integral(kept, ends[k - 1], ends[k]);
  }
  const double from = std::max(least(), turns);
  if (!(most() > from)) return sum;
  const Integrand over_square = [&](double f) {
    const double x = 2.0 * M_PI * f * w.window;
    return at(f) / (x * x);
  };
  // Where the cosines have turned a thousand times and S falls as a power, what they add is below 1e-9 of the mean's own part.
  constexpr double kTurns = 1e3, kBeyondCorners = 16.0;
  const double end = std::isfinite(most())
                         ? most()
                         : std::max(kTurns / std::min(w.window, apart > 0.0 ? apart : w.window),
                                    kBeyondCorners * std::max(from, corners_.empty() ? 0.0 : corners_.back()));
  const std::vector<double> ends = pieces(from, end);
  double means = 0.0;
  for (const Cosine& c : cosines) {
    for (std::size_t k = 1; k < ends.size(); ++k)
      means += c.weight * cosine_integral(over_square, 2.0 * M_PI * c.lag, ends[k - 1], ends[k]);
    if (c.lag == 0.0 && std::isinf(most())) means += c.weight * integral_to_infinity(over_square, end);
  }
  return sum + (relative ? power(from, std::numeric_limits<double>::infinity()) - means : means);
}

std::string Noise::text() const {
  std::string out = density_.text();
  for (const TransferFunction& h : through_) out += " " + h.text();
  return out;
}

}  // namespace boresight
