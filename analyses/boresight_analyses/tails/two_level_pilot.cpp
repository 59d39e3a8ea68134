#include "boresight_analyses/tails/two_level_pilot.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "boresight_analyses/statistics/running.hpp"

namespace boresight {
namespace {

constexpr std::uint64_t kMarginSet = ~0ull - 1000, kPilotSet = ~0ull - 1001;  // of the stream's draws

struct Pair {
  WeightedDraws drawn;
  std::vector<double> cheap, exact;  // cheap: none where it is left alone
};

// Standard deviations of one point's contribution: of the exact model less `control` times the cheap one, and of the cheap.
// Where few points tell them apart their agreement is a matter of luck: one more point on which they disagree, of the mean
// square weight of those beyond, keeps the first from being taken for nothing.
struct Scatter {
  double corrected = 0.0, cheap = 0.0;
};
Scatter scatter(const Pair& pair, double limit, double control) {
  RunningMoments corrected, cheap, squares;
  for (std::size_t k = 0; k < pair.exact.size(); ++k) {
    const double c = !pair.cheap.empty() && is_beyond(pair.cheap[k], limit), e = is_beyond(pair.exact[k], limit);
    corrected.add(pair.drawn.weights[k] * (e - control * c));
    cheap.add(pair.drawn.weights[k] * c);
    if (c + e > 0.0) squares.add(pair.drawn.weights[k] * pair.drawn.weights[k]);
  }
  const double unseen = control > 0.0 ? squares.mean() / double(pair.exact.size()) : 0.0;
  return {std::sqrt(corrected.variance() + unseen), cheap.sd()};
}

// Weights of the points beyond a limit: their mean over all, and of how many equal ones they are worth (Kish 1965).
struct Beyond {
  double share = 0.0, effective = 0.0;
};
Beyond beyond(const WeightedDraws& drawn, const std::vector<double>& values, double limit) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const double w = is_beyond(values[k], limit) ? drawn.weights[k] : 0.0;
    sum += w;
    squares += w * w;
  }
  return {sum / static_cast<double>(values.size()), squares > 0.0 ? sum * sum / squares : 0.0};
}

// Five points tell a mean to a half of itself, about; and what was seen may be three times what the search found, or a third of it.
constexpr double kFewestEffective = 5.0, kFactor = 3.0;
bool tells(const Beyond& seen, double found) {
  return seen.effective >= kFewestEffective && seen.share <= kFactor * found && found <= kFactor * seen.share;
}

}  // namespace

TwoLevelPlan two_level_pilot(const BatchModel& cheap, const BatchModel& exact, int dimensions, double limit,
                             std::int64_t pilot_points, const TwoLevelCosts& costs, double budget,
                             const ProposalOptions& options) {
  if (!(costs.cheap > 0.0 && costs.exact > 0.0 && budget > 0.0))
    throw std::invalid_argument("costs and budget must be positive");
  if (pilot_points < 10) throw std::invalid_argument("the pilot needs ten points");
  const CounterStream stream(options.subset.seed, StreamPurpose::proposal);
  const bool on_exact = !(costs.cheap < costs.exact);
  TwoLevelPlan plan{tail_proposal(on_exact ? exact : cheap, dimensions, limit, options), on_exact, limit};
  const auto run = [&](std::uint64_t set) {
    Pair pair{weighted_draws(plan.proposal.mixture, stream, set, 0, pilot_points), {}, {}};
    pair.exact = exact(pair.drawn.points);
    plan.exact_evaluations += pilot_points;
    if (on_exact) return pair;
    pair.cheap = cheap(pair.drawn.points);
    plan.cheap_evaluations += pilot_points;
    return pair;
  };
  (on_exact ? plan.exact_evaluations : plan.cheap_evaluations) = plan.proposal.evaluations;

  if (!on_exact) {
    // How far the exact model lies above the cheap one near the tail: mean and two sd.
    RunningMoments above;
    const Pair first = run(kMarginSet);
    for (std::size_t k = 0; k < first.exact.size(); ++k)
      if (std::isfinite(first.exact[k]) && std::isfinite(first.cheap[k])) above.add(first.exact[k] - first.cheap[k]);
    const double margin = std::max(0.0, above.mean() + 2.0 * above.sd());
    if (margin > 0.0) {
      plan.cheap_limit = limit - margin;
      plan.proposal = tail_proposal(cheap, dimensions, plan.cheap_limit, options);
      plan.cheap_evaluations += plan.proposal.evaluations;
    }
  }

  const Pair pair = run(kPilotSet);
  const Beyond seen = beyond(pair.drawn, pair.exact, limit);
  plan.probability = seen.share;
  plan.informed = seen.share > 0.0;
  plan.forecasts =
      seen.effective >= kFewestEffective &&
      tells(on_exact ? seen : beyond(pair.drawn, pair.cheap, plan.cheap_limit), plan.proposal.subset.probability);
  if (!plan.informed) {
    plan.standard_error = plan.exact_standard_error = plan.plain_standard_error = std::nan("");
    plan.exact_points = std::max<std::int64_t>(2, static_cast<std::int64_t>(budget / costs.exact));
    return plan;
  }
  // A point of both costs both. With m_exact : m_cheap at its best, error * sqrt(budget) is the sum of sd * sqrt(cost).
  const double both = costs.cheap + costs.exact;
  const auto price = [&](double control) {
    const Scatter s = scatter(pair, limit, control);
    return s.corrected * std::sqrt(control > 0.0 ? both : costs.exact) + control * s.cheap * std::sqrt(costs.cheap);
  };
  for (double control = 0.0; control < 1.21 && !on_exact; control += 0.05)
    if (price(control) < price(plan.control)) plan.control = control;
  const Scatter s = scatter(pair, limit, plan.control);
  const double total = price(plan.control);
  plan.standard_error = total / std::sqrt(budget);
  plan.exact_standard_error = price(0.0) / std::sqrt(budget);
  plan.plain_standard_error =
      std::sqrt(plan.probability * std::max(0.0, 1.0 - plan.probability) * costs.exact / budget);
  const auto points = [&](double sd, double cost) {
    const double m = total > 0.0 ? budget / total * sd / std::sqrt(cost) : 0.5 * budget / cost;
    return std::max<std::int64_t>(2, static_cast<std::int64_t>(m));
  };
  plan.exact_points = points(s.corrected, plan.control > 0.0 ? both : costs.exact);
  plan.cheap_points = plan.control > 0.0 ? points(plan.control * s.cheap, costs.cheap) : 0;
  if (!plan.forecasts) plan.standard_error = plan.exact_standard_error = plan.plain_standard_error = std::nan("");
  return plan;
}

}  // namespace boresight
