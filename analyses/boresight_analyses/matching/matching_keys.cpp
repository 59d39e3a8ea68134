#include "boresight_analyses/matching/matching_keys.hpp"

#include "boresight/io/names_of.hpp"
#include "boresight_analyses/matching/matching_plan.hpp"
#include "boresight_analyses/optimise/design_variable_keys.hpp"
#include "boresight_analyses/optimise/minimise.hpp"
#include "boresight_analyses/study/study_keys.hpp"

namespace boresight {
namespace {

Key measure_key(const char* name, const char* sentence) {
  std::vector<KeyChoice> choices;
  for (const MeasureName& measure : measure_names())
    choices.push_back({measure.name, measure.measure == Measure::index ? "the study's index" : measure.title});
  return keys::choice(name, choices).otherwise("index").says(sentence);
}

Key over_key() {
  return keys::choice("over", names_of(over_names()))
      .otherwise("nominal")
      .says(
          "What is made of the scatter: nominal values only, or mean, quantile or worst over the [[random]] "
          "parameters.");
}

Key probability_key() {
  static const MeasureChoice m;
  return keys::number("probability")
      .share()
      .otherwise(m.probability)
      .says("Probability of the quantile; with over = \"quantile\" only.");
}

}  // namespace

const KeyTable& match_keys() {
  using namespace keys;
  static const MatchingPlan p;
  static const KeyTable table_of_keys{
      .name = "match",
      .says =
          "Values of parameters within bounds that make an index, or a measure of the contacts, least (NLopt, Johnson "
          "2007).",
      .keys = {
          measure_key("minimise", "What is made least."), over_key(), probability_key(),
          integer("samples").counting(2.0, 1e6).otherwise(32.0).says(
              "Samples of each design, the same random numbers for all; where parameters scatter only."),
          seed_key(),
          integer("evaluations")
              .counting(1.0, 1e6)
              .otherwise(p.evaluations)
              .says("The most designs that the search of the whole box computes, and each descent."),
          number("tolerance")
              .share()
              .otherwise(p.tolerance)
              .says("Where a descent ends: change of the variables as a share of their ranges."),
          choice("global", global_algorithms())
              .otherwise("auto")
              .says("Search of the whole box, an algorithm of NLopt."),
          choice("local", local_algorithms())
              .otherwise("auto")
              .says("Descent from the best places, an algorithm of NLopt; slsqp and mma need the derivatives of a "
                    "nominal "
                    "index over contact numbers."),
          integer("map")
              .counting(0.0, 200.0)
              .except({1.0}, "0, or 2 to 200")
              .otherwise(p.map)
              .says("Points along each side of the objective's map in the report; 0: no map."),
          integer("front")
              .counting(0.0, 100.0)
              .otherwise(p.front)
              .says("Points sought on the front of accuracy against stability, besides those found anyway; 0: none."),
          integer("confirm").counting(2.0, 1e6).otherwise(64.0).says(
              "Samples, with another seed, that confirm the winner on the next rung up; where parameters scatter "
              "only."),
          tables("variable", design_variable_keys)
              .at_least_of(1, "at least one [[match.variable]] table: what may be chosen")
              .says("What may be chosen, one table each; at least one."),
          tables("constraint", match_constraint_keys)
              .sometimes("left out, the bounds of the variables are the only limits")
              .says("Limits on the index or on other measures, one table each.")}};
  return table_of_keys;
}

const KeyTable& match_constraint_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "match.constraint",
      .says = "A limit that a design shall keep.",
      .keys = {measure_key("measure", "What is limited."),
               value("at_most", "the measure").above(0.0, "more than 0").says("The limit."), over_key(),
               probability_key()}};
  return table_of_keys;
}

}  // namespace boresight
