// What an allocation's winner is held against: the tightest and the best-pointing sets, a uniform one, the front of prices.
#include <algorithm>
#include <cmath>

#include "boresight_analyses/allocation/allocating.hpp"

namespace boresight {

void Allocating::try_what_points_best(const Allocation& a, const ConfirmingModel& confirm, const std::string& rung) {
  std::vector<Allocation> tries = {tightest_like(a)};
  if (Allocation best = best_like(a); !same(best, tries.front())) tries.push_back(best);
  result_.best_reachable = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tries.size(); ++i) {
    const std::string which = i == 0 ? "the tightest gaps" : "the gaps that point best";
    progress("trying " + which + " on the rung " + rung, 0.8);
    Allocation tried = tries[i];
    evaluate(tried);
    const auto best_so_far = [&](const AllocationConfirmation& c, std::size_t number) {
      if (i > 0 && !(c.reached < result_.best_reachable)) return;
      result_.best_reachable = c.reached;
      result_.chosen = tried;
      result_.confirmed_by = number;
    };
    if (const Refuted* refuted = refutation_of(tried)) {  // by a round: what that found stands
      best_so_far(result_.confirmations[refuted->confirmation], refuted->confirmation);
      continue;
    }
    double factor = 1.0;
    AllocationConfirmation c = confirmed(tried, confirm, rung, factor);
    c.sentence += ", with " + which;
    if (c.met) {
      tried.why = which + ", tried on the confirming rung; the linear deviation had found nothing";
      c.agrees = true;
      c.sentence += "; the linear deviation is off by too much here to show anything cheaper";
      result_.factor = std::isfinite(factor) ? factor : result_.factor;
      evaluate(tried);
      tried.feasible = result_.feasible = true;
      result_.chosen = tried;
      result_.confirmed_by = result_.confirmations.size();
      result_.confirmations.push_back(c);
      return;
    }
    best_so_far(c, result_.confirmations.size());
    result_.confirmations.push_back(c);
  }
  result_.converged = !a.feasible && a.proven;
}

Allocation Allocating::tightest_like(const Allocation& a) const {
  Allocation tight = a;
  tight.feasible = tight.proven = tight.finished = false;
  if (plan_.is_continuous()) {
    for (std::size_t j = 0; j < curves_.size(); ++j) tight.tolerance[j] = curves_[j].lower;
  } else {
    tight.choice = tightest_;
    use_steps(tight);
  }
  tight.price = price_of_set(tight);
  return tight;
}

Allocation Allocating::best_like(const Allocation& a) const {
  Allocation best = tightest_like(a);
  if (allowed_ < 0 || (beside_.empty() && deviation_.rises_with_every_gap(lowest_gap(), highest_gap()))) return best;
  if (plan_.is_continuous()) {
    best.tolerance = least_tolerances(curves_, statistical(places_.least, z_));
    best.price = price_of_set(best);
    return best;
  }
  double least = statistical_->reached(best.choice);
  for (bool better = true; better;) {
    better = false;
    for (std::size_t j = 0; j < gap_.size(); ++j)
      for (int o = 0; o < static_cast<int>(gap_[j].size()); ++o) {
        std::vector<int> other = best.choice;
        other[j] = o;
        const double reached = statistical_->reached(other);
        if (!(reached < least * (1.0 - 1e-12))) continue;
        least = reached;
        best.choice = other;
        better = true;
      }
  }
  use_steps(best);
  best.price = price_of_set(best);
  return best;
}

std::vector<double> Allocating::extreme_gaps(bool highest) const {
  std::vector<double> gaps;
  for (std::size_t j = 0; j < plan_.entries.size(); ++j) {
    const DistributionPtr first =
        gap_[j].empty() ? plan_.entries[j].zone(curves_[j].upper, plan_.zone) : gap_[j].front();
    double low = first->lowest(), high = first->highest();
    for (const DistributionPtr& d : gap_[j]) {
      low = std::min(low, d->lowest());
      high = std::max(high, d->highest());
    }
    gaps.push_back(highest ? high : low);
  }
  return gaps;
}

void Allocating::compare() {
  progress("worst case and root-sum-square", 0.85);
  const double limit = working_limit(plan_.requirement.limit);
  const auto finish = [&](Allocation& a, const std::string& name) {
    a.judged_by = name;
    if (a.choice.empty() && a.tolerance.empty()) {
      a.choice = tightest_;
      use_steps(a);
      a.price = price_of_set(a);
    }
    evaluate(a);
  };
  if (plan_.is_continuous()) {
    const auto take = [&](Allocation& a, const ToleranceRequirement& requirement, const std::string& name) {
      const ContinuousAllocation c = allocate_continuous(curves_, requirement, limit);
      a.feasible = c.feasible;
      a.finished = c.converged;
      a.tolerance = c.tolerance;
      a.price = c.price;
      finish(a, name);
    };
    // What scatters beside: zones about its middle, as those of errors.
    ZonePlaces places = places_, largest = places_;
    std::vector<double> width, none(beside_.size(), 0.0);
    for (const std::vector<double>& values : beside_) {
      const auto [middle, half] = middle_and_half(values);
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      places.least.push_back(middle);
      largest.least.push_back(std::max(std::abs(*low), std::abs(*high)));
      for (ZonePlaces* of : {&places, &largest}) of->centred.push_back(true);
      width.push_back(2.0 * half);
    }
    take(result_.worst_case, with_fixed(worst_case_tolerances(deviation_, largest), none), "worst case");
    take(result_.root_sum_square,
         with_fixed(root_sum_square_tolerances(deviation_, places, plan_.requirement.probability), width),
         "root-sum-square");
    return;
  }
  const auto take = [&](Allocation& a, const AllocationRequirement& requirement, const std::string& name, bool exact) {
    const DiscreteAllocation d = allocate_discrete(price_, tightest_, requirement, {.most_nodes = 100'000});
    a.feasible = d.feasible;
    a.finished = d.proven;
    a.proven = d.proven && exact && is_exact();
    a.choice = d.choice;
    if (d.feasible) use_steps(a);
    a.price = d.feasible ? d.price : 0.0;
    a.nodes = d.nodes;
    finish(a, name);
  };
  take(result_.worst_case, WorstCaseRequirement(deviation_, gap_, limit, beside_), "worst case", true);
  take(result_.root_sum_square,
       RootSumSquareRequirement(deviation_, gap_, plan_.requirement.probability, limit, places_.centred, beside_),
       "root-sum-square", false);
}

void Allocating::share_out() {
  const Allocation& a = result_.chosen;
  std::vector<double> variance(plan_.entries.size()), mean(variance), slope(variance),
      g(variance.size() + beside_.size());
  const auto gaps = gaps_of(a, unit_, plan_.samples);
  for (std::size_t j = 0; j < mean.size(); ++j) {
    for (const auto& c : gaps) mean[j] += c[j] / static_cast<double>(gaps.size());
    for (const auto& c : gaps) variance[j] += (c[j] - mean[j]) * (c[j] - mean[j]);
  }
  // Squares of slopes, averaged over the samples: at the middle of all zones errors have none, being as likely to point
  // better as worse.
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    std::vector<double> c = gaps[k];
    for (const std::vector<double>& of_input : beside_) c.push_back(of_input[k]);
    deviation_.index(c, g);
    for (std::size_t j = 0; j < slope.size(); ++j) slope[j] += g[j] * g[j];
  }
  double sum = 0.0;
  for (std::size_t j = 0; j < mean.size(); ++j) sum += variance[j] *= slope[j];
  for (std::size_t j = 0; j < plan_.entries.size(); ++j) {
    AllocationShare share;
    share.joint = plan_.entries[j].name();
    if (plan_.entries[j].is_continuous()) {
      share.price = curves_[j].cost.price(a.tolerance[j]);
    } else {
      const auto o = static_cast<std::size_t>(a.choice[j]);
      share.option = plan_.entries[j].options[o].name;
      share.price = price_[j][o];
      // The dearest among the cheaper ones.
      double next = -1.0;
      for (const double p : price_[j])
        if (p < share.price) next = std::max(next, p);
      if (next >= 0.0) share.next_saving = share.price - next;
    }
    share.cost_share = a.price > 0.0 ? share.price / a.price : 0.0;
    share.error_share = sum > 0.0 ? variance[j] / sum : 0.0;
    result_.shares.push_back(share);
  }
}

void Allocating::price_front() {
  const double limit = plan_.requirement.limit;
  const auto priced = [&](double at) {
    const Allocation a = cheapest(at);
    return CostPoint{at, a.price, a.feasible};
  };
  progress("the price of the last micrometre", 0.9);
  const Allocation here = cheapest(limit, result_.chosen.choice);
  const CostPoint tighter = priced(limit - kLastMicro);
  result_.last_micrometre =
      tighter.feasible && here.feasible ? tighter.price - here.price : std::numeric_limits<double>::quiet_NaN();
  // From the least reachable to where the cheapest of all meets it.
  Allocation tight = best_like(here), wide = here;
  for (std::size_t j = 0; j < plan_.entries.size(); ++j) {
    if (plan_.entries[j].is_continuous()) wide.tolerance[j] = curves_[j].upper;
    if (plan_.is_continuous()) continue;
    wide.choice[j] = static_cast<int>(std::min_element(price_[j].begin(), price_[j].end()) - price_[j].begin());
  }
  evaluate(tight);
  evaluate(wide);
  result_.front.push_back({limit, here.price, here.feasible});
  for (int k = 0; k < plan_.front; ++k) {
    progress("front of cost against accuracy", 0.9 + 0.1 * k / plan_.front);
    const double share = plan_.front == 1 ? 0.5 : static_cast<double>(k) / (plan_.front - 1);
    // A hair wider than the ends, so that rounding does not make them unreachable.
    result_.front.push_back(
        priced((tight.reached + share * std::max(0.0, wide.reached - tight.reached)) * (1.0 + 1e-9)));
  }
  std::sort(result_.front.begin(), result_.front.end(),
            [](const CostPoint& l, const CostPoint& r) { return l.limit < r.limit; });
}

}  // namespace boresight
