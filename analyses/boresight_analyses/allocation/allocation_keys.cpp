#include "boresight_analyses/allocation/allocation_keys.hpp"

#include "boresight_analyses/allocation/allocation_plan.hpp"
#include "boresight_analyses/allocation/cost_curve.hpp"
#include "boresight_analyses/montecarlo/montecarlo_keys.hpp"
#include "boresight_analyses/study/study_keys.hpp"

namespace boresight {
namespace {

Key price_key() {
  return keys::number("price")
      .at_least(0.0, "a price, 0 or more")
      .says("Its price, in any currency that all prices share.");
}

// How many at least hangs on the requirement.
KeyBound some_samples() {
  return {
      .least = 1.0, .most = 1e6, .expected = "as many as the requirement takes at least (Wilks 1941), up to 1000000"};
}

// The names of cost_curve.hpp, each with its curve.
std::vector<KeyChoice> described_cost_laws() {
  const std::vector<std::string> names = cost_law_names();
  return {{names[0], "a + b / t"}, {names[1], "a + b / t^2"}, {names[2], "a + b / t^k"}, {names[3], "a exp(-b t)"}};
}

}  // namespace

const KeyTable& allocate_keys() {
  using namespace keys;
  static const AllocationPlan p;
  static const KeyTable table_of_keys{
      .name = "allocate",
      .says = "The cheapest fits, processes or tolerances, of joints and of standing errors, that meet a requirement.",
      .keys = {
          table("requirement", requirement_keys).says("What the index shall keep, and with which probability."),
          integer("samples")
              .bounded(some_samples())
              .usually("1000, or four times as many as the requirement takes at least (Wilks 1941)")
              .says("Samples of the gaps, common to all sets that the search judges; up to 1000000."),
          integer("confirm")
              .bounded(some_samples())
              .usually("120, or three times as many as the requirement takes at least")
              .says("Fresh samples that confirm a set on the next rung up; more where they could not show the "
                    "requirement."),
          integer("seed")
              .counting(0.0, 1e9)
              .otherwise(static_cast<double>(p.seed))
              .says("Seed of the random numbers: the same seed gives the same results, bit for bit."),
          choice("zone",
                 std::vector<KeyChoice>{{"normal", "centred, the zone is six standard deviations wide and cut there"},
                                        {"uniform", "any size in the zone is as probable as any other"}})
              .otherwise("normal")
              .says("How sizes lie in their tolerance zones."),
          integer("front").counting(0.0, 50.0).otherwise(p.front).says(
              "Points of the front of cost against accuracy; 0: none."),
          tables("fits", allocate_fit_keys)
              .at_least_of(1, "at least one { fit = .., price = .. }")
              .sometimes("left out, each joint has its own")
              .says("Fits of all joints that have none of their own, such as [{ fit = \"20 H7/g6\", price = 12 }]."),
          tables("joint", allocate_joint_keys)
              .sometimes("this or error, or both")
              .says("The joints to be given a fit, one table each."),
          tables("error", allocate_error_keys)
              .sometimes("this or joint, or both")
              .says("The standing errors to be given a tolerance.")}};
  return table_of_keys;
}

const KeyTable& allocate_joint_keys() {
  using namespace keys;
  static const std::string one = "one of fits, processes and cost; left out, the fits of [allocate]";
  static const KeyTable table_of_keys{
      .name = "allocate.joint",
      .says = "A joint whose radial clearance is chosen, or several that take the same.",
      .keys = {parameter_key(
                   "The path of a radial clearance, clearance.JOINT.radial, or a list of them that take the same fit."),
               tables("fits", allocate_fit_keys)
                   .at_least_of(1, "at least one { fit = .., price = .. }")
                   .sometimes(one)
                   .says("ISO 286 fits to choose from, of the joint's size."),
               tables("processes", allocate_process_keys)
                   .at_least_of(1, "at least one { name = .., tolerance = .., price = .. }")
                   .sometimes(one)
                   .says("Manufacturing processes to choose from."),
               table("cost", allocate_cost_keys)
                   .sometimes(one)
                   .says("What a tolerance costs, as a curve: it is then chosen continuously."),
               quantities("tolerance", kLength)
                   .of_length({2}, "two lengths, the tightest and the widest tolerance")
                   .sometimes("needed with cost")
                   .says("The tightest and the widest tolerance that may be chosen."),
               quantity("least", kLength)
                   .at_least(0.0, "0 or more")
                   .otherwise(AllocationEntry{}.least)
                   .says("Radial clearance at tolerance zero, with processes or cost: the gap lies between least and "
                         "least + "
                         "tolerance.")}};
  return table_of_keys;
}

const KeyTable& allocate_error_keys() {
  using namespace keys;
  static const std::string one = "one of processes and cost";
  static const KeyTable table_of_keys{
      .name = "allocate.error",
      .says =
          "A standing error of the mechanism whose tolerance is chosen. It lies within half of the tolerance to both "
          "sides of its value in the mechanism file.",
      .keys = {
          parameter_key("The path of an error, error.NAME, or a list of them: each gets a tolerance of its own, from "
                        "the same processes or the same cost."),
          tables("processes", allocate_error_process_keys)
              .at_least_of(1, "at least one { name = .., tolerance = .., price = .. }")
              .sometimes(one)
              .says("Manufacturing processes, or grades, to choose from."),
          table("cost", allocate_cost_keys)
              .sometimes(one)
              .says("What a tolerance costs, as a curve: it is then chosen continuously."),
          values("tolerance", "the error's")
              .of_length({2}, "two values, the tightest and the widest tolerance")
              .sometimes("needed with cost")
              .says("The tightest and the widest tolerance that may be chosen.")}};
  return table_of_keys;
}

const KeyTable& allocate_error_process_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{.name = "allocate.error.processes",
                                      .says = "A manufacturing process or a grade, its tolerance and its price.",
                                      .keys = {text("name").filled("a name").says("Its name, such as \"ground\"."),
                                               value("tolerance", "the error's")
                                                   .above(0.0, "more than 0")
                                                   .says("Width of the zone that the error lies in, more than 0."),
                                               price_key()}};
  return table_of_keys;
}

const KeyTable& allocate_fit_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "allocate.fits",
      .says = "A fit and its price.",
      .keys = {text("fit").says("An ISO 286 fit with clearance, such as \"20 H7/g6\" (nominal size in mm)."),
               price_key()}};
  return table_of_keys;
}

const KeyTable& allocate_process_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{.name = "allocate.joint.processes",
                                      .says = "A manufacturing process, its tolerance and its price.",
                                      .keys = {text("name").filled("a name").says("Its name, such as \"reamed\"."),
                                               quantity("tolerance", kLength)
                                                   .above(0.0, "more than 0")
                                                   .says("Width of the zone that the radial clearance lies in."),
                                               price_key()}};
  return table_of_keys;
}

const KeyTable& allocate_cost_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "allocate.joint.cost",
      .says = "What a tolerance t costs: the tighter, the more (Chase, Greenwood, Loosli, Hauglund 1990, Table 1).",
      .keys = {choice("law", described_cost_laws()).otherwise("reciprocal").says("The curve."),
               number("a").at_least(0.0, "0 or more").otherwise(0.0).says("a of the curve, a price."),
               number("b")
                   .above(0.0, "more than 0: a wider tolerance never costs more")
                   .says("b of the curve: how dear tightness is."),
               number("k")
                   .above(0.0, "more than 0")
                   .sometimes("needed with law = \"reciprocal-power\" only")
                   .says("Exponent k."),
               text("unit")
                   .usually("mm; of errors that are angles mrad, of temperatures K")
                   .says("Unit in which b is meant.")}};
  return table_of_keys;
}

}  // namespace boresight
