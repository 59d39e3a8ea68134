#include "boresight_analyses/montecarlo/looks.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdio>

#include "boresight_analyses/montecarlo/montecarlo.hpp"

namespace boresight {
namespace {

double risk(const Requirement& r) { return 1.0 - r.confidence; }

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

std::string question_of(const Requirement& r) {
  char text[96];
  std::snprintf(text, sizeof text, "first_look %.17g %.17g %.17g", r.limit, r.probability, r.confidence);
  return text;
}

double risk_of_a_look(const Requirement& r, std::uint64_t samples) {
  if (samples == 0) return 0.0;
  const boost::math::binomial bad(static_cast<double>(samples), 1.0 - r.probability);
  if (cdf(bad, 0.0) > risk(r)) return 0.0;  // too few to show anything
  // The largest count whose chance stays within the risk.
  double low = 0.0, high = static_cast<double>(samples);
  while (high - low > 1.0) {
    const double middle = std::floor(0.5 * (low + high));
    (cdf(bad, middle) <= risk(r) ? low : high) = middle;
  }
  return cdf(bad, low);
}

Judgement judgement_of(const MonteCarloPlan& plan, std::uint64_t samples, const std::optional<FirstLook>& first) {
  const Requirement& asked = *plan.requirement;
  const bool by_width = plan.stop.width > 0.0, independent = plan.design.kind == DesignKind::random;
  const Judgement plainly{Judgement::By::fixed_number, asked.confidence, ""};
  if (!first || first->samples == samples) {
    if (!independent && by_width)
      return {Judgement::By::fixed_number, 1.0 - risk(asked) / static_cast<double>(stopping_points(plan).size()),
              "judged at an equal part of the risk for each number of samples at which the study may end"};
    const bool sequence = first ? first->spent == 0.0 : by_width;
    if (!independent || !sequence) return plainly;
    return {Judgement::By::any_time, asked.confidence,
            "judged by a confidence sequence, as the samples decide how many there are"};
  }
  const double left = risk(asked) - first->spent;
  if (!independent || !(left > 1e-12))
    return {Judgement::By::nothing, asked.confidence,
            "judged at " + std::to_string(first->samples) +
                " samples before, which took the whole risk: another look shows nothing, another seed judges anew"};
  char share[32];
  std::snprintf(share, sizeof share, "%.3g", 100.0 * left);
  return {Judgement::By::any_time, 1.0 - left,
          "judged at " + std::to_string(first->samples) +
              " samples before; from then on by a confidence sequence with the risk that was left, " + share + " %"};
}

FirstLook first_look_of(const MonteCarloPlan& plan, std::uint64_t samples) {
  const Requirement& asked = *plan.requirement;
  if (plan.design.kind != DesignKind::random) return {samples, risk(asked)};
  return {samples, plan.stop.width > 0.0 ? 0.0 : risk_of_a_look(asked, samples)};
}

double interval_confidence(const MonteCarloPlan& plan, const std::string& headline) {
  if (!(plan.stop.width > 0.0) || headline != plan.stop.of) return plan.confidence;
  return 1.0 - (1.0 - plan.confidence) / static_cast<double>(stopping_points(plan).size());
}

}  // namespace boresight
