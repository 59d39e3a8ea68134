#include "boresight/pointing/relative_text.hpp"

#include <cmath>
#include <cstdio>

namespace boresight {

std::string relative_text(double relative, int digits, const std::string& of) {
  constexpr double kNoMore = 1e4;  // told apart
  if (!std::isfinite(relative)) return "not known";
  const double size = std::abs(relative), percent = 100.0 * relative;
  char text[40];
  if (size >= kNoMore) {
    std::snprintf(text, sizeof text, "over %.0f times ", kNoMore);
    return text + of;
  }
  if (size >= kSaidAsMultiple) {
    std::snprintf(text, sizeof text, "%.0f times ", relative);
    return text + of;
  }
  // No exponent: %g has one from as many figures on as it has digits.
  if (std::abs(percent) >= std::pow(10.0, digits) - 0.5)
    std::snprintf(text, sizeof text, "%.0f %%", percent);
  else
    std::snprintf(text, sizeof text, "%.*g %%", digits, percent);
  return text;
}

}  // namespace boresight
