#include "boresight_analyses/study/study_keys.hpp"

#include "boresight_analyses/study/index_choice.hpp"

namespace boresight {
namespace {

template <typename Names>
std::vector<KeyChoice> defined(const Names& names) {
  std::vector<KeyChoice> choices;
  for (const auto& entry : names) choices.push_back({entry.name, entry.definition});
  return choices;
}

}  // namespace

const KeyTable& study_keys() {
  using namespace keys;
  static const auto of_verb = [](const std::string& verb, const std::string& sentence) {
    return table(verb, nullptr).sometimes("needed by `" + verb + "`").for_verbs(verb).says(sentence);
  };
  static const std::string scattering = "montecarlo, sensitivity, match, allocate, budget";
  static const KeyTable table_of_keys{
      .name = "study",
      .says =
          "A study file: a question about a mechanism. One file may hold the tables of several verbs; each verb reads "
          "its own.",
      .keys = {
          integer("format").between(1, 1, "1").says("The version of this format."),
          text("mechanism").says("The mechanism file; a relative name is taken from the study file's folder."),
          quantity("accuracy", kRatio)
              .inside_of(0.0, 1.0, "more than 0 % and less than 100 %")
              .sometimes("left out, `--rung` decides, or multibody")
              .says("Relative accuracy wanted of the index; it chooses the cheapest rung that is shown to reach it."),
          table("index", index_keys)
              .sometimes("left out, the index is position_error.max")
              .says("The one number of a motion that the study is about."),
          tables("random", nullptr)
              .at_least_of(1, "at least one [[random]] table: what scatters, and how")
              .sometimes("needed where something scatters")
              .for_verbs(scattering)
              .says("The parameters that scatter, one table each."),
          tables("correlation", nullptr)
              .sometimes("left out, all scatter independently")
              .for_verbs(scattering)
              .says("Pairs of parameters that depend on each other, one table each."),
          of_verb("sweep", "The index over a grid of parameters."), of_verb("montecarlo", "The index's distribution."),
          of_verb("sensitivity", "Which parameter's scatter matters."),
          of_verb("match", "Which parameters make an index, or the time in free flight, least."),
          of_verb("allocate", "Which fits or tolerances meet a requirement at least cost."),
          of_verb("calibrate", "Contact parameters from measured pointing data."),
          of_verb("budget", "The pointing budget: APE, MPE, RPE, PDE and PRE."),
          table("chart", nullptr)
              .sometimes("never needed")
              .for_verbs("chart")
              .says("Nothing is read from it: `chart` takes index and accuracy from the file and the rest from its "
                    "options.")}};
  return table_of_keys;
}

const KeyTable& index_keys() {
  using namespace keys;
  static const IndexChoice i;
  static const KeyTable table_of_keys{
      .name = "index",
      .says = "The one number of a motion that the study is about: a pointing error and its statistic over time.",
      .keys = {choice("quantity", defined(quantity_names())).otherwise(i.quantity.c_str()).says("The pointing error."),
               choice("statistic", defined(statistic_names()))
                   .otherwise(i.statistic.c_str())
                   .says("Its statistic over the time of the motion."),
               quantity("start", kDuration)
                   .at_least(0.0, "a time of zero or more")
                   .otherwise(i.start)
                   .says("What the motion does before is left out, such as the fall of journals that start centred.")}};
  return table_of_keys;
}

Key seed_key() {
  return keys::integer("seed")
      .at_least(0.0, "a whole number, 0 or more")
      .otherwise(1.0)
      .says(
          "Seed of the random numbers: the same seed gives the same results, bit for bit, with any number of threads.");
}

Key confidence_key(double otherwise) {
  return keys::number("confidence").share().otherwise(otherwise).says("Confidence of all intervals.");
}

Key parameter_key(const std::string& sentence) {
  return keys::texts("parameter").or_single().at_least_of(1, "a parameter's path, or a list of them").says(sentence);
}

}  // namespace boresight
