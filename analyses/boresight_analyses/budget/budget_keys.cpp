#include "boresight_analyses/budget/budget_keys.hpp"

#include "boresight_analyses/budget/budget_plan.hpp"
#include "boresight_analyses/budget/noise_keys.hpp"
#include "boresight_analyses/random/random_keys.hpp"
#include "boresight_analyses/study/study_keys.hpp"

namespace boresight {
namespace {

constexpr double kMostMembers = 5000.0;  // whose histories are held at once

Key time_key(const char* name) { return keys::quantity(name, kDuration).above(0.0, "more than 0"); }

std::vector<KeyChoice> titled_indices() {
  std::vector<KeyChoice> choices;
  for (const ErrorIndex index : kErrorIndices) choices.push_back({to_string(index), title_of(index)});
  return choices;
}

}  // namespace

const KeyTable& budget_keys() {
  using namespace keys;
  static const BudgetPlan p;
  static const KeyTable table_of_keys{
      .name = "budget",
      .says = "The pointing budget by ECSS-E-ST-60-10C: APE, MPE, RPE, PDE and PRE of an ensemble of mechanisms.",
      .keys = {
          integer("members")
              .counting(2.0, kMostMembers)
              .otherwise(static_cast<double>(p.members))
              .says("Members of the ensemble: samples of what [[random]] scatters, each with its own external errors."),
          integer("attribution")
              .at_least(2.0, "2 to the number of members")
              .usually("24, or all members where these are fewer")
              .says("How many members are run again with each group held and each clearance halved, to share the error "
                    "out; from 2 to members."),
          seed_key(), confidence_key(p.confidence),
          time_key("sampling").usually("a 2000th of the motion").says("Spacing of the pointing histories."),
          quantity("start", kDuration)
              .at_least(0.0, "0 or more, and before the end of the motion")
              .usually("that of [index]")
              .says("What the motion does before is left out."),
          time_key("window")
              .sometimes("needed for MPE, RPE, PDE and PRE")
              .says("Length of the window over which MPE, RPE, PDE and PRE take their means. Windows begin at every "
                    "sample, those of "
                    "RPE at every sixteenth of their length."),
          time_key("separation")
              .sometimes("needed for PDE")
              .says("Time between the beginnings of the two windows of PDE."),
          time_key("observation").usually("the whole motion, and no PRE").says("Length of one observation."),
          time_key("revisit")
              .usually("one observation")
              .says("Time between the beginnings of the two windows of PRE, which lie in different observations."),
          number("leave_out")
              .bounded({.least = 0.0, .most = 1.0, .below = true, .expected = "0 or more and less than 1"})
              .otherwise(p.leave_out)
              .says("Share of the members, the worst ones, that the temporal interpretation leaves out."),
          text("posterior")
              .sometimes("left out, the [[random]] tables say what scatters")
              .says("The posterior.toml of a calibration: what scatters is what that knows, instead of [[random]]."),
          table("groups", groups_keys)
              .sometimes("left out, every parameter by itself")
              .says("Parameters that are taken as one."),
          tables("through", through_keys)
              .sometimes("left out, the mechanism's own error is the pointing error itself")
              .says("Transfer functions between the mechanism's own error, clearances and standing errors, and the "
                    "pointing: "
                    "a pointing loop that sees it. They are followed from as long before `start` as they take to "
                    "settle, or from "
                    "the beginning of the motion, and have settled at its first value there."),
          tables("requirement", budget_requirement_keys)
              .sometimes("left out, nothing is required")
              .says("What is required, one table each; the first one is what shares and reliefs are about."),
          tables("correlation", budget_correlation_keys)
              .sometimes("left out, contributors of different groups are independent")
              .says("Contributors that depend on each other, one table a pair."),
          tables("part", budget_part_keys)
              .sometimes("left out, there are no sub-budgets")
              .says("Sub-budgets, one table each: what belongs together, allocated and rolled up."),
          tables("contributor", budget_contributor_keys)
              .sometimes("left out, the clearances make all of the error")
              .says("Errors from outside of the clearances, one table each.")}};
  return table_of_keys;
}

const KeyTable& budget_requirement_keys() {
  using namespace keys;
  static const BudgetRequirement r;
  static const KeyTable table_of_keys{
      .name = "budget.requirement",
      .says = "A limit of an error index that is kept with a probability, shown at a confidence.",
      .keys = {choice("index", titled_indices())
                   .otherwise(to_string(r.index))
                   .says("The error index (ECSS-E-ST-60-10C, 3.2)."),
               choice("axis", {"x", "y", "z", "half cone", "total"})
                   .usually("all axes together: half cone, or total")
                   .says("The axis of the error: of angles of a direction x, y and half cone, of positions and "
                         "orientations x, y, z and "
                         "total."),
               choice("interpretation",
                      std::vector<KeyChoice>{
                          {to_string(Interpretation::ensemble), "every member by its largest error over time"},
                          {to_string(Interpretation::temporal), "over time, in the worst member"},
                          {to_string(Interpretation::mixed), "over members and time together"}})
                   .otherwise(to_string(r.interpretation))
                   .says("What the probability is over (ECSS-E-ST-60-10C, A.1.4)."),
               quantity_of("limit", "the index")
                   .above(0.0, "more than 0")
                   .sometimes("needed unless there are exposures")
                   .says("What the error shall not exceed."),
               quantities("exposures", kDurationRange)
                   .at_least_of(1, "at least one")
                   .above(0.0, "at least two samples of the history each")
                   .sometimes("with index = \"RPE\" only; left out, the budget's window")
                   .says("Jitter by exposure time: windows of its own, over each of which RPE keeps its own limit."),
               values("limits", "the index")
                   .above(0.0, "limits above zero")
                   .at_least_of(1, "one for each exposure")
                   .sometimes("with exposures only")
                   .says("One limit for each exposure."),
               number("probability")
                   .share()
                   .otherwise(r.probability)
                   .says("Probability with which the limit shall be kept."),
               number("confidence")
                   .share()
                   .above(0.5, "more than 0.5 and less than 1")
                   .otherwise(r.confidence)
                   .says("One-sided confidence at which that probability is shown.")}};
  return table_of_keys;
}

const KeyTable& budget_correlation_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "budget.correlation",
      .says =
          "Two contributors that depend on each other, axis by axis, by a Gaussian copula: each keeps its own "
          "distribution, or spectrum.",
      .keys = {texts("contributors")
                   .of_length({2}, "two contributors")
                   .all_different()
                   .says("Their names: two biases or drifts, two noises of class random, or two by their spectra."),
               number("coefficient")
                   .inside_of(-1.0, 1.0, "more than -1 and less than 1")
                   .says("Correlation of the normal scores behind their draws.")}};
  return table_of_keys;
}

const KeyTable& budget_frame_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "budget.contributor.frame",
      .says = "The axes that a contributor is given in, by two of them; the third one is perpendicular to both.",
      .keys = {direction("x").sometimes("two of the three").says("Its x axis in the axes of the error."),
               direction("y").sometimes("two of the three").says("Its y axis."),
               direction("z").sometimes("two of the three").says("Its z axis.")}};
  return table_of_keys;
}

const KeyTable& budget_part_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "budget.part",
      .says =
          "A sub-budget. It is rolled up in the index, axis, interpretation and probability of the first requirement, "
          "its errors added in time.",
      .keys = {text("name").filled("a name").says("Its name."),
               text("within").usually("the whole budget").says("The part that it belongs to."),
               texts("contributors")
                   .all_different()
                   .sometimes("left out, it holds what the parts within it hold")
                   .says("The names of its own contributors; none is in two parts."),
               boolean("mechanism", BudgetPart{}.mechanism)
                   .says("Whether the mechanism's own error is in it: clearances, scatter and standing errors."),
               quantity_of("allocated", "the index")
                   .above(0.0, "more than 0")
                   .sometimes("left out, it is rolled up only")
                   .says("What it may come to.")}};
  return table_of_keys;
}

const KeyTable& budget_contributor_keys() {
  using namespace keys;
  static const std::string one = "this, or the other of distribution and value; either may be left out beside course";
  static const std::string of_error = "left out, the contributor has a class";
  static const KeyTable table_of_keys{
      .name = "budget.contributor",
      .says =
          "An error from outside of the clearances, by its class (ECSS-E-ST-60-10C, Annex B); or noise by its "
          "spectrum; or a measured course; or a "
          "standing error of the "
          "mechanism over time: factor times course plus value, by its column of influence at the commanded pose.",
      .keys = {
          text("name").filled("a name").says("Its name."),
          choice("class",
                 std::vector<KeyChoice>{{to_string(ContributorClass::bias), "one value for a member, all the time"},
                                        {to_string(ContributorClass::random), "noise of first order"},
                                        {to_string(ContributorClass::periodic), "a sinusoid of unknown phase"},
                                        {to_string(ContributorClass::drift), "grows with time"}})
              .sometimes("needed, or spectrum, measured or error")
              .says("Its course in time."),
          table("spectrum", spectrum_keys)
              .sometimes("in place of class")
              .says("Noise by its power spectral density, the same on every axis that it acts on and independent "
                    "between them."),
          table("measured", measured_keys).sometimes("in place of class").says("A course in time as it was measured."),
          tables("through", through_keys)
              .sometimes("not with error; left out, the contributor is the error itself")
              .says("Transfer functions between the contributor and the pointing, one after the other: a pointing "
                    "loop, a structure. Of a class "
                    "what is left once they have settled."),
          text("error").sometimes(of_error).says(
              "The name of an [[error]] of the mechanism, in place of class. What it does is added to the motion by "
              "superposition, to first order and quasi-static; [[random]] must not scatter it too, and what the "
              "mechanism file gives it counts besides."),
          expression("course", kRatio)
              .sometimes("with error only; left out, the error is constant in a member")
              .says("The error over time, an expression of t [s] from the beginning of the motion, in m, rad or K."),
          table("factor", distribution_keys)
              .sometimes("with course, spectrum or measured only; left out, 1")
              .says("How a factor of the course or the noise scatters over the members, in pure numbers."),
          table("distribution", distribution_keys)
              .sometimes(one)
              .says("How it scatters over the members: a bias, a noise's standard deviation, an amplitude, a drift per "
                    "time; of a standing error what is added to its course."),
          quantity_of("value", "the index, of a drift per time; of a standing error its own")
              .sometimes(one)
              .says("The same value in all members."),
          choices("axes", {"x", "y", "z"}, "an axis of the error")
              .at_least_of(1, "at least one axis")
              .all_different()
              .sometimes("left out, all axes")
              .says("The axes that it acts on: \"x\", \"y\", and where there is one, or with frame, \"z\"."),
          table("frame", budget_frame_keys)
              .sometimes("left out, the axes of the error; not with error")
              .says("Axes of its own that it is given in, such as those of a sensor's head."),
          numbers("axis_correlation")
              .of_length({1, 3}, "one coefficient of two axes, three of three")
              .inside_of(-1.0, 1.0, "coefficients that a correlation matrix can have, positive definite")
              .sometimes("left out, its axes are independent; not with period, measured or error")
              .says("How its axes depend on each other: of two axes one coefficient, of three [xy, xz, yz]."),
          time_key("period")
              .sometimes("needed with class = \"periodic\" only")
              .says("Period of the sinusoid, more than two samples of the histories."),
          time_key("correlation_time")
              .usually("the sampling")
              .says("Correlation time of noise; with class = \"random\" only."),
          boolean("recalibrated", Contributor{}.recalibrated)
              .says("Whether every observation has another bias, and a drift that begins at zero; with class = "
                    "\"bias\" or "
                    "\"drift\" only."),
          text("group").usually("a group of its own").says("Contributors of one group vary together.")}};
  return table_of_keys;
}

const KeyTable& posterior_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "posterior",
      .says = "The posterior.toml that `calibrate` writes and [budget] may name.",
      .keys = {tables("random", random_keys)
                   .at_least_of(1, "at least one [[random]] table: what is known of a parameter")
                   .says("The calibrated parameters and what is known of them."),
               tables("correlation", correlation_keys)
                   .sometimes("left out, all are independent")
                   .says("How their errors depend on each other."),
               boolean("interrupted", false)
                   .says("Whether the calibration was interrupted; a budget then refuses the file.")}};
  return table_of_keys;
}

}  // namespace boresight
