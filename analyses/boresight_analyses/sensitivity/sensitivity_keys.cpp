#include "boresight_analyses/sensitivity/sensitivity_keys.hpp"

#include "boresight_analyses/random/random_keys.hpp"
#include "boresight_analyses/study/study_keys.hpp"

namespace boresight {
namespace {

constexpr int kFewestLevels = 4, kMostLevels = 64;
constexpr const char* kLevels =
    "a multiple of 4 from 4 to 64: with other numbers some moves are mirror images about the median, which do not "
    "change the size of an error about zero";

// Of numbers of levels (morris_effects.hpp).
std::vector<double> no_multiples_of_four() {
  std::vector<double> others;
  for (int k = kFewestLevels; k <= kMostLevels; ++k)
    if (k % 4 != 0) others.push_back(k);
  return others;
}

}  // namespace

const KeyTable& sensitivity_keys() {
  using namespace keys;
  constexpr double kMostRows = 1 << 24;
  static const KeyTable table_of_keys{
      .name = "sensitivity",
      .says =
          "Which parameter's scatter matters: Sobol' indices of first order (Saltelli 2010) and total (Jansen 1999); "
          "or "
          "elementary effects (Morris 1991), or Shapley effects (Song, Nelson, Staum 2016).",
      .keys = {
          integer("samples")
              .counting(16.0, kMostRows)
              .says("Rows of the design. A row costs as many runs as there are groups, and two of sobol or one of "
                    "morris; of shapley with all orders two to the power of their number. Where the design is "
                    "sobol, replicates times a power of two."),
          choice("method",
                 std::vector<KeyChoice>{
                     {"sobol", "shares of the variance, alone and together with all others"},
                     {"morris", "screening: how far the index moves with each, for more than some ten parameters"},
                     {"shapley", "shares of the variance that add up to one, where parameters are correlated"}})
              .otherwise("sobol")
              .says("What is measured of each parameter."),
          integer("levels")
              .between(kFewestLevels, kMostLevels, kLevels)
              .except(no_multiples_of_four(), kLevels)
              .otherwise(4.0)
              .says("At how many places of its distribution each parameter is tried: a multiple of 4, so that no move "
                    "is a mirror image about the median, which does not change the size of an error about zero. With "
                    "method = \"morris\" only."),
          number("negligible")
              .share()
              .otherwise(0.05)
              .says("A parameter is said to be negligible where its mu*, at the upper end of its interval, is "
                    "below this share of the largest mu*. With method = \"morris\" only."),
          choice("orders", std::vector<KeyChoice>{{"all", "every row has all orders of the parameters in it"},
                                                  {"random", "every row has one random order"}})
              .usually("all for up to 4 groups, random for more")
              .says("In which orders parameters are taken in; the cheaper one for its accuracy unless given. With "
                    "method = \"shapley\" only."),
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
