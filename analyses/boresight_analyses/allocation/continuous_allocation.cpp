#include "boresight_analyses/allocation/continuous_allocation.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <numeric>

#include "boresight_analyses/allocation/gap_requirements.hpp"
#include "boresight_analyses/optimise/minimise.hpp"

namespace boresight {
namespace {

std::vector<double> exponentials(std::span<const double> x) {
  std::vector<double> t(x.size());
  for (std::size_t j = 0; j < t.size(); ++j) t[j] = std::exp(x[j]);
  return t;
}

// A share s at which from + s (to - from) keeps the limit, in ln t; `from` keeps it. The last one, where the
// requirement does not fall along the way.
double last_within(const ToleranceRequirement& requirement, double limit, const std::vector<double>& from,
                   const std::vector<double>& to, int& evaluations) {
  double low = 0.0, high = 1.0;
  std::vector<double> x(from.size());
  for (int i = 0; i < 60 && high - low > 1e-12; ++i) {
    const double s = i == 0 ? 1.0 : 0.5 * (low + high);
    for (std::size_t j = 0; j < x.size(); ++j) x[j] = from[j] + s * (to[j] - from[j]);
    ++evaluations;
    if (requirement(exponentials(x), {}) <= limit)
      low = s;
    else
      high = s;
    if (low == 1.0) break;
  }
  return low;
}

}  // namespace

double price_of(const std::vector<ContinuousTolerance>& joints, std::span<const double> tolerance) {
  double sum = 0.0;
  for (std::size_t j = 0; j < joints.size(); ++j) sum += joints[j].cost.price(tolerance[j]);
  return sum;
}

std::vector<double> least_tolerances(const std::vector<ContinuousTolerance>& joints,
                                     const ToleranceRequirement& requirement) {
  MinimisationProblem problem;
  std::vector<double> corner;
  for (const ContinuousTolerance& joint : joints) {
    problem.lower.push_back(std::log(joint.lower));
    problem.upper.push_back(std::log(joint.upper));
    corner.push_back(joint.lower);
  }
  double least = requirement(corner, {});
  const double scale = std::max(std::abs(least), 1e-300);
  // One joint after the other at its tightest or its widest, until none gains.
  for (bool better = true; better;) {
    better = false;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      std::vector<double> other = corner;
      other[j] = corner[j] == joints[j].lower ? joints[j].upper : joints[j].lower;
      const double value = requirement(other, {});
      if (!(value < least - 1e-12 * scale)) continue;
      least = value;
      corner = other;
      better = true;
    }
  }
  problem.gradients = true;
  problem.objective = [&](std::span<const double> x, std::span<double> gradient) {
    const std::vector<double> t = exponentials(x);
    const double value = requirement(t, gradient);
    for (std::size_t j = 0; j < gradient.size(); ++j) gradient[j] *= t[j] / scale;
    return value / scale;
  };
  std::vector<double> best = corner;
  const auto descend = [&](const std::vector<double>& from) {
    problem.start.clear();
    for (std::size_t j = 0; j < from.size(); ++j)
      problem.start.push_back(std::clamp(std::log(from[j]), problem.lower[j], problem.upper[j]));
    const Minimum minimum =
        minimise(problem, {.global = "none", .local = "slsqp", .local_evaluations = 200, .tolerance = 1e-8});
    const std::vector<double> t = exponentials(minimum.x);
    const double value = requirement(t, {});
    if (!(value < least - 1e-12 * scale)) return;
    least = value;
    best = t;
  };
  std::vector<double> middle;
  for (const ContinuousTolerance& joint : joints) middle.push_back(std::sqrt(joint.lower * joint.upper));
  descend(corner);
  descend(middle);
  return best;
}

ContinuousAllocation allocate_continuous(const std::vector<ContinuousTolerance>& joints,
                                         const ToleranceRequirement& requirement, double limit) {
  ContinuousAllocation result;
  MinimisationProblem problem;
  for (const ContinuousTolerance& joint : joints) {
    problem.lower.push_back(std::log(joint.lower));
    problem.upper.push_back(std::log(joint.upper));
  }
  ++result.evaluations;
  // Somewhere that keeps the limit: the tightest tolerances, or where gaps work against each other others.
  std::vector<double> keeps = exponentials(problem.lower);
  if (!(requirement(keeps, {}) <= limit)) {
    keeps = least_tolerances(joints, requirement);
    result.reached = requirement(keeps, {});
    if (!(result.reached <= limit)) {
      result.tolerance = keeps;
      result.price = price_of(joints, keeps);
      result.converged = true;
      result.why = "no search of the price: the least value found exceeds the limit";
      return result;
    }
  }
  std::vector<double> from(keeps);
  for (std::size_t j = 0; j < from.size(); ++j)
    from[j] = std::clamp(std::log(keeps[j]), problem.lower[j], problem.upper[j]);
  const double share = last_within(requirement, limit, from, problem.upper, result.evaluations);
  for (std::size_t j = 0; j < joints.size(); ++j)
    problem.start.push_back(from[j] + share * (problem.upper[j] - from[j]));
  // A requirement with kinks (an order statistic, a maximum over time) can stop either algorithm short; the better one stands, pulled back
  // onto the limit where it lies beyond it. `free`: the tolerances that are sought, by what they cost above the least that they may; the
  // others stay. `anchor` keeps the limit.
  std::vector<double> best = problem.start;
  const auto seek = [&](const std::vector<std::size_t>& free, const std::vector<double>& anchor) {
    const auto whole = [&](std::span<const double> x) {
      std::vector<double> all = best;
      for (std::size_t i = 0; i < free.size(); ++i) all[free[i]] = x[i];
      return all;
    };
    const auto excess = [&](const std::vector<double>& x) {
      double sum = 0.0;
      for (const std::size_t j : free) sum += joints[j].cost.above(std::exp(x[j]), joints[j].upper);
      return sum;
    };
    const double scale = std::max(excess(best), 1e-300);
    MinimisationProblem part;
    for (const std::size_t j : free) {
      part.lower.push_back(problem.lower[j]);
      part.upper.push_back(problem.upper[j]);
    }
    part.gradients = true;
    part.objective = [&](std::span<const double> x, std::span<double> gradient) {
      const std::vector<double> all = whole(x);
      for (std::size_t i = 0; i < gradient.size(); ++i) {
        const double t = std::exp(x[i]);
        gradient[i] = joints[free[i]].cost.slope(t) * t / scale;
      }
      return excess(all) / scale;
    };
    part.constraints.push_back([&](std::span<const double> x, std::span<double> gradient) {
      const std::vector<double> t = exponentials(whole(x));
      ++result.evaluations;
      std::vector<double> slopes(gradient.empty() ? 0 : t.size());
      const double value = requirement(t, slopes);
      for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] = slopes[free[i]] * t[free[i]] / limit;
      return value / limit - 1.0;
    });
    const auto offer = [&](const std::vector<double>& x, bool converged) {
      const std::vector<double> to = whole(x);
      const double s = last_within(requirement, limit, anchor, to, result.evaluations);
      std::vector<double> kept(to.size());
      for (std::size_t j = 0; j < to.size(); ++j) kept[j] = anchor[j] + s * (to[j] - anchor[j]);
      if (!(excess(kept) < excess(best))) return false;
      best = kept;
      result.converged = converged;
      return true;
    };
    constexpr int kMostDescents = 6;
    for (int descent = 0; descent < kMostDescents; ++descent) {
      const double before = excess(best);
      for (const char* algorithm : {"slsqp", "mma"}) {
        part.start.clear();
        for (const std::size_t j : free) part.start.push_back(best[j]);
        const Minimum minimum = minimise(part, {.global = "none",
                                                .local = algorithm,
                                                .local_evaluations = 300,
                                                .tolerance = 1e-10,
                                                .constraint_tolerance = 1e-10});
        if (offer(minimum.x, minimum.converged))
          result.why =
              std::string(algorithm) + " in ln t: gradients are at hand, and reciprocal costs are convex there";
      }
      if (!(excess(best) < before * (1.0 - 1e-7))) {
        result.converged = true;  // neither moves on
        break;
      }
    }
  };
  std::vector<std::size_t> free(joints.size());
  std::iota(free.begin(), free.end(), std::size_t{0});
  seek(free, from);
  // Prices that are small beside others do not show in the sum: they are sought once more by themselves, the dear ones being where
  // they are.
  for (;;) {
    constexpr double kSmall = 1e-5;
    std::vector<double> say(joints.size());
    double most = 0.0;
    for (const std::size_t j : free) {
      const double t = std::exp(best[j]);
      most = std::max(most, say[j] = std::abs(joints[j].cost.slope(t) * t));
    }
    std::vector<std::size_t> small;
    for (const std::size_t j : free)
      if (say[j] > 0.0 && say[j] < kSmall * most) small.push_back(j);
    if (small.empty()) break;
    free = small;
    seek(free, std::vector<double>(best));
  }
  result.feasible = true;
  result.tolerance = exponentials(best);
  result.price = price_of(joints, result.tolerance);
  result.reached = requirement(result.tolerance, {});
  return result;
}

ToleranceRequirement statistical_tolerances(const LinearDeviation& deviation, std::vector<double> least,
                                            std::vector<std::vector<double>> z, std::int64_t allowed) {
  return [&deviation, least = std::move(least), z = std::move(z), allowed](std::span<const double> t,
                                                                           std::span<double> gradient) {
    if (allowed < 0) return std::numeric_limits<double>::infinity();
    const std::size_t samples = z.front().size();
    std::vector<std::pair<double, std::size_t>> values(samples);
    std::vector<double> c(t.size()), g(t.size());
    const auto gaps = [&](std::size_t k) {
      for (std::size_t j = 0; j < c.size(); ++j) c[j] = least[j] + t[j] * z[j][k];
    };
    for (std::size_t k = 0; k < samples; ++k) {
      gaps(k);
      values[k] = {deviation.index(c), k};
    }
    const auto rank = static_cast<std::size_t>(allowed);
    const std::size_t reach = 1 + rank / 4;
    const std::size_t last = std::min(samples, rank + reach + 1);
    std::partial_sort(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(last), values.end(),
                      std::greater<>());
    if (!gradient.empty()) {
      std::fill(gradient.begin(), gradient.end(), 0.0);
      const std::size_t first = rank > reach ? rank - reach : 0;
      for (std::size_t i = first; i < last; ++i) {
        gaps(values[i].second);
        deviation.index(c, g);
        for (std::size_t j = 0; j < g.size(); ++j)
          gradient[j] += g[j] * z[j][values[i].second] / static_cast<double>(last - first);
      }
    }
    return values[rank].first;
  };
}

ToleranceRequirement with_fixed(ToleranceRequirement of_all, std::vector<double> fixed) {
  if (fixed.empty()) return of_all;
  return [of_all = std::move(of_all), fixed = std::move(fixed)](std::span<const double> t, std::span<double> gradient) {
    std::vector<double> all(t.begin(), t.end()), slope(t.size() + fixed.size());
    all.insert(all.end(), fixed.begin(), fixed.end());
    const double value = of_all(all, gradient.empty() ? std::span<double>() : std::span<double>(slope));
    std::copy_n(slope.begin(), gradient.size(), gradient.begin());
    return value;
  };
}

ToleranceRequirement worst_case_tolerances(const LinearDeviation& deviation, ZonePlaces places) {
  return [&deviation, places = std::move(places)](std::span<const double> t, std::span<double> gradient) {
    std::vector<double> c(t.size());
    for (std::size_t j = 0; j < c.size(); ++j)
      c[j] = std::abs(places.least[j]) + (places.is_centred(j) ? 0.5 : 1.0) * t[j];
    const double value = deviation.worst_index(c, gradient);
    for (std::size_t j = 0; j < gradient.size(); ++j)
      if (places.is_centred(j)) gradient[j] *= 0.5;
    return value;
  };
}

ToleranceRequirement root_sum_square_tolerances(const LinearDeviation& deviation, ZonePlaces places,
                                                double probability) {
  const double quantile = root_sum_square_quantile(probability, places.centred, places.least.size());
  return [&deviation, places = std::move(places), quantile](std::span<const double> t, std::span<double> gradient) {
    const auto value = [&](const std::vector<double>& tolerance) {
      std::vector<double> middle(places.least), half(tolerance.size());
      for (std::size_t j = 0; j < half.size(); ++j) {
        half[j] = 0.5 * tolerance[j];
        if (!places.is_centred(j)) middle[j] += half[j];
      }
      return root_sum_square_index(deviation, middle, half, quantile, places.centred);
    };
    std::vector<double> at(t.begin(), t.end());
    for (std::size_t j = 0; j < gradient.size(); ++j) {
      const double h = 1e-5 * t[j];
      at[j] = t[j] + h;
      const double above = value(at);
      at[j] = t[j] - h;
      gradient[j] = (above - value(at)) / (2.0 * h);
      at[j] = t[j];
    }
    return value(at);
  };
}

}  // namespace boresight
