#include "boresight_analyses/montecarlo/looks.hpp"

#include <cstdio>

#include "boresight_analyses/montecarlo/montecarlo.hpp"
#include "boresight_analyses/statistics/unseen_share.hpp"

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

std::int64_t fewest_samples(const MonteCarloPlan& plan, const Judgement& judgement) {
  const AskedShare asked = asked_share_of(plan);
  const auto show = [&](std::uint64_t replicates, std::uint64_t size) {
    return 1.0 - unseen_share(static_cast<std::int64_t>(replicates), static_cast<double>(size),
                              1.0 - judgement.confidence) >=
           asked.probability;
  };
  switch (plan.design.kind) {
    case SamplingKind::random:
      break;
    case SamplingKind::lhs: {
      std::uint64_t few = 1, many = 2;  // hypercubes
      while (!show(many, plan.design.strata)) {
        few = many;
        many *= 2;
      }
      while (many - few > 1) {
        const std::uint64_t middle = few + (many - few) / 2;
        (show(middle, plan.design.strata) ? many : few) = middle;
      }
      return static_cast<std::int64_t>(many * plan.design.strata);
    }
    case SamplingKind::sobol: {
      std::uint64_t size = 1;
      while (!show(plan.design.replicates, size)) size *= 2;  // a net of another size loses part of its balance
      return static_cast<std::int64_t>(plan.design.replicates * size);
    }
  }
  return fewest_samples(asked, judgement);
}

double interval_confidence(const MonteCarloPlan& plan, const std::string& headline) {
  if (!(plan.stop.width > 0.0) || headline != plan.stop.of) return plan.confidence;
  return 1.0 - (1.0 - plan.confidence) / static_cast<double>(stopping_points(plan).size());
}

}  // namespace boresight
