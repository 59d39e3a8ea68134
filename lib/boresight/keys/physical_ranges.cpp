#include "boresight/keys/physical_ranges.hpp"

#include <cmath>

namespace boresight {
std::string in_words(const PhysicalRange& range) {
  const std::string what = range.unit.what, least = range.least, most = range.most;
  return least.empty() ? what + " of at most " + most : what + " from " + least + " to " + most;
}

bool holds(const PhysicalRange& range, double value) {
  constexpr double kRounding = 1e-12;  // of the bound itself, written in another unit
  const double size = std::abs(value);
  if (*range.most != '\0' && size > parse_quantity(range.most, range.unit) * (1.0 + kRounding)) return false;
  return *range.least == '\0' || value == 0.0 || size >= parse_quantity(range.least, range.unit) * (1.0 - kRounding);
}

}  // namespace boresight
