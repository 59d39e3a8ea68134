#include "boresight_analyses/sweep/sweep_keys.hpp"

#include "boresight_analyses/study/study_keys.hpp"
#include "boresight_analyses/sweep/sweep_plan.hpp"

namespace boresight {

const KeyTable& sweep_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "sweep",
      .says = "The index over a grid of parameters; several axes make a full grid, the last one running fastest.",
      .keys = {
          tables("axis", sweep_axis_keys)
              .at_least_of(1, "at least one [[sweep.axis]]")
              .says("The axes of the grid, one table each; at least one."),
          choice("findings", std::vector<KeyChoice>{{"sun-3-rrcpr", "those of Sun, Song and Wang on their 3-RRCPR"}})
              .sometimes("left out, the result is held against nothing")
              .says("Published findings that the result is held against.")}};
  return table_of_keys;
}

const KeyTable& sweep_axis_keys() {
  using namespace keys;
  static const std::string spaced = "with from, to and count; not together with values";
  static const KeyTable table_of_keys{
      .name = "sweep.axis",
      .says = "One axis of the grid: a parameter and its values, listed or spaced.",
      .keys = {parameter_key("The parameter's path, or a list of paths that take the same value."),
               values("values", "the parameter")
                   .at_least_of(1, "at least one value")
                   .all_different()
                   .sometimes("this, or from, to and count")
                   .says("The values, all different."),
               value("from", "the parameter").sometimes(spaced).says("First value."),
               value("to", "the parameter").sometimes(spaced).says("Last value."),
               integer("count")
                   .between(2.0, kMostSweepPoints, "2 to 100000")
                   .sometimes(spaced)
                   .says("How many values, the first and the last included."),
               choice("scale", std::vector<KeyChoice>{{"linear", "equal differences"}, {"log", "equal ratios"}})
                   .otherwise("linear")
                   .says("How the values are spaced between from and to.")}};
  return table_of_keys;
}

}  // namespace boresight
