#include "boresight_analyses/allocation/allocation.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "boresight/pointing/relative_text.hpp"
#include "boresight_analyses/allocation/allocating.hpp"
#include "boresight_analyses/statistics/binomial.hpp"

namespace boresight {
namespace {

constexpr std::size_t kTrialSamples = 12;  // that the first factor is taken from
constexpr double kPower = 0.8;             // the chance that a set which the search accepts is confirmed
// What a search may take: nodes, each of which asks all samples about all entries, and bounds all entries by all. Twelve
// joints are proven long before (a tenth of it); fifty are not proven anyway, and what is found late gains little.
constexpr double kMostWork = 6e9;
// Of a tolerance with a cost curve, beside entries that have options: each 1.17 times as wide as the one before where the
// widest is ten times the tightest.
constexpr std::size_t kSteps = 16;

// How many of the search's samples may exceed the limit: no more than shows the requirement, and so few that
// `confirm` fresh samples of such a set show it with a chance of kPower. (They are fewer, and leave less
// room: a set that 1000 samples show just so would mostly be refuted by 120 fresh ones.)
std::int64_t allowed_in_search(const AllocationPlan& plan) {
  const auto samples = static_cast<std::int64_t>(plan.samples), confirm = static_cast<std::int64_t>(plan.confirm);
  const Requirement& r = plan.requirement;
  const std::int64_t shown = allowed_failures(samples, r.probability, r.confidence);
  const std::int64_t fresh = allowed_failures(confirm, r.probability, confirmation_confidence(r));
  if (shown < 0 || fresh < 0) return -1;
  // The share q of bad ones with P(at most `fresh` of `confirm` are bad) = kPower.
  const double q = clopper_pearson_upper(fresh, confirm, 1.0 - kPower);
  return std::min(shown, static_cast<std::int64_t>(std::floor(q * static_cast<double>(samples))));
}

}  // namespace

Allocating::Allocating(const AllocationPlan& plan, const LinearDeviation& deviation, const AllocationOptions& options)
    : plan_(plan),
      deviation_(deviation),
      options_(options),
      unit_(unit_samples(plan.entries.size() + plan.scattered(), plan.samples, plan.seed)),
      beside_(beside_of(unit_, plan.samples)),
      allowed_(allowed_in_search(plan)) {
  for (const AllocationEntry& entry : plan.entries) {
    price_.emplace_back();
    gap_.emplace_back();
    step_.emplace_back();
    for (const AllocationOption& o : entry.options) {
      price_.back().push_back(o.price);
      gap_.back().push_back(o.gap);
    }
    curves_.push_back(entry.curve);
    auto& z = z_.emplace_back();
    if (!entry.is_continuous()) continue;
    const DistributionPtr zone = make_zone(entry.is_error ? -0.5 : 0.0, 1.0, plan.zone);
    for (const double u : unit_[z_.size() - 1]) z.push_back(zone->quantile(u));
    if (plan.is_continuous()) continue;
    for (std::size_t s = 0; s < kSteps; ++s) {
      const double share = static_cast<double>(s) / (kSteps - 1);
      const double t = entry.curve.lower * std::pow(entry.curve.upper / entry.curve.lower, share);
      step_.back().push_back(t);
      price_.back().push_back(entry.curve.cost.price(t));
      gap_.back().push_back(entry.zone(t, plan.zone));
    }
  }
  places_ = plan.zone_places();
  if (!plan.is_continuous()) {
    tightest_ = tightest_options(gap_);
    statistical_ =
        std::make_unique<StatisticalRequirement>(deviation_, gap_, unit_, allowed_, plan.requirement.limit, beside_);
  }
}

AllocationResult Allocating::run(double misfit, const ConfirmingModel& confirm, const std::string& rung) {
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

void Allocating::progress(const std::string& stage, double share) const {
  if (options_.interrupted && options_.interrupted()) throw EvaluationInterrupted{};
  if (options_.progress) options_.progress(stage, share);
}

bool Allocating::is_exact() const {
  return !plan_.has_curves() && plan_.scattered() == plan_.linear_inputs.size() && result_.misfit <= kMostMisfit;
}

double Allocating::price_of_set(const Allocation& a) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < plan_.entries.size(); ++j)
    sum += plan_.entries[j].is_continuous() ? curves_[j].cost.price(a.tolerance[j])
                                            : price_[j][static_cast<std::size_t>(a.choice[j])];
  return sum;
}

void Allocating::use_steps(Allocation& a) const {
  a.tolerance.clear();
  if (!plan_.has_curves()) return;
  for (std::size_t j = 0; j < step_.size(); ++j)
    a.tolerance.push_back(step_[j].empty() ? 0.0 : step_[j][static_cast<std::size_t>(a.choice[j])]);
}

void Allocating::refine(Allocation& a, double limit) const {
  // Entries with options: gaps that are what they are, times a tolerance of one.
  std::vector<double> least(places_.least), whole(a.tolerance);
  std::vector<std::vector<double>> z(z_);
  std::vector<std::size_t> open;
  std::vector<ContinuousTolerance> curves;
  for (std::size_t j = 0; j < z.size(); ++j) {
    if (plan_.entries[j].is_continuous()) {
      open.push_back(j);
      curves.push_back(curves_[j]);
      continue;
    }
    least[j] = 0.0;
    whole[j] = 1.0;
    for (const double u : unit_[j]) z[j].push_back(gap_[j][static_cast<std::size_t>(a.choice[j])]->quantile(u));
  }
  const ToleranceRequirement of_all = statistical(std::move(least), std::move(z));
  std::vector<double> slope(whole.size());
  const ToleranceRequirement of_open = [&](std::span<const double> t, std::span<double> gradient) {
    for (std::size_t i = 0; i < open.size(); ++i) whole[open[i]] = t[i];
    const double value = of_all(whole, gradient.empty() ? std::span<double>() : std::span<double>(slope));
    for (std::size_t i = 0; i < gradient.size(); ++i) gradient[i] = slope[open[i]];
    return value;
  };
  const ContinuousAllocation c = allocate_continuous(curves, of_open, working_limit(limit));
  a.finished = a.finished && c.converged;
  Allocation better = a;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const std::vector<double>& steps = step_[open[i]];
    better.tolerance[open[i]] = c.tolerance[i];
    // The widest step within it: where the next search begins.
    const auto above = std::upper_bound(steps.begin(), steps.end(), c.tolerance[i]);
    better.choice[open[i]] = std::max(0, static_cast<int>(above - steps.begin()) - 1);
  }
  better.price = price_of_set(better);
  if (c.feasible && better.price < a.price) a = better;
}

Allocation Allocating::cheapest(double limit, const std::vector<int>& start) {
  const auto began = std::chrono::steady_clock::now();
  Allocation a;
  a.judged_by = "samples";
  if (plan_.is_continuous()) {
    const ContinuousAllocation c = allocate_continuous(curves_, statistical(places_.least, z_), working_limit(limit));
    a.feasible = c.feasible;
    a.finished = c.converged;
    a.tolerance = c.tolerance;
    a.price = c.price;
    a.why = c.why;
  } else {
    statistical_->set_limit(working_limit(limit));
    DiscreteAllocationOptions o;
    const auto entries = static_cast<double>(plan_.entries.size()), all = entries + static_cast<double>(beside_.size());
    o.most_nodes = static_cast<std::int64_t>(kMostWork / (static_cast<double>(plan_.samples) * entries * all)) + 1;
    o.start = start;
    o.progress = [this](const DiscreteAllocation&) { return !(options_.interrupted && options_.interrupted()); };
    const DiscreteAllocation d = allocate_discrete(price_, tightest_, *statistical_, o);
    if (options_.interrupted && options_.interrupted()) throw EvaluationInterrupted{};
    a.feasible = d.feasible;
    a.finished = d.proven;
    a.proven = d.proven && is_exact();
    a.choice = d.feasible ? d.choice : tightest_;
    use_steps(a);
    a.price = price_of_set(a);
    a.nodes = d.nodes;
    a.why = "branch and bound over all sets of options";
    if (plan_.has_curves()) {
      a.why += ", tolerances with cost curves in " + std::to_string(kSteps) + " steps; then these by descent";
      if (d.feasible) refine(a, limit);
    } else if (d.feasible) {
      a.bound = is_exact() ? d.bound : 0.0;
    }
  }
  evaluate(a);
  result_.search_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return a;
}

DistributionPtr Allocating::zone_of(const Allocation& a, std::size_t j) const {
  return plan_.entries[j].is_continuous() ? plan_.entries[j].zone(a.tolerance[j], plan_.zone)
                                          : gap_[j][static_cast<std::size_t>(a.choice[j])];
}

std::vector<std::vector<double>> Allocating::gaps_of(const Allocation& a, const UnitSamples& unit,
                                                     std::size_t count) const {
  std::vector<std::vector<double>> gaps(count, std::vector<double>(plan_.entries.size()));
  for (std::size_t j = 0; j < plan_.entries.size(); ++j) {
    // Of the search's own samples they are known: a fit's quantiles are integrals.
    if (&unit == &unit_ && !plan_.entries[j].is_continuous()) {
      for (std::size_t k = 0; k < count; ++k) gaps[k][j] = statistical_->gap(j, a.choice[j], k);
      continue;
    }
    const DistributionPtr d = zone_of(a, j);
    for (std::size_t k = 0; k < count; ++k) gaps[k][j] = d->quantile(unit[j][k]);
  }
  return gaps;
}

BesideValues Allocating::beside_of(const UnitSamples& unit, std::size_t count) const {
  BesideValues beside(plan_.linear_inputs.size(), std::vector<double>(count));
  if (beside.empty()) return beside;
  std::vector<std::vector<double>> others = others_of(unit, count);
  for (std::size_t k = 0; k < count; ++k) {
    plan_.inputs->values(others[k]);
    for (std::size_t i = 0; i < beside.size(); ++i) beside[i][k] = others[k][plan_.linear_inputs[i]];
  }
  return beside;
}

std::vector<double> Allocating::linear_of(const std::vector<std::vector<double>>& gaps,
                                          const BesideValues& beside) const {
  std::vector<double> values, c;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    c = gaps[k];
    for (const std::vector<double>& of_input : beside) c.push_back(of_input[k]);
    values.push_back(deviation_.index(c));
  }
  return values;
}

ToleranceRequirement Allocating::statistical(std::vector<double> least, std::vector<std::vector<double>> z) const {
  // What scatters beside: values that are what they are, times a tolerance of one.
  least.resize(least.size() + beside_.size(), 0.0);
  z.insert(z.end(), beside_.begin(), beside_.end());
  return with_fixed(statistical_tolerances(deviation_, std::move(least), std::move(z), allowed_),
                    std::vector<double>(beside_.size(), 1.0));
}

void Allocating::evaluate(Allocation& a) const {
  std::vector<double> values = linear_of(gaps_of(a, unit_, plan_.samples), beside_);
  for (double& value : values) value *= result_.factor;
  std::sort(values.begin(), values.end(), std::greater<>());
  const auto above =
      std::count_if(values.begin(), values.end(), [&](double v) { return v > plan_.requirement.limit * (1.0 + 1e-9); });
  a.share_within = 1.0 - static_cast<double>(above) / static_cast<double>(values.size());
  a.reached = allowed_ < 0 ? std::numeric_limits<double>::infinity() : values[static_cast<std::size_t>(allowed_)];
  a.meets = above <= allowed_failures(static_cast<std::int64_t>(values.size()), plan_.requirement.probability,
                                      plan_.requirement.confidence);
}

std::vector<std::vector<double>> Allocating::others_of(const UnitSamples& unit, std::size_t count) const {
  std::vector<std::vector<double>> others(count, std::vector<double>(plan_.scattered()));
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < others[k].size(); ++i) others[k][i] = unit[plan_.entries.size() + i][k];
  return others;
}

AllocationConfirmation Allocating::confirmed(const Allocation& a, const ConfirmingModel& confirm,
                                             const std::string& rung, double& factor) const {
  const double confidence = confirmation_confidence(plan_.requirement);
  const std::uint64_t seed = confirmation_seed(plan_.seed, result_.confirmations.size());
  const UnitSamples unit = unit_samples(plan_.entries.size() + plan_.scattered(), plan_.confirm, seed);
  const auto gaps = gaps_of(a, unit, plan_.confirm);
  const std::vector<Outcome> outcomes = confirm(gaps, others_of(unit, plan_.confirm));
  AllocationConfirmation c = confirmation_of(values_of(outcomes), plan_.requirement, confidence);
  c.model_error = model_error_of(outcomes);
  c.rung = rung;
  c.seed = seed;
  c.factor = result_.factor;
  c.price = a.price;
  const std::vector<double> linear = linear_of(gaps, beside_of(unit, plan_.confirm));
  factor = c.reached / shown_limit(linear, plan_.requirement.probability, confidence);
  // Far below the limit is a disagreement too: a cheaper set may do.
  c.agrees = c.met && c.reached > (1.0 - options_.accuracy) * std::min(plan_.requirement.limit, a.reached);
  char text[400];
  std::snprintf(text, sizeof text,
                "%zu fresh samples of the %s rung with seed %llu: %.4g %% within the limit, at least %.4g %% "
                "with %.4g %% confidence (%g %% over the %d confirmations that a search may take); %s",
                c.samples, rung.c_str(), static_cast<unsigned long long>(c.seed), 100.0 * c.share_within,
                100.0 * c.share_low, 100.0 * confidence, 100.0 * plan_.requirement.confidence, kMostConfirmations,
                c.met ? (c.agrees ? "the requirement is met" : "the requirement is met with room to spare")
                      : "the requirement is not shown to be met");
  c.sentence = text;
  constexpr double kWorthSaying = 0.005;
  if (c.model_error > kWorthSaying)
    c.sentence += " (each sample counted as larger by what the rung may leave out, on average by " +
                  relative_text(c.model_error) + ")";
  return c;
}

void Allocating::find_first_factor(const Allocation& a, const ConfirmingModel& confirm) {
  const auto trial = std::min(kTrialSamples, plan_.samples);
  const auto gaps = gaps_of(a, unit_, trial);
  const std::vector<double> values = values_of(confirm(gaps, others_of(unit_, trial)));
  const std::vector<double> linear_values = linear_of(gaps, beside_);
  double sum = 0.0, linear = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (std::isfinite(values[k])) {
      sum += values[k];
      linear += linear_values[k];
    }
  if (linear > 0.0) result_.factor = sum / linear;
}

void Allocating::search_rounds(const ConfirmingModel& confirm, const std::string& rung) {
  progress("searching", 0.0);
  Allocation a = cheapest(plan_.requirement.limit);
  progress("trying the rung " + rung, 0.1);
  find_first_factor(a, confirm);
  for (int round = 0; round < kMostRounds; ++round) {
    progress("searching", 0.2 + 0.15 * round);
    a = cheapest(plan_.requirement.limit, a.feasible ? a.choice : std::vector<int>{});
    // A set that was refuted, in whichever round, is not asked again: its index is taken for larger until another one is found.
    constexpr double kFurther = 1.005;
    bool further = false;
    while (a.feasible && refutation_of(a) != nullptr) {
      further = true;
      result_.factor *= kFurther;
      a = cheapest(plan_.requirement.limit);
    }
    if (result_.feasible && !(a.feasible && a.price < result_.chosen.price * (1.0 - kRoundingOfPrices)) &&
        !result_.confirmations.back().agrees) {
      // Nothing cheaper under the corrected factor than what was confirmed already.
      AllocationConfirmation& last = result_.confirmations.back();
      last.sentence +=
          last.met ? ", but no cheaper set can be shown" : "; nothing between it and the set confirmed before is left";
      last.agrees = last.met;
      // Under a factor that no samples asked for that is no proof.
      if (further) {
        result_.chosen.proven = false;
        result_.chosen.bound = 0.0;
      }
      break;
    }
    if (!a.feasible) break;
    progress("confirming on the rung " + rung, 0.25 + 0.15 * round);
    double factor = 1.0;
    AllocationConfirmation c = confirmed(a, confirm, rung, factor);
    const bool go_on = !c.agrees && round + 1 < kMostRounds && std::isfinite(factor);
    if (!c.met) refuted_.push_back({a, result_.confirmations.size()});
    if (c.met && (!result_.feasible || a.price < result_.chosen.price)) {
      result_.feasible = true;
      result_.chosen = a;
      result_.confirmed_by = result_.confirmations.size();
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
  evaluate(result_.chosen);
  result_.converged = result_.chosen.finished;
}

bool Allocating::same(const Allocation& a, const Allocation& b) {
  if (a.tolerance.empty()) return a.choice == b.choice;
  for (std::size_t j = 0; j < a.tolerance.size(); ++j) {
    if (std::abs(a.tolerance[j] - b.tolerance[j]) > 1e-3 * a.tolerance[j]) return false;
    const bool is_chosen = a.tolerance[j] == 0.0;  // among options
    if (is_chosen && a.choice[j] != b.choice[j]) return false;
  }
  return true;
}

const Allocating::Refuted* Allocating::refutation_of(const Allocation& a) const {
  for (const Refuted& refuted : refuted_)
    if (same(a, refuted.set)) return &refuted;
  return nullptr;
}

AllocationResult run_allocation(const AllocationPlan& plan, const LinearDeviation& deviation, double misfit,
                                const ConfirmingModel& confirm, const std::string& rung,
                                const AllocationOptions& options) {
  return Allocating(plan, deviation, options).run(misfit, confirm, rung);
}

}  // namespace boresight
