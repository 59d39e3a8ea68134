#include "reference/quantity_pattern.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "boresight/keys/units.hpp"

namespace boresight::app {
namespace {

// Units have no offset, so that zero and the sign are the same in each. "-0 mm" is zero.
std::string sign_of(const Key& key) {
  std::string sign = "[-+]?";
  for (const KeyBound& bound : key.bounds) {
    if (bound.least > 0.0 || (bound.least == 0.0 && bound.above)) return "\\+?(?=[0.]*[1-9])";
    if (bound.least == 0.0) sign = "(\\+|-(?=[0.]+(?![0-9.])))?";
  }
  return sign;
}

std::string as_pattern(const std::string& unit) {
  std::string out;
  for (const char c : unit) {
    if (std::string("^.*/()%").find(c) != std::string::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string one_of(const std::vector<std::string>& all) {
  std::string out;
  for (const std::string& one : all) out += (out.empty() ? "(" : "|") + one;
  return out + ")";
}

// Whole numbers from `least` on, which is less than a hundred, without leading zeros.
std::string whole_from(int least) {
  const std::string tens = std::to_string(least / 10), ones = std::to_string(least % 10),
                    more_tens = std::to_string(least / 10 + 1);
  const std::string larger = "[1-9][0-9]{2,}";
  if (least < 10) return "([" + ones + "-9]|[1-9][0-9]|" + larger + ")";
  const std::string below_a_hundred =
      tens + "[" + ones + "-9]" + (least < 90 ? "|[" + more_tens + "-9][0-9]" : std::string());
  return "(" + below_a_hundred + "|" + larger + ")";
}

// Numbers of 10^power and more, as people write them: "12345", "1e4". power: 1 to 99.
std::string at_least_ten_to(int power) {
  return "([1-9][0-9]{" + std::to_string(power) + ",}(\\.[0-9]*)?|[1-9][0-9]*\\.?[0-9]*[eE]\\+?0*" + whole_from(power) +
         ")";
}

// In each of the common units: what is larger than `most` by its power of ten alone.
std::string larger_than(double most, const SiUnit& unit) {
  std::vector<std::string> all;
  for (const std::string& common : common_units(unit, true)) {
    // A little more, for rounding.
    const double power = std::floor(std::log10(most / scale_of_unit(common, unit) * (1.0 + 1e-9))) + 1.0;
    if (power >= 1.0 && power < 100.0)
      all.push_back(at_least_ten_to(static_cast<int>(power)) + "[ \\t]*" + as_pattern(common));
  }
  return all.empty() ? "" : one_of(all);
}

// Nothing of that, with nothing behind it.
std::string not_this(const std::string& pattern) { return pattern.empty() ? "" : "(?!" + pattern + "[ \\t]*$)"; }

std::string not_too_large(const Key& key) {
  const SiUnit& unit = key.range.unit;
  if (*unit.what == '\0') return "";
  std::string out;
  if (*key.range.most != '\0') out += not_this("[-+]?" + larger_than(parse_quantity(key.range.most, unit), unit));
  for (const KeyBound& bound : key.bounds)
    if (std::isfinite(bound.most) && bound.most > 0.0) out += not_this("\\+?" + larger_than(bound.most, unit));
  return out;
}

std::string not_of_another_dimension(const Key& key) {
  if (*key.range.unit.what == '\0') return "";
  std::vector<std::string> all;
  for (const std::string& common : common_units(key.range.unit, false)) all.push_back(as_pattern(common));
  return not_this("[ \\t]*" + one_of(all));
}

}  // namespace

std::string quantity_pattern(const Key& key) {
  // Anything with the {i} of a pattern stands for what the pattern makes of it.
  return "^[ \\t]*" + not_too_large(key) + sign_of(key) +
         "([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?(?![0-9.]|[eE][-+]?[0-9])" + not_of_another_dimension(key) +
         "([ \\t]*[^-+ \\t0-9.]|[ \\t]+1).*$"
         "|\\{i\\}";
}

}  // namespace boresight::app
