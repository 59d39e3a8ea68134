#include "boresight_analyses/sensitivity/sensitivity_keys.hpp"

#include "boresight_analyses/random/random_keys.hpp"
#include "boresight_analyses/study/study_keys.hpp"

namespace boresight {

const KeyTable& sensitivity_keys() {
  using namespace keys;
  constexpr double kMostRows = 1 << 24;
  static const KeyTable table_of_keys{
      .name = "sensitivity",
      .says =
          "Which parameter's scatter matters: Sobol' indices of first order (Saltelli 2010) and total (Jansen 1999).",
      .keys = {integer("samples")
                   .counting(16.0, kMostRows)
                   .says("Rows of the design; a row costs as many runs as there are groups, and two. Of sobol "
                         "replicates times a "
                         "power of two."),
               seed_key(),
               choice("design", std::vector<KeyChoice>{{"sobol", "scrambled Sobol' nets, intervals over replicates"},
                                                       {"random", "independent rows, intervals by bootstrap"}})
                   .otherwise("sobol")
                   .says("How rows lie in the space of the random parameters."),
               integer("replicates")
                   .counting(2.0, 1024.0)
                   .otherwise(16.0)
                   .says("Independent nets side by side, from which intervals come; with design = \"sobol\" only."),
               confidence_key(0.95),
               table("groups", groups_keys)
                   .sometimes("left out, every parameter by itself")
                   .says("Parameters that are taken as one.")}};
  return table_of_keys;
}

}  // namespace boresight
