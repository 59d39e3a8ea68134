#include "boresight/io/tried_value.hpp"

#include <cstdio>

namespace boresight {

TriedValue::TriedValue(double value, const std::string& unit) {
  const auto text = [&](const char* format) {
    char digits[40];
    std::snprintf(digits, sizeof digits, format, value);
    return unit == "1" || unit.empty() ? std::string(digits) : digits + (" " + unit);
  };
  exact_ = text("%.17g");
  shown_ = text("%.6g");
}

std::string TriedValue::in_message(std::string found) const {
  if (const std::size_t place = found.find(exact_); place != std::string::npos)
    found.replace(place, exact_.size(), shown_);
  return found;
}

}  // namespace boresight
