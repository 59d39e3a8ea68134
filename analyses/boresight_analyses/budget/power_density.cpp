#include "boresight_analyses/budget/power_density.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace boresight {

double PowerDensity::at(double f) const {
  if (f < least() || f > most()) return 0.0;
  if (frequency.empty()) {
    const double turned = 2.0 * M_PI * f * correlation_time;
    return white + (flicker > 0.0 ? flicker * std::pow(f, -exponent) : 0.0) +
           4.0 * deviation * deviation * correlation_time / (1.0 + turned * turned);
  }
  const auto above =
      static_cast<std::size_t>(std::upper_bound(frequency.begin(), frequency.end(), f) - frequency.begin());
  const std::size_t k = std::clamp<std::size_t>(above, 1, frequency.size() - 1);
  const double slope = std::log(density[k] / density[k - 1]) / std::log(frequency[k] / frequency[k - 1]);
  return density[k - 1] * std::pow(f / frequency[k - 1], slope);
}

double PowerDensity::power_at_zero() const { return flicker > 0.0 ? -exponent : 0.0; }

double PowerDensity::power_at_infinity() const {
  if (white > 0.0) return 0.0;
  constexpr double kOfFirstOrder = -2.0;
  return flicker > 0.0 ? std::max(-exponent, deviation > 0.0 ? kOfFirstOrder : -exponent) : kOfFirstOrder;
}

std::vector<double> PowerDensity::corners() const {
  if (!frequency.empty()) return frequency;
  std::vector<double> out;
  if (lower > 0.0) out.push_back(lower);
  if (std::isfinite(upper)) out.push_back(upper);
  if (deviation > 0.0) out.push_back(1.0 / (2.0 * M_PI * correlation_time));
  if (white > 0.0 && flicker > 0.0) out.push_back(std::pow(flicker / white, 1.0 / exponent));
  return out;
}

std::string PowerDensity::text() const {
  std::string out = "density";
  const auto add = [&](double value) {
    char number[32];
    std::snprintf(number, sizeof number, " %.17g", value);
    out += number;
  };
  for (const double value : {white, flicker, exponent, deviation, correlation_time, lower, upper}) add(value);
  for (std::size_t k = 0; k < frequency.size(); ++k) {
    add(frequency[k]);
    add(density[k]);
  }
  return out;
}

}  // namespace boresight
