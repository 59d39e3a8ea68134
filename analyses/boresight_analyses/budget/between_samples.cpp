#include "boresight_analyses/budget/between_samples.hpp"

#include <algorithm>
#include <cmath>

namespace boresight {

double share_between_samples(const std::function<std::array<double, 3>(double)>& course, double start, double spacing,
                             std::size_t samples) {
  constexpr double kGolden = 0.6180339887498949;  // whose multiples come back to no period
  constexpr std::size_t kMostCells = 20'000;
  const std::size_t cells = samples > 1 ? samples - 1 : 0, stride = std::max<std::size_t>(1, cells / kMostCells);
  double missed = 0.0, squares = 0.0, count = 0.0;
  std::array<double, 3> sum = {};
  for (std::size_t k = 0; k < cells; k += stride) {
    const double place = kGolden * static_cast<double>(k + 1), share = place - std::floor(place);
    const double at = start + static_cast<double>(k) * spacing;
    const auto first = course(at), between = course(at + share * spacing), last = course(at + spacing);
    count += 1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double off = between[i] - (first[i] + share * (last[i] - first[i]));
      missed += off * off;
      squares += between[i] * between[i];
      sum[i] += between[i];
    }
  }
  if (count == 0.0) return 0.0;
  double variance = squares / count;
  for (const double s : sum) variance -= s * s / (count * count);
  constexpr double kRounding = 1e-12;  // of what it adds up to
  return variance > kRounding * squares / count ? missed / count / variance : 0.0;
}

}  // namespace boresight
