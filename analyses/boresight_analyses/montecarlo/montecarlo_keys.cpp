#include "boresight_analyses/montecarlo/montecarlo_keys.hpp"

#include "boresight/io/names_of.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/study/study_keys.hpp"

namespace boresight {
namespace {

constexpr double kMostPerReplicate = 1e6;

Key budget_key(const std::string& sentence) {
  return keys::quantity("budget", kDuration).above(0.0, "more than 0").says(sentence);
}

Key pilot_key(double otherwise, const std::string& sentence) {
  return keys::integer("pilot").counting(10.0, 1e5).otherwise(otherwise).says(sentence);
}

}  // namespace

const KeyTable& montecarlo_keys() {
  using namespace keys;
  static const MonteCarloPlan p;
  static const KeyTable table_of_keys{
      .name = "montecarlo",
      .says = "The index's distribution over the scatter of the [[random]] parameters, with confidence intervals.",
      .keys = {integer("samples")
                   .counting(1.0, kMostMonteCarloSamples)
                   .sometimes("needed, except with fidelities or tail, whose budget decides")
                   .says("Number of samples; given again with more, a study goes on where it was. Of lhs a multiple of "
                         "strata, of "
                         "sobol of replicates."),
               seed_key(),
               choice("design", std::vector<KeyChoice>{{to_string(SamplingKind::random), "independent samples"},
                                                       {to_string(SamplingKind::lhs),
                                                        "Latin hypercubes (McKay, Beckman, Conover 1979)"},
                                                       {to_string(SamplingKind::sobol), "scrambled Sobol' nets"}})
                   .otherwise(to_string(p.design.kind))
                   .says("How samples lie in the space of the random parameters."),
               integer("strata")
                   .counting(2.0, kMostPerReplicate)
                   .otherwise(static_cast<double>(p.design.strata))
                   .says("Samples of one Latin hypercube; with design = \"lhs\" only."),
               integer("replicates")
                   .counting(2.0, kMostPerReplicate)
                   .otherwise(static_cast<double>(p.design.replicates))
                   .says("Independent nets side by side, from which intervals come; with design = \"sobol\" only."),
               confidence_key(p.confidence),
               table("requirement", requirement_keys)
                   .sometimes("left out, nothing is required; needed with tail")
                   .says("What the index shall keep, and with which probability."),
               table("stop", stop_keys)
                   .sometimes("left out, the number of samples ends the study")
                   .says("When to stop before all samples are computed."),
               table("fidelities", fidelities_keys)
                   .sometimes("left out, all samples are of one rung")
                   .says("The mean from several rungs at once, most samples on the cheaper ones (Peherstorfer, "
                         "Willcox, Gunzburger "
                         "2016)."),
               table("tail", tail_keys)
                   .sometimes("left out, the excess is counted in plain samples")
                   .says("The probability of exceeding the requirement's limit where it is rare.")}};
  return table_of_keys;
}

const KeyTable& requirement_keys() {
  using namespace keys;
  static const Requirement r;
  static const KeyTable table_of_keys{
      .name = "requirement",
      .says = "A limit of the index that is kept with a probability, shown at a confidence.",
      .keys = {quantity_of("limit", "the index").above(0.0, "more than 0").says("What the index shall not exceed."),
               number("probability")
                   .share()
                   .otherwise(r.probability)
                   .says("Share of the mechanisms built that shall keep the limit."),
               number("confidence")
                   .share()
                   .above(0.5, "more than 0.5 and less than 1")
                   .otherwise(r.confidence)
                   .says("One-sided confidence at which that share is shown.")}};
  return table_of_keys;
}

const KeyTable& stop_keys() {
  using namespace keys;
  static const StopRule stop;
  static const KeyTable table_of_keys{
      .name = "montecarlo.stop",
      .says = "When to stop before all samples are computed: width, or time, or both.",
      .keys = {
          quantity("width", kRatio)
              .inside_of(0.0, 1.0, "more than 0 % and less than 100 %")
              .sometimes("this, or time, or both")
              .says("Stops where the half-width of an interval is this share of its estimate."),
          choice("of", names_of(headlines())).otherwise(stop.of.c_str()).says("The estimate whose interval is meant."),
          quantity("time", kDuration)
              .above(0.0, "more than 0")
              .sometimes("this, or width, or both")
              .says("Stops after this time on the clock.")}};
  return table_of_keys;
}

const KeyTable& fidelities_keys() {
  using namespace keys;
  static const FidelityQuestion q;
  static const KeyTable table_of_keys{
      .name = "montecarlo.fidelities",
      .says =
          "The mean for the first rung from few samples there and many on cheaper ones. With a requirement the first "
          "rung "
          "has as many as that takes to be shown at all, where the budget pays them.",
      .keys = {choices("models", rung_names(), "the name of a rung")
                   .at_least_of(2, "two rungs or more, the one to be unbiased for first")
                   .all_different()
                   .says("Two rungs or more; the mean is unbiased for the first one."),
               budget_key("CPU time of everything, the pilot included."),
               pilot_key(static_cast<double>(q.pilot),
                         "Samples on every rung that find how closely the cheaper ones follow the first.")}};
  return table_of_keys;
}

const KeyTable& tail_keys() {
  using namespace keys;
  static const TailQuestion q;
  static const KeyTable table_of_keys{
      .name = "montecarlo.tail",
      .says =
          "A rare excess: found on a cheap rung, measured there by importance sampling, corrected on the exact one.",
      .keys = {choice("cheap", rung_names())
                   .otherwise("perturbation")
                   .says("The rung on which the excess is looked for, if it costs less than the exact one."),
               choice("exact", rung_names())
                   .otherwise("multibody")
                   .says("The rung for which the probability is unbiased; another one than cheap."),
               budget_key("CPU time of the estimate; search and pilot come before it."),
               pilot_key(static_cast<double>(q.pilot),
                         "Samples on both rungs that decide how far to lean on the cheap one.")}};
  return table_of_keys;
}

}  // namespace boresight
