#include "boresight_analyses/posterior/temperature_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace boresight {

std::vector<double> first_ladder(int count, double narrow) {
  // The reference counts as much as the target where beta is the square of the narrower width.
  const double least = std::clamp(narrow * narrow, 1e-8, 0.5);
  std::vector<double> beta = {0.0};
  for (int k = 1; k < count; ++k)
    beta.push_back(std::pow(least, static_cast<double>(count - 1 - k) / std::max(1, count - 1)));
  return beta;
}

double swap_probability(double beta1, double beta2, double w1, double w2) {
  // What has no density in the target stays at the reference.
  if (!std::isfinite(w1) || !std::isfinite(w2)) return 0.0;
  return std::min(1.0, std::exp((beta2 - beta1) * (w1 - w2)));
}

double communication_barrier(const std::vector<double>& rejection) {
  return std::accumulate(rejection.begin(), rejection.end(), 0.0);
}

std::vector<double> evened_ladder(const std::vector<double>& beta, const std::vector<double>& rejection) {
  const std::size_t steps = beta.size() - 1;
  // No step without a barrier at all: the sum has to rise.
  std::vector<double> barrier = {0.0};
  for (std::size_t k = 0; k < steps; ++k) barrier.push_back(barrier.back() + std::max(rejection[k], 1e-3));
  std::vector<double> evened = {0.0};
  for (std::size_t k = 1, at = 0; k < steps; ++k) {
    const double wanted = barrier.back() * static_cast<double>(k) / static_cast<double>(steps);
    while (barrier[at + 1] < wanted) ++at;
    const double share = (wanted - barrier[at]) / (barrier[at + 1] - barrier[at]);
    // Exponents differ by factors; only from the reference on by differences.
    evened.push_back(at == 0 ? share * beta[1] : beta[at] * std::pow(beta[at + 1] / beta[at], share));
  }
  evened.push_back(1.0);
  return evened;
}

}  // namespace boresight
