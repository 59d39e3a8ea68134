#include "boresight_analyses/statistics/looks.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdio>

#include "boresight_analyses/statistics/betting_mean.hpp"
#include "boresight_analyses/statistics/binomial.hpp"

namespace boresight {
namespace {

double risk(const AskedShare& asked) { return 1.0 - asked.confidence; }

bool can_show(const AskedShare& asked, std::uint64_t samples) {
  return static_cast<double>(samples) * std::log(asked.probability) <= std::log(risk(asked));
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100.0 * share);
  return text;
}

}  // namespace

std::string FirstLook::text() const {
  char text[64];
  std::snprintf(text, sizeof text, "%llu %.17g", static_cast<unsigned long long>(samples), spent);
  return text;
}

std::optional<FirstLook> FirstLook::parse(const std::string& text) {
  unsigned long long samples = 0;
  double spent = 0.0;
  if (std::sscanf(text.c_str(), "%llu %lg", &samples, &spent) != 2) return std::nullopt;
  return FirstLook{samples, spent};
}

double risk_of_a_look(const AskedShare& asked, std::uint64_t samples) {
  if (samples == 0) return 0.0;
  const boost::math::binomial bad(static_cast<double>(samples), 1.0 - asked.probability);
  if (cdf(bad, 0.0) > risk(asked)) return 0.0;  // too few to show anything
  // The largest count whose chance stays within the risk.
  double low = 0.0, high = static_cast<double>(samples);
  while (high - low > 1.0) {
    const double middle = std::floor(0.5 * (low + high));
    (cdf(bad, middle) <= risk(asked) ? low : high) = middle;
  }
  return cdf(bad, low);
}

Judgement judgement_of(const AskedShare& asked, const LookedAt& at, std::uint64_t samples,
                       const std::optional<FirstLook>& first) {
  using By = Judgement::By;
  const bool again = first && first->samples != samples;
  const Judgement plainly{By::fixed_number, asked.confidence, "", again ? first->samples : 0};
  if (at.sample == LookedAt::Sample::no_miss_allowed) return plainly;
  if (!again) {
    if (!at.independent && at.by_width)
      return {By::fixed_number, 1.0 - risk(asked) / static_cast<double>(at.ends),
              "judged at an equal part of the risk for each number of " + std::string(at.name) +
                  " at which the study may end"};
    const bool sequence = first ? first->spent == 0.0 && can_show(asked, samples) : at.by_width;
    if (!at.independent || !sequence) return plainly;
    return {By::any_time, asked.confidence,
            "judged by a confidence sequence, as the " + std::string(at.name) + " decide how many there are"};
  }
  const std::string before = "judged at " + std::to_string(first->samples) + " " + at.name + " before";
  if (at.sample == LookedAt::Sample::share && first->spent > 0.0)
    return {By::first_bet, asked.confidence,
            before + "; from then on by the bet that the first bound was, which holds at any time", first->samples};
  const double left = risk(asked) - first->spent;
  if (!at.independent || !(left > 1e-12))
    return {By::nothing, asked.confidence,
            before +
                ", which took the whole risk: another look shows nothing; another seed, in a folder of its own, judges "
                "anew",
            first->samples};
  return {By::any_time, 1.0 - left,
          before + "; from then on by a confidence sequence with the risk that was left, " + percent(left),
          first->samples};
}

FirstLook first_look_of(const AskedShare& asked, const LookedAt& at, std::uint64_t samples) {
  if (!at.independent) return {samples, risk(asked)};
  if (at.by_width) return {samples, 0.0};
  if (at.sample == LookedAt::Sample::share) return {samples, can_show(asked, samples) ? risk(asked) : 0.0};
  return {samples, risk_of_a_look(asked, samples)};
}

std::int64_t fewest_samples(const AskedShare& asked, const Judgement& judgement) {
  if (judgement.by == Judgement::By::first_bet) {
    const double stake =
        first_bet_stake(static_cast<std::int64_t>(judgement.first), asked.probability, judgement.confidence);
    const double gain = std::log1p(stake * (1.0 / asked.probability - 1.0));  // of each good one
    return static_cast<std::int64_t>(std::ceil(-std::log1p(-judgement.confidence) / gain));
  }
  if (judgement.by != Judgement::By::any_time) return wilks_one_sided(asked.probability, asked.confidence);
  const auto shows = [&](std::int64_t n) {
    return betting_share_lower(n, n, judgement.confidence) >= asked.probability;
  };
  std::int64_t few = 0, many = 1;
  while (!shows(many)) {
    few = many;
    many *= 2;
  }
  while (many - few > 1) {
    const std::int64_t middle = few + (many - few) / 2;
    (shows(middle) ? many : few) = middle;
  }
  return many;
}

}  // namespace boresight
