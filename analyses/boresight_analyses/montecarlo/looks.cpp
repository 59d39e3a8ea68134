#include "boresight_analyses/montecarlo/looks.hpp"

#include <cstdio>

#include "boresight_analyses/montecarlo/montecarlo.hpp"

namespace boresight {

std::string question_of(const Requirement& r) {
  char text[96];
  std::snprintf(text, sizeof text, "first_look %.17g %.17g %.17g", r.limit, r.probability, r.confidence);
  return text;
}

Judgement look(SampleStore& store, const std::string& question, const AskedShare& asked, const LookedAt& at,
               std::uint64_t samples) {
  const std::optional<FirstLook> first = FirstLook::parse(store.fact(question));
  if (!first && samples > 0) store.note(question, first_look_of(asked, at, samples).text());
  return judgement_of(asked, at, samples, first);
}

AskedShare asked_share_of(const MonteCarloPlan& plan) {
  return {plan.requirement->probability, plan.requirement->confidence};
}

LookedAt looked_at_of(const MonteCarloPlan& plan) {
  const bool by_width = plan.stop.width > 0.0;
  return {.independent = plan.design.kind == SamplingKind::random,
          .by_width = by_width,
          .ends = by_width ? stopping_points(plan).size() : 1};
}

Judgement judgement_of(const MonteCarloPlan& plan, std::uint64_t samples, const std::optional<FirstLook>& first) {
  return judgement_of(asked_share_of(plan), looked_at_of(plan), samples, first);
}

FirstLook first_look_of(const MonteCarloPlan& plan, std::uint64_t samples) {
  return first_look_of(asked_share_of(plan), looked_at_of(plan), samples);
}

double interval_confidence(const MonteCarloPlan& plan, const std::string& headline) {
  if (!(plan.stop.width > 0.0) || headline != plan.stop.of) return plan.confidence;
  return 1.0 - (1.0 - plan.confidence) / static_cast<double>(stopping_points(plan).size());
}

}  // namespace boresight
