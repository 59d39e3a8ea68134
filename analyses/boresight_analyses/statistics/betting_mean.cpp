#include "boresight_analyses/statistics/betting_mean.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "boresight_analyses/statistics/bounded_mean.hpp"

namespace boresight {
namespace {

// Values that occur `times` times.
struct Counted {
  double value = 0.0;
  double times = 1.0;
};

// Half of the capital plays all or nothing, which is best where values beyond the mean are never seen; the other half is
// spread evenly over ever smaller stakes.
constexpr int kSmaller = 16;

double log_capital(const std::vector<Counted>& values, double mean) {
  double top = -std::numeric_limits<double>::infinity();
  std::vector<double> logs;
  double stake = 1.0;
  for (int game = 0; game <= kSmaller; ++game, stake *= 0.5) {
    double log = game == 0 ? std::log(0.5) : std::log(0.5 / kSmaller);
    for (const Counted& v : values) log += v.times * std::log1p(stake * (v.value / mean - 1.0));
    logs.push_back(log);
    top = std::max(top, log);
  }
  if (!std::isfinite(top)) return top;
  double sum = 0.0;
  for (const double log : logs) sum += std::exp(log - top);
  return top + std::log(sum);
}

// The capital falls as the mean in question grows.
template <typename LogCapital>
double largest_refused(const LogCapital& log_capital_of, double confidence) {
  if (!(confidence > 0.0 && confidence < 1.0)) throw std::invalid_argument("confidence must lie between 0 and 1");
  const double ruin = -std::log1p(-confidence);
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60 && high - low > 1e-12 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (log_capital_of(middle) >= ruin ? low : high) = middle;
  }
  return low;
}

double lower(const std::vector<Counted>& values, double confidence) {
  return largest_refused([&](double mean) { return log_capital(values, mean); }, confidence);
}

std::vector<Counted> counted(std::span<const double> values, std::int64_t zeros, bool mirrored) {
  if (zeros < 0 || (values.empty() && zeros == 0)) throw std::invalid_argument("there must be values");
  std::vector<Counted> all;
  for (const double v : values) {
    if (!(v >= 0.0 && v <= 1.0)) throw std::invalid_argument("the values must lie between 0 and 1");
    all.push_back({mirrored ? 1.0 - v : v, 1.0});
  }
  if (zeros > 0) all.push_back({mirrored ? 1.0 : 0.0, static_cast<double>(zeros)});
  // Equal ones together: indicators take few values.
  std::sort(all.begin(), all.end(), [](const Counted& l, const Counted& r) { return l.value < r.value; });
  std::size_t last = 0;
  for (std::size_t k = 1; k < all.size(); ++k) {
    if (all[k].value == all[last].value)
      all[last].times += all[k].times;
    else
      all[++last] = all[k];
  }
  all.resize(last + 1);
  return all;
}

std::vector<Counted> shares(std::int64_t hits, std::int64_t samples) {
  if (hits < 0 || hits > samples || samples <= 0) throw std::invalid_argument("hits must lie between 0 and samples");
  std::vector<Counted> all;
  if (hits > 0) all.push_back({1.0, static_cast<double>(hits)});
  if (hits < samples) all.push_back({0.0, static_cast<double>(samples - hits)});
  return all;
}

}  // namespace

double betting_lower(std::span<const double> values, std::int64_t zeros, double confidence) {
  return lower(counted(values, zeros, false), confidence);
}

double betting_upper(std::span<const double> values, std::int64_t zeros, double confidence) {
  return 1.0 - lower(counted(values, zeros, true), confidence);
}

double betting_share_lower(std::int64_t hits, std::int64_t samples, double confidence) {
  return lower(shares(hits, samples), confidence);
}

double betting_share_upper(std::int64_t hits, std::int64_t samples, double confidence) {
  return 1.0 - lower(shares(samples - hits, samples), confidence);
}

double first_bet_stake(std::int64_t first, double mean, double confidence) {
  if (first <= 0) throw std::invalid_argument("there must be first values");
  const double shown_by = mean_that_shows(mean, static_cast<double>(first), confidence);
  return shown_by < 1.0 ? 1.0 - (1.0 - shown_by) / (1.0 - mean) : 1.0;
}

double first_bet_lower(std::int64_t first, std::span<const double> values, std::int64_t ones, std::int64_t zeros,
                       double confidence) {
  std::vector<Counted> all;
  if (!values.empty() || zeros > 0) all = counted(values, zeros, false);
  if (ones > 0) all.push_back({1.0, static_cast<double>(ones)});
  if (all.empty()) throw std::invalid_argument("there must be values");
  const auto log_capital_of = [&](double mean) {
    const double stake = first_bet_stake(first, mean, confidence);
    double log = 0.0;
    for (const Counted& v : all) log += v.times * std::log1p(stake * (v.value / mean - 1.0));
    return log;
  };
  return largest_refused(log_capital_of, confidence);
}

}  // namespace boresight
