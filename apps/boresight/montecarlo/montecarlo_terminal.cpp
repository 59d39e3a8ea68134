#include "montecarlo/montecarlo_terminal.hpp"

#include <fmt/format.h>

#include <cmath>

#include "boresight_analyses/statistics/binomial.hpp"
#include "results/assumed.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {

void announce(const MonteCarloQuestion& question, const RungChoice& choice, bool accuracy_asked, std::uint64_t stored,
              int ranks) {
  const MonteCarloPlan& plan = question.plan;
  tell("{}: {} samples ({}), {} random parameters{}{}\n", question.mechanism->name(), plan.samples, plan.design.text(),
       plan.inputs.size(), stored > 0 ? fmt::format(", {} of them stored already", stored) : "",
       ranks > 1 ? fmt::format(", on {} ranks", ranks) : "");
  if (choice.pilot) {
    const double study = static_cast<double>(plan.samples) * choice.pilot->trials[choice.pilot->chosen].cpu_seconds;
    tell("  rung: {}, {}\n  the pilot took {} of CPU, the study will take about {}\n", choice.name, choice.why,
         readable(choice.pilot->cpu_seconds, "s"), readable(study, "s"));
  } else if (accuracy_asked) {
    tell("  rung: {}, {}\n", choice.name, choice.why);
  }
  if (plan.requirement && plan.design.kind != SamplingKind::random) {
    tell("  to show {:g} % with {:g} % confidence takes {} samples of this design if none is above the limit\n",
         100.0 * plan.requirement->probability, 100.0 * plan.requirement->confidence,
         fewest_samples(plan, {.confidence = plan.requirement->confidence, .why = ""}));
  } else if (plan.requirement) {
    const auto fewest = [&](std::int64_t above) {
      return wilks_one_sided(plan.requirement->probability, plan.requirement->confidence, above);
    };
    tell(
        "  to show {:g} % with {:g} % confidence takes {} independent samples if none is above the limit, {} if one "
        "is, "
        "{} if two are (Wilks)\n",
        100.0 * plan.requirement->probability, 100.0 * plan.requirement->confidence, fewest(0), fewest(1), fewest(2));
  }
  std::fflush(stdout);
}

void show(Stage& stage, const MonteCarloProgress& p, const MonteCarloQuestion& question) {
  const std::string& unit = question.study.index.si_unit();
  std::string estimate;
  const std::string name = headline_of(question.plan);
  for (const Headline& h : headlines())
    if (name == h.name && p.done > p.failed) {
      try {
        const IndependentInterval i = p.running->quantile(h.probability, question.plan.confidence);
        estimate = name + " " + readable_as(i.value, unit, written_unit(question.plan));
        // Order statistics are for independent samples only.
        if (question.plan.design.kind == SamplingKind::random)
          estimate += " (" + readable_interval(reported(i), unit, written_unit(question.plan)) + ")";
      } catch (const std::invalid_argument&) {
      }
    }
  if (p.failed > 0) estimate += fmt::format(", {} failed", p.failed);
  stage.update(static_cast<double>(p.begun_with), static_cast<double>(p.done), estimate);
}

void print(const MonteCarloStudy& s, const OutputDirectory& out) {
  const std::string &unit = s.study.index.si_unit(), written = written_unit(s.plan);
  tell("{}: {} samples on the {} rung, {} failed; {}; index: {}\n", s.mechanism.name(), s.estimates.samples,
       s.rung.name, s.estimates.failed, to_string(s.result.ended), s.study.index.title());
  for (const NamedEstimate& e : s.estimates.index)
    if (std::isfinite(e.interval.value))
      tell("  {:<8} {:>12}   ({} at {} confidence)\n", e.name, readable_as(e.interval.value, unit, written),
           readable_interval(e.interval, unit, written), readable_share(s.plan.confidence));
  for (const ErrorStatement& e : s.estimates.errors)
    if (e.of == s.estimates.headline)
      tell(
          "  {} is uncertain by sampling {}, discretisation {}, rung {}: {} dominates\n", e.of,
          std::isfinite(e.sampling.relative) ? readable_error(e.sampling.relative) : "more than these samples can tell",
          std::isfinite(e.discretisation.relative) ? readable_error(e.discretisation.relative) : "not measured",
          readable_error(e.rung.relative), e.dominant);
  if (s.estimates.requirement) tell("  {}\n", verdict_sentence(s));
  tell_warnings(s.warnings, s.command, s.mechanism);
  tell("  report: {}\n", (out.path() / "report.html").string());
}

}  // namespace boresight::app
