#include "boresight_analyses/posterior/chain_diagnostics.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace boresight {
namespace {

using Chains = std::vector<std::vector<double>>;

Chains split(const Chains& draws) {
  Chains halves;
  for (const std::vector<double>& chain : draws) {
    const auto half = static_cast<std::ptrdiff_t>(chain.size() / 2);
    halves.emplace_back(chain.begin(), chain.begin() + half);
    halves.emplace_back(chain.end() - half, chain.end());
  }
  return halves;
}

std::vector<double> all_of(const Chains& chains) {
  std::vector<double> all;
  for (const std::vector<double>& chain : chains) all.insert(all.end(), chain.begin(), chain.end());
  return all;
}

// Ties share their mean rank.
Chains normal_scores(const Chains& chains) {
  const std::vector<double> all = all_of(chains);
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return all[a] < all[b]; });
  std::vector<double> score(all.size());
  const boost::math::normal standard;
  const auto S = static_cast<double>(all.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t last = first;
    while (last + 1 < order.size() && all[order[last + 1]] == all[order[first]]) ++last;
    const double rank = 0.5 * static_cast<double>(first + last) + 1.0;
    const double z = boost::math::quantile(standard, (rank - 0.375) / (S + 0.25));
    for (; first <= last; ++first) score[order[first]] = z;
  }
  Chains scores = chains;
  std::size_t k = 0;
  for (std::vector<double>& chain : scores)
    for (double& value : chain) value = score[k++];
  return scores;
}

// As R and Python have it (type 7).
double quantile_of(std::vector<double> values, double p) {
  std::sort(values.begin(), values.end());
  const double place = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

struct Variances {
  double within = 0.0, whole = 0.0;  // W; (n - 1) / n W + B / n
};

Variances variances_of(const Chains& chains) {
  const auto n = static_cast<double>(chains.front().size()), m = static_cast<double>(chains.size());
  std::vector<double> means;
  Variances v;
  for (const std::vector<double>& chain : chains) {
    means.push_back(mean_of(chain));
    for (const double x : chain) v.within += (x - means.back()) * (x - means.back()) / (n - 1.0) / m;
  }
  const double middle = mean_of(means);
  double between = 0.0;  // B / n
  for (const double mean : means) between += (mean - middle) * (mean - middle) / (m - 1.0);
  v.whole = (n - 1.0) / n * v.within + between;
  return v;
}

double r_hat_of(const Chains& chains) {
  const Variances v = variances_of(chains);
  return v.within > 0.0 ? std::sqrt(v.whole / v.within) : std::numeric_limits<double>::quiet_NaN();
}

double ess_of(const Chains& chains) {
  const std::size_t n = chains.front().size();
  const auto S = static_cast<double>(n * chains.size());
  const Variances v = variances_of(chains);
  if (!(v.whole > 0.0)) return S;
  std::vector<double> means;
  for (const std::vector<double>& chain : chains) means.push_back(mean_of(chain));
  const auto correlation = [&](std::size_t lag) {
    double covariance = 0.0;  // mean over the chains
    for (std::size_t c = 0; c < chains.size(); ++c)
      for (std::size_t i = 0; i + lag < n; ++i)
        covariance += (chains[c][i] - means[c]) * (chains[c][i + lag] - means[c]);
    covariance /= static_cast<double>(n) * static_cast<double>(chains.size());
    return 1.0 - (v.within - covariance) / v.whole;
  };
  // Sums of neighbouring pairs are positive and fall in theory; where they do not, noise has taken over. Of the pair at which that
  // is, or the draws end, the even one still counts where it is positive.
  double sum = 0.0, least = std::numeric_limits<double>::infinity(), last_even = 0.0;
  for (std::size_t lag = 0; lag + 1 < n; lag += 2) {
    const double even = lag == 0 ? 1.0 : correlation(lag), pair = even + correlation(lag + 1);
    last_even = even;
    if (!(pair > 0.0) || lag + 5 >= n) break;
    least = std::min(least, pair);
    sum += least;
    last_even = 0.0;
  }
  const double tau = std::max(-1.0 + 2.0 * sum + std::max(0.0, last_even), 1.0 / std::log10(S));
  return S / tau;
}

}  // namespace

ChainDiagnostics chain_diagnostics(const std::vector<std::vector<double>>& draws) {
  const Chains halves = split(draws);
  const std::vector<double> all = all_of(draws);
  const double middle = quantile_of(all, 0.5);
  Chains folded = halves;
  for (std::vector<double>& chain : folded)
    for (double& x : chain) x = std::abs(x - middle);
  const Chains scores = normal_scores(halves);
  ChainDiagnostics found;
  found.r_hat = std::max(r_hat_of(scores), r_hat_of(normal_scores(folded)));
  found.bulk_ess = ess_of(scores);
  found.tail_ess = std::numeric_limits<double>::infinity();
  for (const double p : {0.05, 0.95}) {
    const double bound = quantile_of(all, p);
    Chains below = halves;
    for (std::vector<double>& chain : below)
      for (double& x : chain) x = x <= bound ? 1.0 : 0.0;
    found.tail_ess = std::min(found.tail_ess, ess_of(below));
  }
  return found;
}

double mean_ess(const std::vector<std::vector<double>>& draws) { return ess_of(split(draws)); }

}  // namespace boresight
