#include "boresight_analyses/statistics/unseen_share.hpp"

#include <algorithm>
#include <cmath>

namespace boresight {

double unseen_share(std::int64_t replicates, double size, double risk) {
  constexpr double kMostTogether = 2.0;
  const auto hidden_in = [&](double independent) { return -std::expm1(std::log(risk) / independent); };
  const double n = static_cast<double>(replicates);
  return std::max(std::min(1.0, kMostTogether / size) * hidden_in(n), hidden_in(n * size));
}

}  // namespace boresight
