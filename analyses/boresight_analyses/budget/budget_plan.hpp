// What a pointing budget is asked, as the [budget] table of a study file says it:
//
//   [budget]
//   members = 100                # of the ensemble: samples of what [[random]] scatters, with their own external errors
//   attribution = 24             # of them, how many are run again with each group held and each clearance halved
//   seed = 1
//   confidence = 0.9             # of all intervals
//   sampling = "0.5 ms"          # of the pointing history; left out: a 2000th of the motion
//   start = "0.1 s"              # what the motion does before is left out
//   window = "50 ms"             # of MPE, RPE, PDE, PRE
//   separation = "0.3 s"         # of the two windows of PDE, from beginning to beginning
//   observation = "0.4 s"        # length of one; left out: the whole motion is one, and there is no PRE
//   revisit = "0.4 s"            # of the two windows of PRE; left out: one observation
//   leave_out = 0.05             # share of the members that the temporal interpretation leaves out; left out: none of those seen
//   posterior = "results/calibrate/posterior.toml"   # what scatters is what a calibration knows, instead of [[random]]
//   groups = { contact = ["clearance.F1.contact.restitution", "clearance.F1.friction.coefficient"] }
//
//   [[budget.requirement]]       # any number; the first one is what shares and reliefs are about
//   index = "APE"                # MPE, RPE, PDE, PRE
//   axis = "half cone"           # or "x", "y"; of position and orientation "x", "y", "z", "total"
//   interpretation = "mixed"     # ensemble, temporal
//   limit = "600 arcsec"
//   probability = 0.95
//   confidence = 0.9
//
//   [[budget.requirement]]       # jitter by exposure time: RPE over windows of its own, each with its limit
//   index = "RPE"
//   exposures = ["10 ms", "0.1 s"]
//   limits = ["1 arcsec", "3 arcsec"]
//
//   [[budget.correlation]]       # two contributors whose draws depend on each other, read_correlations.hpp
//   contributors = ["gyro", "star tracker"]
//   coefficient = 0.5
//
//   [[budget.part]]              # a sub-budget, sub_budgets.hpp
//   name = "attitude"
//   within = "pointing"          # another part; left out: the whole
//   contributors = ["gyro"]
//   mechanism = false            # whether the mechanism's own error is in it
//   allocated = "300 arcsec"     # left out: it is rolled up only
//
//   [[budget.contributor]]       # an error from outside of the clearances
//   name = "star tracker"
//   class = "random"             # bias, periodic, drift
//   distribution = { .. }        # over the members, as in [[random]]: of the bias, of the noise's standard deviation,
//   of the
//                                # amplitude, of the drift per time; or value = "2 arcsec", the same in all
//   axes = ["x", "y"]            # left out: all
//   period = "0.2 s"             # periodic
//   correlation_time = "1 ms"    # random; left out: the sampling
//   recalibrated = true          # bias, drift: every observation has another bias, and a drift that begins at zero
//   group = "thermal"            # contributors of one group vary together
//   axis_correlation = [0.5]     # of x and y; of three axes [xy, xz, yz]
//   frame = { x = [0, 1, 0], z = [0, 0, 1] }   # its own axes in those of the error; left out: they are the same
//
//   [[budget.contributor]]       # or noise by its spectrum, read_noise.hpp
//   name = "gyro"
//   spectrum = { white = "0.04 arcsec^2/Hz" }                            # in place of class
//   through = [{ second_order = { frequency = "5 Hz", damping = 0.3 } }] # the pointing loop; left out: it is the error itself
//   factor = { .. }              # over the members; left out: 1
//
//   [[budget.contributor]]       # or a measured course, read_measured_course.hpp
//   name = "floor"
//   measured = { file = "floor.csv", time = "t", columns = ["x", "y"], unit = "arcsec", begin = "anywhere" }
//
//   [[budget.contributor]]       # or a standing error of the mechanism over time: factor * course + value
//   name = "sun on the rod"
//   error = "rod1.warming"       # in place of class
//   course = "3*(1 - exp(-t/0.2))"     # of t [s], in m, rad or K
//   factor = { normal = { mean = 1, sd = 0.1 } }   # over the members; left out: 1
//   value = "1 K"                # or distribution = { .. }; left out beside a course: 0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "boresight_analyses/budget/contributor.hpp"
#include "boresight_analyses/random/parameter_groups.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/random/sampling_design.hpp"
#include "boresight_analyses/study/study.hpp"

namespace boresight {

// The axes of a quantity's error vector, and what they make together.
struct BudgetAxes {
  std::vector<std::string> names;  // "x", "y", ...
  std::string total;               // "half cone" of two, "total" of three

  explicit BudgetAxes(PointingQuantity quantity);
  std::size_t count() const { return names.size(); }
  const std::string& name(std::size_t axis) const {
    return axis < names.size() ? names[axis] : total;
  }  // count(): the total
  std::vector<std::string> all() const;
};

struct BudgetRequirement {
  ErrorIndex index = ErrorIndex::ape;
  std::size_t axis = 0;  // BudgetAxes::count(): the total
  Interpretation interpretation = Interpretation::mixed;
  double limit = 0.0;  // SI; 0: none was asked for
  double probability = 0.95;
  double confidence = 0.9;
  std::string unit = "";  // in which the study writes the limit: "arcsec"
  double exposure = 0.0;  // jitter: the window of its own that RPE is taken over [s]; 0: that of the budget
};

// A sub-budget: what belongs together, and what of the whole is allocated to it.
struct BudgetPart {
  std::string name, within;               // within: another part; "": the whole
  std::vector<std::size_t> contributors;  // of the plan, its own
  bool mechanism = false;                 // whether the mechanism's own error is in it
  double allocated = 0.0;                 // SI; 0: nothing
  std::string unit = "";                  // in which the study writes it
};

struct BudgetPlan {
  std::uint64_t members = 100, attribution = 24;
  std::uint64_t seed = 1;
  double confidence = 0.9;
  double sampling = 0.0, start = 0.0;  // [s]
  Windows windows;
  double leave_out = 0.0;
  // Between the mechanism's own error and the pointing: a loop that sees it and drives against it. None: it is the pointing error itself.
  std::optional<TransferFunction> through;
  RandomInputs inputs;    // none where the study scatters nothing
  std::string posterior;  // the file that they were read from, and its hash; "": the study itself
  std::string posterior_hash;
  NamedGroups groups;
  std::vector<BudgetRequirement> requirements;
  std::vector<Contributor> contributors;
  std::vector<ContributorCorrelation> correlations;
  std::vector<BudgetPart> parts;
  std::vector<KnownError> known;  // once follow_errors() was called
  // Likewise, of parameters in groups of standing errors: what one unit does over the histories, to first order; empty where that is not told.
  std::vector<std::vector<Vec3>> by_parameter;
  double duration = 0.0;  // of the histories: the motion from `start` on [s]

  // Those that a requirement is taken over.
  Windows windows_of(const BudgetRequirement& requirement) const;
  // What shares and reliefs are about: the first requirement that is none of jitter, or the APE of all axes, mixed, 95 %.
  BudgetRequirement headline(const BudgetAxes& axes) const;
  // Whether a group of parameters holds standing errors of the mechanism and nothing else: these add up in time.
  bool is_of_errors(std::size_t group) const;
  // In which the first limit is written; "": there is none.
  std::string written_unit() const { return requirements.empty() ? "" : requirements.front().unit; }
  // The indices that windows and motion allow, in the order of kErrorIndices.
  std::vector<ErrorIndex> indices() const;
  SamplingOptions design() const { return {.kind = SamplingKind::random, .seed = seed}; }
  // What decides a member's pointing history but for mechanism and rung; windows, contributors and requirements do not.
  std::string sample_text(const Study& study) const;
};

// Names the question that a requirement asks of the plan's members: other limits, windows or contributors are another one, judged
// by itself; the number of members is no part of it.
std::string question_of(const BudgetPlan& plan, const BudgetRequirement& requirement);

// Throws InputError. `duration`: of the motion [s]; `accepts`: see read_random_inputs.
BudgetPlan read_budget_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism, double duration,
                            const std::function<void(const Setting&)>& accepts);

}  // namespace boresight
