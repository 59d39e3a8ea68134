#include "terminal/readable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/pointing/relative_text.hpp"

namespace boresight::app {
namespace {

constexpr double kRoundedTo = 1e-12;        // [m or rad]
const char* const kNotKnown = "not known";  // no infinity is a length

// A unit, its size in SI, and the value from which on it is used (a tenth of a millimetre is still said in
// mm).
struct Scale {
  const char* name;
  double size;
  double from;
};

// Largest first. The second one is what a zero is said in.
const std::map<std::string, std::vector<Scale>> kScales = {
    {"m", {{"m", 1.0, 1.0}, {"mm", 1e-3, 0.9e-4}, {"µm", 1e-6, 1e-7}, {"nm", 1e-9, 1e-10}, {"pm", 1e-12, 0.0}}},
    {"rad",
     {{"rad", 1.0, 0.1}, {"mrad", 1e-3, 1e-4}, {"µrad", 1e-6, 1e-7}, {"nrad", 1e-9, 1e-10}, {"prad", 1e-12, 0.0}}},
    {"N", {{"kN", 1e3, 1e3}, {"N", 1.0, 1.0}, {"mN", 1e-3, 0.0}}},
    {"m/s", {{"m/s", 1.0, 0.5}, {"mm/s", 1e-3, 1e-4}, {"µm/s", 1e-6, 0.0}}},
    {"s", {{"h", 3600.0, 5400.0}, {"min", 60.0, 90.0}, {"s", 1.0, 0.5}, {"ms", 1e-3, 1e-4}, {"µs", 1e-6, 0.0}}},
    {"Pa", {{"GPa", 1e9, 1e8}, {"MPa", 1e6, 1e5}, {"Pa", 1.0, 0.0}}},
};

// Three significant digits, without an exponent where that stays short.
std::string digits(double value) {
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (size >= 1e6 || size < 1e-3) return fmt::format("{:.3g}", value);
  const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(size) + 1e-9)));
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

}  // namespace

DisplayUnit display_unit(const std::string& si_unit, double largest) {
  const auto found = kScales.find(si_unit);
  if (found == kScales.end()) return {si_unit == "1" ? "" : si_unit == "m/s^2" ? "m/s²" : si_unit, 1.0};
  const auto& scales = found->second;
  if (largest == 0.0) return {scales[1].name, 1.0 / scales[1].size};
  for (const Scale& scale : scales)
    if (std::abs(largest) >= scale.from * (1.0 - 1e-9)) return {scale.name, 1.0 / scale.size};
  return {si_unit, 1.0};
}

std::string readable(double value, const std::string& si_unit) {
  if (!std::isfinite(value)) return kNotKnown;
  const DisplayUnit unit = display_unit(si_unit, value);
  // A length or angle this small is the rounding of the computation.
  if ((si_unit == "m" || si_unit == "rad") && value != 0.0 && std::abs(value) < kRoundedTo)
    return "below 1 " + unit.name;
  return digits(value * unit.per_si) + (unit.name.empty() ? "" : " " + unit.name);
}

namespace {

// Whether a length or an angle is said as a share of one, "ppm": the scale of a drive.
bool is_said_as_share(const std::string& si_unit, const std::string& written) {
  if (si_unit != "m" && si_unit != "rad") return false;
  try {
    scale_of_unit(written, unit_called(si_unit));
    return false;
  } catch (const ValueFault&) {
    return true;
  }
}

}  // namespace

DisplayUnit display_unit_as(const std::string& si_unit, double largest, const std::string& written) {
  if (written.empty()) return display_unit(si_unit, largest);
  const double per_si = 1.0 / scale_of_unit(written, unit_called(si_unit, true));
  const double shown = std::abs(largest) * per_si;
  constexpr double kFewZeros = 1e-3, kFewDigits = 1e5;
  if (is_said_as_share(si_unit, written))
    return shown < kFewDigits ? DisplayUnit{written, per_si} : DisplayUnit{"%", 1e2};
  if (shown != 0.0 && (shown < kFewZeros || shown >= kFewDigits)) return display_unit(si_unit, largest);
  return {written, per_si};
}

std::string readable_as(double value, const std::string& si_unit, const std::string& written) {
  const DisplayUnit unit = display_unit_as(si_unit, value, written);
  if (!std::isfinite(value)) return kNotKnown;
  if (unit.name == "%" || (!written.empty() && unit.name == written))
    return digits(value * unit.per_si) + " " + unit.name;
  return readable(value, si_unit);
}

std::string readable_limit(double value, const std::string& si_unit, const std::string& written) {
  if (!std::isfinite(value)) return kNotKnown;
  const DisplayUnit unit = written.empty()
                               ? display_unit(si_unit, value)
                               : DisplayUnit{written, 1.0 / scale_of_unit(written, unit_called(si_unit, true))};
  // Twelve digits: more than anyone types, and fewer than the change of units leaves noise in.
  return fmt::format("{:.12g}", value * unit.per_si) + (unit.name.empty() ? "" : " " + unit.name);
}

std::string readable_of_error(double value, const std::string& said_unit) {
  constexpr double kInPercent = 1e-3;
  if (said_unit != "1" || !std::isfinite(value)) return readable(value, said_unit);
  return std::abs(value) < kInPercent ? digits(1e6 * value) + " ppm" : readable_share(value);
}

std::string readable_arcsec(double radians) {
  if (!std::isfinite(radians)) return kNotKnown;
  if (radians != 0.0 && std::abs(radians) < kRoundedTo) return "below 0.000001 arcsec";
  return digits(radians * 180.0 / std::numbers::pi * 3600.0) + " arcsec";
}
std::string readable_share(double share) { return std::isfinite(share) ? digits(100.0 * share) + " %" : kNotKnown; }
std::string readable_near_all(double share) {
  const double lacks = 100.0 * (1.0 - share);
  if (!std::isfinite(share) || !(lacks > 1e-12)) return readable_share(share);
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(lacks) + 1e-9)));
  const double per_percent = std::pow(10.0, decimals);
  return fmt::format("{:.{}f} %", std::floor(100.0 * share * per_percent + 1e-6) / per_percent, decimals);
}
std::string readable_error(double relative) {
  return std::abs(relative) < kSaidAsMultiple ? readable_share(relative) : relative_text(relative);
}
std::string how_many(std::size_t count, const std::string& one, const std::string& several) {
  return fmt::format("{} {}", count, count == 1 ? one : several.empty() ? one + "s" : several);
}
std::string readable_number(double value) { return std::isfinite(value) ? digits(value) : kNotKnown; }

}  // namespace boresight::app
