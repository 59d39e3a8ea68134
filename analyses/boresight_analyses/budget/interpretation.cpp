#include "boresight_analyses/budget/interpretation.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "boresight_analyses/budget/value_of_rank.hpp"
#include "boresight_analyses/statistics/betting_mean.hpp"
#include "boresight_analyses/statistics/binomial.hpp"
#include "boresight_analyses/statistics/bounded_mean.hpp"
#include "boresight_analyses/statistics/independent_samples.hpp"

namespace boresight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Of the least value with at least this share at or below it, counted from zero.
std::size_t rank_of(std::size_t values, double share) {
  const auto n = static_cast<double>(values);
  return static_cast<std::size_t>(std::clamp(std::ceil(share * n * (1.0 - 1e-12)), 1.0, n)) - 1;
}

double quantile_of(const std::vector<double>& ascending, double share) {
  return ascending[rank_of(ascending.size(), share)];
}

double share_at_or_below(const std::vector<double>& ascending, double limit) {
  return static_cast<double>(std::upper_bound(ascending.begin(), ascending.end(), limit) - ascending.begin()) /
         static_cast<double>(ascending.size());
}

}  // namespace

const char* to_string(Interpretation interpretation) {
  static const char* const names[] = {"ensemble", "temporal", "mixed"};
  return names[static_cast<int>(interpretation)];
}

AskedShare asked_of_members(Interpretation interpretation, double probability, double confidence, double leave_out) {
  const bool of_members = interpretation == Interpretation::temporal && leave_out > 0.0;
  return {of_members ? 1.0 - leave_out : probability, confidence};
}

LookedAt looked_at_members(Interpretation interpretation, double leave_out) {
  using Sample = LookedAt::Sample;
  Sample sample = Sample::hit_or_miss;
  if (interpretation == Interpretation::mixed) sample = Sample::share;
  if (interpretation == Interpretation::temporal && leave_out == 0.0) sample = Sample::no_miss_allowed;
  return {.sample = sample, .name = "members"};
}

EnsembleInTime::EnsembleInTime(std::vector<std::vector<double>> sizes, std::int64_t failed)
    : sizes_(std::move(sizes)), failed_(failed) {
  if (sizes_.empty() || sizes_.front().empty()) throw std::invalid_argument("no member has values");
  for (std::vector<double>& member : sizes_) {
    if (member.size() != sizes_.front().size()) throw std::invalid_argument("members of unequal length");
    std::sort(member.begin(), member.end());
    maxima_.push_back(member.back());
  }
}

EnsembleInTime EnsembleInTime::raised(const std::vector<double>& by) const {
  if (by.size() != sizes_.size()) throw std::invalid_argument("as many rises as members");
  EnsembleInTime out;
  out.sizes_ = sizes_;
  out.failed_ = failed_;
  for (std::size_t k = 0; k < by.size(); ++k) {
    for (double& size : out.sizes_[k]) size += by[k];
    out.maxima_.push_back(out.sizes_[k].back());
  }
  return out;
}

double EnsembleInTime::pooled_quantile(double share) const {
  return value_of_rank(sizes_, rank_of(sizes_.size() * sizes_.front().size(), share));
}

const EnsembleInTime::Pool& EnsembleInTime::pool() const {
  std::call_once(pool_->made, [&] {
    std::vector<std::pair<double, std::uint32_t>> all;
    all.reserve(sizes_.size() * sizes_.front().size());
    for (std::uint32_t k = 0; k < sizes_.size(); ++k)
      for (const double value : sizes_[k]) all.emplace_back(value, k);
    // Members are in order already: neighbouring runs are merged until there is one.
    const auto at = [&](std::size_t i) { return all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), i)); };
    for (std::size_t run = sizes_.front().size(); run < all.size(); run *= 2)
      for (std::size_t first = 0; first + run < all.size(); first += 2 * run)
        std::inplace_merge(at(first), at(first + run), at(first + 2 * run));
    for (const auto& [value, member] : all) {
      pool_->values.push_back(value);
      pool_->owner.push_back(member);
    }
  });
  return *pool_;
}

double EnsembleInTime::resampled_level(Interpretation interpretation, double probability, double leave_out,
                                       const std::vector<std::uint32_t>& times) const {
  const double drawn = static_cast<double>(std::accumulate(times.begin(), times.end(), std::uint64_t{0}));
  // From the end that is nearer.
  const auto at_share = [](auto&& values, auto&& count_of, double all, double share) {
    const double wanted = share * all * (1.0 - 1e-12);
    if (share < 0.5) {
      double below = 0.0;
      for (std::size_t i = 0; i < values.size(); ++i)
        if ((below += count_of(i)) >= wanted && count_of(i) > 0.0) return values[i];
      return values.back();
    }
    double up_to = all, level = values.back();
    for (std::size_t i = values.size(); i-- > 0 && up_to >= wanted;) {
      const double count = count_of(i);
      if (count > 0.0) level = values[i];
      up_to -= count;
    }
    return level;
  };
  if (interpretation == Interpretation::mixed)
    return at_share(
        pool().values, [&](std::size_t i) { return static_cast<double>(times[pool().owner[i]]); },
        drawn * static_cast<double>(sizes_.front().size()), probability);
  const bool ensemble = interpretation == Interpretation::ensemble;
  std::vector<std::pair<double, std::uint32_t>> members;
  const std::vector<double> of_member = ensemble ? maxima_ : quantiles_in_time(probability);
  for (std::uint32_t k = 0; k < of_member.size(); ++k) members.emplace_back(of_member[k], k);
  std::sort(members.begin(), members.end());
  std::vector<double> values;
  for (const auto& [value, k] : members) values.push_back(value);
  return at_share(
      values, [&](std::size_t i) { return static_cast<double>(times[members[i].second]); }, drawn,
      ensemble ? probability : 1.0 - leave_out);
}

std::vector<double> EnsembleInTime::quantiles_in_time(double probability) const {
  std::vector<double> quantiles;
  for (const std::vector<double>& member : sizes_) quantiles.push_back(quantile_of(member, probability));
  return quantiles;
}

ReportedInterval EnsembleInTime::level(Interpretation interpretation, double probability, double confidence,
                                       double leave_out) const {
  if (interpretation == Interpretation::ensemble)
    return reported(IndependentSamples(maxima_, failed_).quantile(probability, confidence));
  if (interpretation == Interpretation::temporal) {
    const IndependentSamples worst(quantiles_in_time(probability), failed_);
    if (leave_out > 0.0) return reported(worst.quantile(1.0 - leave_out, confidence));
    const double value = worst.sorted().back();
    const auto all = static_cast<double>(members() + failed_);
    char basis[120];
    std::snprintf(basis, sizeof basis, "the worst of the members seen; at most %.3g %% of all are worse",
                  100.0 * (1.0 - std::pow(1.0 - confidence, 1.0 / all)));
    return {value,
            value,
            kInfinity,
            confidence,
            confidence,
            false,
            failed_ > 0 ? "the worst of the members seen, failed ones left out" : basis,
            Independent::name};
  }
  // The bounds hold for any share; the levels at the shares seen there are the interval.
  const double side = 0.5 * (1.0 + confidence), all = static_cast<double>(members() + failed_);
  const double seen = static_cast<double>(members()) / all;
  const double high = mean_that_shows(probability, all, side) / seen;                   // failed ones above
  const double low = (mean_that_denies(probability, all, side) - (1.0 - seen)) / seen;  // failed ones below
  return {pooled_quantile(probability),
          low > 0.0 ? pooled_quantile(low) : 0.0,
          high <= 1.0 ? pooled_quantile(high) : kInfinity,
          confidence,
          confidence,
          false,
          "Hoeffding's bound of the members' shares of the time",
          Independent::name};
}

MemberInterval EnsembleInTime::about_level(Interpretation interpretation, double probability, double confidence,
                                           double leave_out) const {
  if (interpretation != Interpretation::mixed) {
    const ReportedInterval of = level(interpretation, probability, confidence, leave_out);
    const bool worst_seen = interpretation == Interpretation::temporal && leave_out == 0.0;
    return {of.low, worst_seen ? of.value : of.high};
  }
  // Woodruff's interval: the levels at the shares that the level's own share may be (J. Am. Stat. Assoc. 47, 1952).
  const auto n = static_cast<double>(members());
  if (members() < static_cast<std::int64_t>(MemberBootstrap::kFewest)) return {};
  const double value = pooled_quantile(probability);
  double sum = 0.0, squares = 0.0;
  for (const std::vector<double>& member : sizes_) {
    const double share = share_at_or_below(member, value);
    sum += share;
    squares += share * share;
  }
  const double mean = sum / n, variance = std::max(0.0, squares / n - mean * mean) / (n - 1.0);
  const double reach =
      quantile(complement(boost::math::students_t(n - 1.0), 0.5 * (1.0 - confidence))) * std::sqrt(variance);
  return {probability > reach ? pooled_quantile(probability - reach) : 0.0,
          probability + reach < 1.0 ? pooled_quantile(probability + reach) : kInfinity};
}

double EnsembleInTime::share_of_members_shown(std::int64_t hits, const Judgement& judgement) const {
  const std::int64_t all = members() + failed_;
  return judgement.by == Judgement::By::any_time ? betting_share_lower(hits, all, judgement.confidence)
                                                 : clopper_pearson_lower(hits, all, judgement.confidence);
}

EnsembleInTime::Compliance EnsembleInTime::compliance(Interpretation interpretation, double limit, double probability,
                                                      const Judgement& judgement, double leave_out) const {
  using By = Judgement::By;
  const std::int64_t all = members() + failed_;
  const AskedShare asked = asked_of_members(interpretation, probability, judgement.confidence, leave_out);
  std::vector<double> shares;  // of the time, per member that did not fail
  for (const std::vector<double>& member : sizes_) shares.push_back(share_at_or_below(member, limit));
  Compliance c;
  c.fewest = fewest_samples(asked, judgement);
  if (interpretation == Interpretation::mixed) {
    // Members are of equal length.
    c.share = std::accumulate(shares.begin(), shares.end(), 0.0) / static_cast<double>(all);
    if (judgement.by == By::any_time)
      c.shown = betting_lower(shares, failed_, judgement.confidence);
    else if (judgement.by == By::first_bet)
      c.shown = first_bet_lower(static_cast<std::int64_t>(judgement.first), shares, 0, failed_, judgement.confidence);
    else
      c.shown = bounded_mean_lower(c.share, static_cast<double>(all), judgement.confidence);
  } else if (interpretation == Interpretation::ensemble) {
    const auto hits = std::count_if(maxima_.begin(), maxima_.end(), [&](double m) { return m <= limit; });
    c.share = static_cast<double>(hits) / static_cast<double>(all);
    c.shown = share_of_members_shown(hits, judgement);
  } else {
    const auto hits = std::count_if(shares.begin(), shares.end(), [&](double s) { return s >= probability; });
    shares.insert(shares.end(), static_cast<std::size_t>(failed_), 0.0);
    std::sort(shares.begin(), shares.end());
    const auto left_out = static_cast<std::size_t>(std::floor(leave_out * static_cast<double>(all)));
    c.share = shares[std::min(left_out, shares.size() - 1)];
    // With an exception the answer is no, and what is shown is all that is left to say of a later look.
    const bool no_answer = leave_out == 0.0 && hits < all;
    Judgement shown_by = judgement;
    if (no_answer && judgement.first > 0) shown_by.by = By::any_time;
    c.shown = share_of_members_shown(hits, shown_by);
    c.met = !no_answer && judgement.by != By::nothing && c.shown >= asked.probability;
    return c;
  }
  c.met = judgement.by != By::nothing && c.shown >= asked.probability;
  return c;
}

EnsembleInTime::Compliance EnsembleInTime::compliance(Interpretation interpretation, double limit, double probability,
                                                      double confidence, double leave_out) const {
  return compliance(interpretation, limit, probability, Judgement{.confidence = confidence, .why = ""}, leave_out);
}

}  // namespace boresight
