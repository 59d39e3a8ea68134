#include "boresight_analyses/allocation/allocation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "boresight_analyses/allocation/gap_requirements.hpp"
#include "boresight_analyses/statistics/binomial.hpp"

namespace boresight {
namespace {

constexpr std::size_t kTrialSamples = 12;  // that the first factor is taken from
constexpr double kMicro = 1e-6;
constexpr double kPower = 0.8;  // the chance that a set which the search accepts is confirmed

// How many of the search's samples may exceed the limit: no more than shows the requirement, and so few that
// `confirm` fresh samples of such a set show it with a chance of kPower. (They are fewer, and leave less
// room: a set that 1000 samples show just so would mostly be refuted by 120 fresh ones.)
std::int64_t allowed_in_search(const AllocationPlan& plan) {
  const auto samples = static_cast<std::int64_t>(plan.samples),
             confirm = static_cast<std::int64_t>(plan.confirm);
  const Requirement& r = plan.requirement;
  const std::int64_t shown = allowed_failures(samples, r.probability, r.confidence);
  const std::int64_t fresh = allowed_failures(confirm, r.probability, confirmation_confidence(r));
  if (shown < 0 || fresh < 0) return -1;
  // The share q of bad ones with P(at most `fresh` of `confirm` are bad) = kPower.
  const double q = clopper_pearson_upper(fresh, confirm, 1.0 - kPower);
  return std::min(shown, static_cast<std::int64_t>(std::floor(q * static_cast<double>(samples))));
}

class Allocating {
 public:
  Allocating(const AllocationPlan& plan, const LinearDeviation& deviation, const AllocationOptions& options)
      : plan_(plan),
        deviation_(deviation),
        options_(options),
        unit_(unit_samples(plan.joints.size() + plan.scattered(), plan.samples, plan.seed)),
        allowed_(allowed_in_search(plan)) {
    for (const AllocationJoint& joint : plan.joints) {
      price_.emplace_back();
      gap_.emplace_back();
      for (const AllocationOption& o : joint.options) {
        price_.back().push_back(o.price);
        gap_.back().push_back(o.gap);
      }
      least_.push_back(joint.least);
      curves_.push_back(joint.curve);
      if (plan.is_continuous()) {
        const DistributionPtr zone = make_zone(0.0, 1.0, plan.zone);
        auto& z = z_.emplace_back();
        for (const double u : unit_[z_.size() - 1]) z.push_back(zone->quantile(u));
      }
    }
    if (!plan.is_continuous()) {
      tightest_ = tightest_options(gap_);
      statistical_ =
          std::make_unique<StatisticalRequirement>(deviation_, gap_, unit_, allowed_, plan.requirement.limit);
    }
  }

  AllocationResult run(double misfit, const ConfirmingModel& confirm, const std::string& rung) {
    result_.misfit = misfit;
    try {
      search_rounds(confirm, rung);
      compare();
      if (result_.feasible) {
        share_out();
        price_front();
      }
    } catch (const EvaluationInterrupted&) {
      result_.interrupted = true;
      result_.converged = false;
    }
    return result_;
  }

 private:
  void progress(const std::string& stage, double share) const {
    if (options_.interrupted && options_.interrupted()) throw EvaluationInterrupted{};
    if (options_.progress) options_.progress(stage, share);
  }
  double working_limit(double limit) const { return limit / result_.factor; }

  // The cheapest set by the samples of the search, for a limit on the confirming rung's scale.
  Allocation cheapest(double limit, const std::vector<int>& start = {}) {
    const auto began = std::chrono::steady_clock::now();
    Allocation a;
    a.judged_by = "samples";
    if (plan_.is_continuous()) {
      const ContinuousAllocation c = allocate_continuous(
          curves_, statistical_tolerances(deviation_, least_, z_, allowed_), working_limit(limit));
      a.feasible = c.feasible;
      a.finished = c.converged;
      a.tolerance = c.tolerance;
      a.price = c.price;
      a.why = c.why;
    } else {
      statistical_->set_limit(working_limit(limit));
      DiscreteAllocationOptions o;
      o.start = start;
      o.progress = [this](const DiscreteAllocation&) {
        return !(options_.interrupted && options_.interrupted());
      };
      const DiscreteAllocation d = allocate_discrete(price_, tightest_, *statistical_, o);
      if (options_.interrupted && options_.interrupted()) throw EvaluationInterrupted{};
      a.feasible = d.feasible;
      a.finished = a.proven = d.proven;
      a.choice = d.feasible ? d.choice : tightest_;
      a.price = price_of(price_, a.choice);
      a.nodes = d.nodes;
      a.why = "branch and bound over all sets of options";
    }
    judge(a);
    result_.search_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    return a;
  }

  // Gaps of a set at these coordinates: [sample][joint].
  std::vector<std::vector<double>> gaps_of(const Allocation& a, const UnitSamples& unit,
                                           std::size_t count) const {
    std::vector<std::vector<double>> gaps(count, std::vector<double>(plan_.joints.size()));
    for (std::size_t j = 0; j < plan_.joints.size(); ++j) {
      const DistributionPtr d = a.tolerance.empty() ? gap_[j][static_cast<std::size_t>(a.choice[j])]
                                                    : make_zone(least_[j], a.tolerance[j], plan_.zone);
      for (std::size_t k = 0; k < count; ++k) gaps[k][j] = d->quantile(unit[j][k]);
    }
    return gaps;
  }

  // By the samples of the search, on the confirming rung's scale.
  void judge(Allocation& a) const {
    std::vector<double> values;
    for (const auto& gaps : gaps_of(a, unit_, plan_.samples))
      values.push_back(result_.factor * deviation_.index(gaps));
    std::sort(values.begin(), values.end(), std::greater<>());
    const auto above = std::count_if(values.begin(), values.end(),
                                     [&](double v) { return v > plan_.requirement.limit * (1.0 + 1e-9); });
    a.share_within = 1.0 - static_cast<double>(above) / static_cast<double>(values.size());
    a.reached =
        allowed_ < 0 ? std::numeric_limits<double>::infinity() : values[static_cast<std::size_t>(allowed_)];
    a.meets = above <= allowed_failures(static_cast<std::int64_t>(values.size()),
                                        plan_.requirement.probability, plan_.requirement.confidence);
  }

  // The other random parameters of the same samples: [sample][parameter], coordinates.
  std::vector<std::vector<double>> others_of(const UnitSamples& unit, std::size_t count) const {
    std::vector<std::vector<double>> others(count, std::vector<double>(plan_.scattered()));
    for (std::size_t k = 0; k < count; ++k)
      for (std::size_t i = 0; i < others[k].size(); ++i) others[k][i] = unit[plan_.joints.size() + i][k];
    return others;
  }

  // `factor`: what these samples say that it should be.
  AllocationConfirmation confirmed(const Allocation& a, const ConfirmingModel& confirm,
                                   const std::string& rung, double& factor) const {
    const double confidence = confirmation_confidence(plan_.requirement);
    const std::uint64_t seed = confirmation_seed(plan_.seed, result_.confirmations.size());
    const UnitSamples unit = unit_samples(plan_.joints.size() + plan_.scattered(), plan_.confirm, seed);
    const auto gaps = gaps_of(a, unit, plan_.confirm);
    AllocationConfirmation c = confirmation_of(values_of(confirm(gaps, others_of(unit, plan_.confirm))),
                                               plan_.requirement, confidence);
    c.rung = rung;
    c.seed = seed;
    c.factor = result_.factor;
    c.price = a.price;
    std::vector<double> linear;
    for (const auto& g : gaps) linear.push_back(deviation_.index(g));
    factor = c.reached / shown_limit(linear, plan_.requirement.probability, confidence);
    // Far below the limit is a disagreement too: a cheaper set may do.
    c.agrees = c.met && c.reached > (1.0 - options_.accuracy) * std::min(plan_.requirement.limit, a.reached);
    char text[400];
    std::snprintf(text, sizeof text,
                  "%zu fresh samples of the %s rung with seed %llu: %.4g %% within the limit, at least %.4g %% "
                  "with %.4g %% confidence (%g %% over the %d confirmations that a search may take); %s",
                  c.samples, rung.c_str(), static_cast<unsigned long long>(c.seed), 100.0 * c.share_within,
                  100.0 * c.share_low, 100.0 * confidence, 100.0 * plan_.requirement.confidence,
                  kMostConfirmations,
                  c.met ? (c.agrees ? "the requirement is met" : "the requirement is met with room to spare")
                        : "the requirement is not shown to be met");
    c.sentence = text;
    return c;
  }

  // The factor from a few samples of the rung on the gaps of one set: the mean ratio on the very same gaps.
  void find_first_factor(const Allocation& a, const ConfirmingModel& confirm) {
    const auto gaps = gaps_of(a, unit_, kTrialSamples);
    const std::vector<double> values = values_of(confirm(gaps, others_of(unit_, kTrialSamples)));
    double sum = 0.0, linear = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (std::isfinite(values[k])) {
        sum += values[k];
        linear += deviation_.index(gaps[k]);
      }
    if (linear > 0.0) result_.factor = sum / linear;
  }

  void search_rounds(const ConfirmingModel& confirm, const std::string& rung) {
    progress("searching", 0.0);
    Allocation a = cheapest(plan_.requirement.limit);
    progress("trying the rung " + rung, 0.1);
    find_first_factor(a, confirm);
    for (int round = 0; round < kMostRounds; ++round) {
      progress("searching", 0.2 + 0.15 * round);
      a = cheapest(plan_.requirement.limit, a.feasible ? a.choice : std::vector<int>{});
      // A set that was refuted is not asked again: its index is taken for larger until another one is found.
      constexpr double kFurther = 1.005;
      while (a.feasible && !result_.confirmations.empty() && !result_.confirmations.back().met &&
             same(a, refuted_)) {
        result_.factor *= kFurther;
        a = cheapest(plan_.requirement.limit);
      }
      if (!a.feasible) break;
      if (result_.feasible && !(a.price < result_.chosen.price * (1.0 - 1e-9)) &&
          !result_.confirmations.back().agrees) {
        // Nothing cheaper under the corrected factor than what was confirmed already.
        result_.confirmations.back().sentence += ", but no cheaper set can be shown";
        result_.confirmations.back().agrees = true;
        break;
      }
      progress("confirming on the rung " + rung, 0.25 + 0.15 * round);
      double factor = 1.0;
      AllocationConfirmation c = confirmed(a, confirm, rung, factor);
      const bool go_on = !c.agrees && round + 1 < kMostRounds && std::isfinite(factor);
      if (!c.met) refuted_ = a;
      if (c.met && (!result_.feasible || a.price < result_.chosen.price)) {
        result_.feasible = true;
        result_.chosen = a;
      }
      // What costs less and was refuted leaves others between the two.
      if (!c.met && result_.feasible && !go_on) result_.chosen.proven = result_.chosen.finished = false;
      if (go_on) c.sentence += "; the search goes on with its factor";
      result_.confirmations.push_back(c);
      if (!go_on) break;
      result_.factor = factor;
    }
    if (!result_.feasible) {
      try_what_points_best(a, confirm, rung);
      return;
    }
    judge(result_.chosen);
    result_.converged = result_.chosen.finished;
  }

  // The linear deviation is that of journals at rest, which may be far off the confirming rung: before nothing is
  // said to do, the tightest gaps are tried on that rung itself; and where a wider gap may point better, what the
  // samples of the search find to point best. `a`: what the search found last.
  void try_what_points_best(const Allocation& a, const ConfirmingModel& confirm, const std::string& rung) {
    std::vector<Allocation> tries = {tightest_like(a)};
    if (Allocation best = best_like(a); !same(best, tries.front())) tries.push_back(best);
    result_.best_reachable = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < tries.size(); ++i) {
      const std::string which = i == 0 ? "the tightest gaps" : "the gaps that point best";
      progress("trying " + which + " on the rung " + rung, 0.8);
      Allocation tried = tries[i];
      judge(tried);
      double factor = 1.0;
      AllocationConfirmation c = confirmed(tried, confirm, rung, factor);
      c.sentence += ", with " + which;
      if (c.met) {
        tried.why = which + ", tried on the confirming rung; the linear deviation had found nothing";
        c.agrees = true;
        c.sentence += "; the linear deviation is off by too much here to show anything cheaper";
        result_.factor = std::isfinite(factor) ? factor : result_.factor;
        judge(tried);
        tried.feasible = result_.feasible = true;
        result_.chosen = tried;
        result_.confirmations.push_back(c);
        return;
      }
      result_.confirmations.push_back(c);
      if (i == 0 || c.reached < result_.best_reachable) {
        result_.best_reachable = c.reached;
        result_.chosen = tried;
      }
    }
    result_.converged = !a.feasible && a.proven;
  }

  Allocation tightest_like(const Allocation& a) const {
    Allocation tight = a;
    tight.feasible = tight.proven = tight.finished = false;
    if (plan_.is_continuous()) {
      for (std::size_t j = 0; j < curves_.size(); ++j) tight.tolerance[j] = curves_[j].lower;
      tight.price = price_of(curves_, tight.tolerance);
    } else {
      tight.choice = tightest_;
      tight.price = price_of(price_, tightest_);
    }
    return tight;
  }

  // The set that reaches the least limit by the samples of the search, as far as changes of one joint at a time
  // find it; the tightest one where the index rises with every gap.
  Allocation best_like(const Allocation& a) const {
    Allocation best = tightest_like(a);
    if (allowed_ < 0 || deviation_.rises_with_every_gap(lowest_gap(), highest_gap())) return best;
    if (plan_.is_continuous()) {
      best.tolerance = least_tolerances(curves_, statistical_tolerances(deviation_, least_, z_, allowed_));
      best.price = price_of(curves_, best.tolerance);
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
    best.price = price_of(price_, best.choice);
    return best;
  }

  std::vector<double> lowest_gap() const { return extreme_gaps(false); }
  std::vector<double> highest_gap() const { return extreme_gaps(true); }
  std::vector<double> extreme_gaps(bool highest) const {
    std::vector<double> gaps;
    for (std::size_t j = 0; j < plan_.joints.size(); ++j) {
      double low = least_[j], high = least_[j] + curves_[j].upper;
      if (!gap_[j].empty()) {
        low = gap_[j].front()->lowest();
        high = gap_[j].front()->highest();
      }
      for (const DistributionPtr& d : gap_[j]) {
        low = std::min(low, d->lowest());
        high = std::max(high, d->highest());
      }
      gaps.push_back(highest ? high : low);
    }
    return gaps;
  }

  static bool same(const Allocation& a, const Allocation& b) {
    if (a.tolerance.empty()) return a.choice == b.choice;
    for (std::size_t j = 0; j < a.tolerance.size(); ++j)
      if (std::abs(a.tolerance[j] - b.tolerance[j]) > 1e-3 * a.tolerance[j]) return false;
    return true;
  }

  // What the two classical ways of judging choose for the same limit, and how that fares by the samples.
  void compare() {
    progress("worst case and root-sum-square", 0.85);
    const double limit = working_limit(plan_.requirement.limit);
    const auto finish = [&](Allocation& a, const std::string& name) {
      a.judged_by = name;
      if (a.choice.empty() && a.tolerance.empty()) {
        a.choice = tightest_;
        if (!plan_.is_continuous()) a.price = price_of(price_, a.choice);
      }
      judge(a);
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
      take(result_.worst_case, worst_case_tolerances(deviation_, least_), "worst case");
      take(result_.root_sum_square,
           root_sum_square_tolerances(deviation_, least_, plan_.requirement.probability), "root-sum-square");
      return;
    }
    const auto take = [&](Allocation& a, const AllocationRequirement& requirement, const std::string& name,
                          bool exact) {
      const DiscreteAllocation d = allocate_discrete(price_, tightest_, requirement, {.most_nodes = 100'000});
      a.feasible = d.feasible;
      a.finished = d.proven;
      a.proven = d.proven && exact;
      a.choice = d.choice;
      a.price = d.feasible ? d.price : 0.0;
      a.nodes = d.nodes;
      finish(a, name);
    };
    take(result_.worst_case, WorstCaseRequirement(deviation_, gap_, limit), "worst case", true);
    take(result_.root_sum_square,
         RootSumSquareRequirement(deviation_, gap_, plan_.requirement.probability, limit), "root-sum-square",
         false);
  }

  void share_out() {
    const Allocation& a = result_.chosen;
    std::vector<double> variance(plan_.joints.size()), mean(plan_.joints.size()), g(plan_.joints.size());
    const auto gaps = gaps_of(a, unit_, plan_.samples);
    for (std::size_t j = 0; j < mean.size(); ++j) {
      for (const auto& c : gaps) mean[j] += c[j] / static_cast<double>(gaps.size());
      for (const auto& c : gaps) variance[j] += (c[j] - mean[j]) * (c[j] - mean[j]);
    }
    deviation_.index(mean, g);
    double sum = 0.0;
    for (std::size_t j = 0; j < mean.size(); ++j) sum += variance[j] *= g[j] * g[j];
    for (std::size_t j = 0; j < plan_.joints.size(); ++j) {
      AllocationShare share;
      share.joint = plan_.joints[j].name();
      if (plan_.is_continuous()) {
        share.price = curves_[j].cost.price(a.tolerance[j]);
      } else {
        const auto o = static_cast<std::size_t>(a.choice[j]);
        share.option = plan_.joints[j].options[o].name;
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

  void price_front() {
    const double limit = plan_.requirement.limit;
    const auto priced = [&](double at) {
      const Allocation a = cheapest(at);
      return CostPoint{at, a.price, a.feasible};
    };
    progress("the price of the last micrometre", 0.9);
    const Allocation here = cheapest(limit, result_.chosen.choice);
    const CostPoint tighter = priced(limit - kMicro);
    result_.last_micrometre = tighter.feasible && here.feasible ? tighter.price - here.price
                                                                : std::numeric_limits<double>::quiet_NaN();
    // From the least reachable to where the cheapest of all meets it.
    Allocation tight = best_like(here), wide = here;
    for (std::size_t j = 0; j < plan_.joints.size(); ++j) {
      if (plan_.is_continuous()) {
        wide.tolerance[j] = curves_[j].upper;
        continue;
      }
      wide.choice[j] =
          static_cast<int>(std::min_element(price_[j].begin(), price_[j].end()) - price_[j].begin());
    }
    judge(tight);
    judge(wide);
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

  const AllocationPlan& plan_;
  const LinearDeviation& deviation_;
  const AllocationOptions& options_;
  UnitSamples unit_;
  std::int64_t allowed_;
  std::vector<std::vector<double>> price_;
  std::vector<std::vector<DistributionPtr>> gap_;
  std::vector<int> tightest_;
  std::vector<double> least_;
  std::vector<ContinuousJoint> curves_;
  std::vector<std::vector<double>> z_;
  std::unique_ptr<StatisticalRequirement> statistical_;
  Allocation refuted_;
  AllocationResult result_;
};

}  // namespace

AllocationResult run_allocation(const AllocationPlan& plan, const LinearDeviation& deviation, double misfit,
                                const ConfirmingModel& confirm, const std::string& rung,
                                const AllocationOptions& options) {
  return Allocating(plan, deviation, options).run(misfit, confirm, rung);
}

}  // namespace boresight
