#include "boresight_analyses/montecarlo/estimates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>

#include "boresight_analyses/statistics/betting_mean.hpp"
#include "boresight_analyses/statistics/binomial.hpp"
#include "boresight_analyses/statistics/independent_samples.hpp"
#include "boresight_analyses/statistics/replicated_samples.hpp"

namespace boresight {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

ReportedInterval too_few(double confidence) {
  return {kNaN, kNaN, kNaN, confidence, kNaN, false, "too few samples", ""};
}

template <typename Samples>
ReportedInterval headline_interval(const Samples& samples, const Headline& headline, double confidence) {
  try {
    if (headline.probability > 0.0) return reported(samples.quantile(headline.probability, confidence));
    return std::string(headline.name) == "mean" ? reported(samples.mean(confidence)) : reported(samples.sd(confidence));
  } catch (const std::invalid_argument&) {
    return too_few(confidence);
  }
}

// A two-sided interval at 2 c - 1 is made of two one-sided bounds at c.
template <typename Samples>
ReportedInterval probability_interval(const Samples& samples, double limit, const Judgement& judgement) {
  const double confidence = 2.0 * judgement.confidence - 1.0;
  try {
    return reported(samples.probability_below(limit, confidence));
  } catch (const std::invalid_argument&) {
    return too_few(confidence);
  }
}

ReportedInterval probability_interval(const IndependentSamples& samples, double limit, const Judgement& judgement) {
  if (judgement.by != Judgement::By::any_time || samples.count() == 0)
    return probability_interval<IndependentSamples>(samples, limit, judgement);
  const std::int64_t hits =
      std::upper_bound(samples.sorted().begin(), samples.sorted().end(), limit) - samples.sorted().begin();
  ReportedInterval i = reported(samples.probability_below(limit, 2.0 * judgement.confidence - 1.0));
  i.low = betting_share_lower(hits, samples.count(), judgement.confidence);
  i.high = betting_share_upper(hits, samples.count(), judgement.confidence);
  i.basis = "confidence sequence by betting over " + std::to_string(samples.count()) + " independent samples";
  if (samples.failed() > 0) i.basis += ", " + std::to_string(samples.failed()) + " failed counted as bad";
  return i;
}

// Calls ask(IndependentSamples or ReplicatedSamples), whichever the design makes.
template <typename Ask>
ReportedInterval with_samples(const std::vector<double>& values, std::uint64_t count, const MonteCarloPlan& plan,
                              double confidence, const Ask& ask) {
  const SamplingDesign design(plan.design, static_cast<int>(plan.inputs.size()));
  const std::uint64_t n = design.whole_points(count);
  try {
    if (plan.design.kind == SamplingKind::random) {
      std::vector<double> done;
      done.reserve(n);
      for (std::uint64_t k = 0; k < n; ++k)
        if (!std::isnan(values[k])) done.push_back(values[k]);
      const auto failed = static_cast<std::int64_t>(n - done.size());
      return ask(IndependentSamples(std::move(done), failed));
    }
    const std::uint64_t replicates = design.whole_replicates(n);
    std::vector<std::vector<double>> done(replicates);
    std::vector<std::int64_t> failed(replicates, 0);
    for (std::uint64_t k = 0; k < n; ++k) {
      const std::uint64_t r = design.replicate_of(k);
      if (std::isnan(values[k]))
        ++failed[r];
      else
        done[r].push_back(values[k]);
    }
    return ask(ReplicatedSamples(std::move(done), std::move(failed)));
  } catch (const std::invalid_argument&) {
    return too_few(confidence);
  }
}

const Headline& headline_called(const std::string& name) {
  for (const Headline& h : headlines())
    if (name == h.name) return h;
  throw std::out_of_range("no estimate is called " + name);
}

ErrorStatement error_of(const NamedEstimate& e, const ModelError& model) {
  ErrorStatement s;
  s.of = e.name;
  const double size = std::abs(e.interval.value);
  const double low = e.interval.value - e.interval.low, high = e.interval.high - e.interval.value;
  s.sampling.value = std::max(low, high);  // infinite where the samples do not bound it
  s.sampling.relative = size > 0.0 ? s.sampling.value / size : 0.0;
  s.sampling.why = "the wider side of its interval: " + e.interval.basis;
  s.discretisation = {model.discretisation * size, model.discretisation, model.discretisation_why};
  const auto own = model.rung_of.find(e.name);
  const double rung = own != model.rung_of.end() ? own->second : model.rung;
  s.rung = {rung * size, rung, model.rung_why};
  // What was not measured does not stand first.
  const double steps = std::isnan(model.discretisation) ? 0.0 : model.discretisation,
               left_out = std::isnan(rung) ? 0.0 : rung;
  s.dominant = s.sampling.relative >= std::max(steps, left_out) ? "sampling"
               : left_out >= steps                              ? "rung"
                                                                : "discretisation";
  return s;
}

// Of rung and steps together, relative; what was not measured is not in it.
class ErrorOfSamples {
 public:
  ErrorOfSamples(const std::string& headline, const ModelError& model) {
    if (const auto own = model.rung_of.find(headline); own != model.rung_of.end()) {
      alike_ = known(own->second);  // a pilot measures both at once
      return;
    }
    alike_ = known(model.discretisation);
    if (model.rung_of_sample.empty()) alike_ += known(model.rung);
    of_sample_ = &model.rung_of_sample;
    mean_ = alike_ + (of_sample_->empty() ? 0.0 : known(model.rung));
  }
  double mean() const { return std::max(alike_, mean_); }
  // As large as the samples may be.
  std::vector<double> added_to(std::vector<double> values) const {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double own = of_sample_ != nullptr && k < of_sample_->size() ? known((*of_sample_)[k]) : 0.0;
      values[k] += (alike_ + own) * std::abs(values[k]);
    }
    return values;
  }

 private:
  static double known(double error) { return std::isfinite(error) ? error : 0.0; }

  double alike_ = 0.0, mean_ = 0.0;
  const std::vector<double>* of_sample_ = nullptr;
};

// About ten numbers per decade, each of whole replicates.
std::vector<std::uint64_t> convergence_counts(std::uint64_t n, const MonteCarloPlan& plan) {
  const SamplingDesign design(plan.design, static_cast<int>(plan.inputs.size()));
  std::vector<std::uint64_t> counts;
  for (double at = 20.0; at < static_cast<double>(n); at *= std::pow(10.0, 0.1)) {
    const std::uint64_t whole = design.whole_points(static_cast<std::uint64_t>(at));
    if (whole > 0 && (counts.empty() || whole > counts.back())) counts.push_back(whole);
  }
  const std::uint64_t all = design.whole_points(n);
  if (all > 0 && (counts.empty() || all > counts.back())) counts.push_back(all);
  return counts;
}

}  // namespace

const NamedEstimate& Estimates::of(const std::string& name) const {
  for (const NamedEstimate& e : index)
    if (e.name == name) return e;
  throw std::out_of_range("no estimate is called " + name);
}

std::string headline_of(const MonteCarloPlan& plan) {
  if (!plan.requirement) return "p95";
  const Headline* nearest = nullptr;
  for (const Headline& h : headlines())
    if (h.probability > 0.0 &&
        (nearest == nullptr || std::abs(h.probability - plan.requirement->probability) <
                                   std::abs(nearest->probability - plan.requirement->probability)))
      nearest = &h;
  return nearest->name;
}

ReportedInterval estimate_of(const std::string& headline, const std::vector<double>& values, std::uint64_t count,
                             const MonteCarloPlan& plan, double confidence) {
  return with_samples(values, count, plan, confidence, [&](const auto& samples) {
    return headline_interval(samples, headline_called(headline), confidence);
  });
}

namespace {

// Of the estimate that a study stops by, as it was looked at: looks.hpp.
template <typename Samples>
ReportedInterval final_interval(const Samples& samples, const Headline& headline, const MonteCarloPlan& plan) {
  const double each = interval_confidence(plan, headline.name);
  ReportedInterval i = headline_interval(samples, headline, each);
  if (each == plan.confidence) return i;
  i.confidence = plan.confidence;
  char share[32];
  std::snprintf(share, sizeof share, "%.5g", 100.0 * each);
  i.basis += std::string(", at ") + share + " % so that it holds wherever the study might have stopped";
  return i;
}

}  // namespace

Estimates estimate(const std::vector<double>& values, const MonteCarloPlan& plan, const ModelError& model,
                   const std::optional<Judgement>& judgement) {
  Estimates result;
  const auto judged = [&] { return judgement ? *judgement : judgement_of(plan, values.size(), std::nullopt); };
  result.samples = values.size();
  result.failed = static_cast<std::uint64_t>(
      std::count_if(values.begin(), values.end(), [](double value) { return std::isnan(value); }));
  const auto ask_all = [&](const auto& samples) {
    for (const Headline& h : headlines()) result.index.push_back({h.name, final_interval(samples, h, plan)});
    if (plan.requirement) {
      const Requirement& asked = *plan.requirement;
      RequirementVerdict verdict;
      verdict.judgement = judged();
      verdict.probability = probability_interval(samples, asked.limit, verdict.judgement);
      const auto reaches = [&](const ReportedInterval& share) {
        return verdict.judgement.by != Judgement::By::nothing && share.low >= asked.probability;
      };
      verdict.met = verdict.met_by_samples = reaches(verdict.probability);
      const ErrorOfSamples error(headline_of(plan), model);
      verdict.model_error = error.mean();
      if (verdict.model_error > 0.0) {
        verdict.within_error = with_samples(
            error.added_to(values), values.size(), plan, plan.confidence,
            [&](const auto& raised) { return probability_interval(raised, asked.limit, verdict.judgement); });
        verdict.met = verdict.met && reaches(*verdict.within_error);
      }
      verdict.fewest_samples = fewest_samples(plan, verdict.judgement);
      result.requirement = verdict;
    }
    return ReportedInterval{};
  };
  with_samples(values, values.size(), plan, plan.confidence, ask_all);
  if (result.index.empty()) {
    for (const Headline& h : headlines()) result.index.push_back({h.name, too_few(plan.confidence)});
    if (plan.requirement)
      result.requirement = RequirementVerdict{
          .probability = too_few(plan.requirement->confidence),
          .judgement = judged(),
          .fewest_samples = fewest_samples(plan, {.confidence = plan.requirement->confidence, .why = ""})};
  }
  for (const NamedEstimate& e : result.index)
    if (std::isfinite(e.interval.value)) result.errors.push_back(error_of(e, model));
  result.headline = headline_of(plan);
  for (const std::uint64_t n : convergence_counts(values.size(), plan))
    result.convergence.push_back({n, estimate_of(result.headline, values, n, plan, plan.confidence)});
  return result;
}

}  // namespace boresight
