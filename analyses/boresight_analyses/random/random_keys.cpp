#include "boresight_analyses/random/random_keys.hpp"

#include "boresight_analyses/random/read_rows.hpp"

namespace boresight {

const KeyTable& random_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "random",
      .says =
          "A parameter that scatters, several that scatter as one, two that are drawn as a point of a zone, or any "
          "number "
          "that are drawn as a row of a table.",
      .keys = {texts("parameter")
                   .or_single()
                   .at_least_of(1, "a parameter's path, or a list of them")
                   .sometimes("left out where parameters is given")
                   .says("The parameter's path, or a list of paths that all take the value drawn; `boresight paths` "
                         "lists them."),
               texts("parameters")
                   .at_least_of(1, "at least one parameter")
                   .all_different()
                   .sometimes("with a cylinder or rows only")
                   .says("The paths of parameters that are drawn together: two, as a point of a cylinder's cross "
                         "section, or any number, as a row of a table; parameter = [..] means the same there."),
               table("distribution", distribution_keys).says("How it scatters: exactly one distribution.")}};
  return table_of_keys;
}

const KeyTable& correlation_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "correlation",
      .says = "Two parameters that depend on each other, by a Gaussian copula: each keeps its own distribution.",
      .keys = {
          texts("parameters")
              .of_length({2}, "two parameters")
              .all_different()
              .says("The two parameters, each of a [[random]] table."),
          number("coefficient")
              .inside_of(-1.0, 1.0, "more than -1 and less than 1")
              .says("Their correlation, in the measure below."),
          choice("measure", std::vector<KeyChoice>{{"normal", "correlation of the normal scores behind the values"},
                                                   {"spearman",
                                                    "Spearman's rank correlation of the values; of values that come "
                                                    "back, as discrete ones do, it is less"},
                                                   {"kendall", "Kendall's tau of the values"}})
              .otherwise("normal")
              .says("What the coefficient measures.")}};
  return table_of_keys;
}

const KeyTable& groups_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "groups",
      .says = "Parameters that are taken as one, under a name of your own; each other parameter is a group of itself.",
      .keys = {texts("GROUP")
                   .at_least_of(1, "at least one parameter")
                   .all_different()
                   .sometimes("one for each group")
                   .says("The paths of the group's parameters; correlated ones belong into one group.")},
      .any_name = true};
  return table_of_keys;
}

const KeyTable& distribution_keys() {
  using namespace keys;
  static const std::string one = "exactly one distribution is given";
  const auto family = [](const char* name, const KeyTable& (*inside)(), const char* sentence) {
    return table(name, inside).sometimes(one).says(sentence);
  };
  static const KeyTable table_of_keys{
      .name = "distribution",
      .says = "A distribution; its values have the unit of what scatters.",
      .keys =
          {family("normal", normal_keys, "Normal distribution."),
           family("uniform", uniform_keys, "Uniform distribution."),
           family("lognormal", lognormal_keys, "Lognormal distribution."),
           family("triangular", triangular_keys, "Triangular distribution."),
           family("beta", beta_keys, "Beta distribution between two ends."),
           family("weibull", weibull_keys, "Weibull distribution."),
           family("discrete", discrete_keys, "Some values, each with a probability."),
           family("empirical", empirical_keys, "The values of a CSV column, each as probable as any other."),
           text("fit")
               .sometimes(one + "; for a radial clearance only")
               .says("An ISO 286 fit such as \"20 H7/g6\" (nominal size in mm): hole and shaft lie independently in "
                     "their zones, "
                     "and the radial clearance is half their difference."),
           family("planes", planes_keys, "A tolerance zone between two parallel planes (ISO 1101)."),
           table("cylinder", cylinder_keys)
               .sometimes(one + "; for two parameters that are drawn together")
               .says("A cylindrical tolerance zone (ISO 1101): a point of a disc."),
           table("rows", rows_keys)
               .sometimes(one + "; for parameters that are drawn together")
               .says("The rows of a CSV file, such as draws of a posterior: all parameters take their values from the "
                     "same row."),
           choice("zone",
                  std::vector<KeyChoice>{{"normal", "centred, the zone is six standard deviations wide and cut there"},
                                         {"uniform", "any place in the zone is as probable as any other"}})
               .otherwise("normal")
               .says("How sizes, places and tilts lie in their tolerance zones; with fit, planes and cylinder only."),
           values("truncate", "the parameter")
               .of_length({2}, "[low, high], the second one larger")
               .sometimes("left out, nothing is cut")
               .says("Keeps what lies between [low, high], renormalised.")},
      .one_of = {"normal", "uniform", "lognormal", "triangular", "beta", "weibull", "discrete", "empirical", "fit",
                 "planes", "cylinder", "rows"},
      .one_of_what = "distribution"};
  return table_of_keys;
}

}  // namespace boresight
