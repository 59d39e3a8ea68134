#include "boresight_analyses/optimise/design_variable_keys.hpp"

#include "boresight_analyses/study/study_keys.hpp"

namespace boresight {

const KeyTable& design_variable_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "match.variable",
      .says = "A parameter whose value is chosen within bounds, or several that take the same value.",
      .keys = {
          parameter_key("The parameter's path, or a list of paths that take the same value."),
          value("from", "the parameter").says("Lower bound."), value("to", "the parameter").says("Upper bound."),
          values("starts", "the parameter")
              .usually("the middle")
              .says("Values from which descents begin, besides the best place that the search of the whole box finds."),
          choice("scale", std::vector<KeyChoice>{{"linear", "the value itself"}, {"log", "its logarithm"}})
              .otherwise("linear")
              .says("What the search sees.")}};
  return table_of_keys;
}

}  // namespace boresight
