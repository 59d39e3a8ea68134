// A pointing budget: what the members' histories say, and beside it the classical table.
//
// A member is one drawing of what scatters: its motion on a rung, and its external errors added to it in time. The
// levels are counted from these histories. The classical table has a line per clearance joint (alone, at the medians),
// per group of random parameters (what the moments of the error lose where the group is held at its medians) and per
// external contributor; and one per standing error that the mechanism file gives a value and nothing scatters, whose part is known.
// Clearances alone are those of the mechanism as drawn, without any error.
//
// Shares are of the mean square of the headline's index v over members and time, in the sense of Euler's allocation
// (Tasche 1999): E[v_i v] / E[v v] of errors that add up in time, which external ones and joints do, known errors, and groups of
// standing errors, whose part is the error with them less that without; of another group what the mean square loses
// where the group is held. They add up to 1 with what joints and groups only make together. Shares and
// gains have intervals by the bootstrap over members (member_bootstrap.hpp).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/budget/budget_runs.hpp"
#include "boresight_analyses/budget/classical_table.hpp"
#include "boresight_analyses/budget/error_reduction.hpp"
#include "boresight_analyses/budget/error_spectrum.hpp"
#include "boresight_analyses/budget/jitter.hpp"
#include "boresight_analyses/budget/line_kinds.hpp"
#include "boresight_analyses/budget/member_bootstrap.hpp"
#include "boresight_analyses/budget/spectral_level.hpp"
#include "boresight_analyses/budget/sub_budgets.hpp"

namespace boresight {

struct BudgetLevel {
  ErrorIndex index = ErrorIndex::ape;
  Interpretation interpretation = Interpretation::mixed;
  std::size_t axis = 0;  // BudgetAxes::count(): the total
  ReportedInterval level = {};
  double by_rule = 0.0;                        // of the classical table
  MemberInterval rule_interval = {};           // of by_rule: with other members of the attribution
  std::optional<double> integrated = {};       // of the total, but for maxima: the Gaussian with the table's moments
  RuleStanding standing = RuleStanding::fair;  // of the rule
  MemberInterval rule_over_level = {};         // what other members leave of by_rule over the level
};

struct RequirementAnswer {
  BudgetRequirement asked;
  BudgetLevel level;  // at the probability asked for
  EnsembleInTime::Compliance compliance;
  Judgement judgement = {};  // by which it holds: statistics/looks.hpp
  // Met by the members as the rung has them; compliance.met holds only if also with every value larger by what the rung and its steps may
  // have missed of that member's mechanism. Then the share, and what is shown of it.
  bool met_by_members = false;
  double model_error = 0.0;  // the largest of the members, relative to their mechanism's part
  EnsembleInTime::Compliance within_error = {};
  double margin() const { return asked.limit - level.level.value; }
  bool rule_says_met() const { return level.by_rule <= asked.limit; }
};

struct Contribution {
  std::string name, kind;
  double share = 0.0;
  MemberInterval interval = {};  // of the share, at the plan's confidence
};

struct Budget {
  BudgetRequirement headline;
  std::int64_t members = 0, failed = 0;
  std::uint64_t attribution = 0;    // members, with all their variants
  std::vector<BudgetLevel> levels;  // of every index, interpretation and axis, at the headline's probability
  std::vector<ClassicalTable> tables;
  std::vector<RequirementAnswer> requirements;
  double mean_square = 0.0;                         // of the headline's index
  std::vector<Contribution> contributions;          // joints, groups, known errors, external, together
  std::vector<ErrorReduction> reductions;           // largest gain first
  std::vector<PointingHistory> shown;               // of the first members, everything together
  PointingHistory nominal;                          // of the mechanism at its medians, alone
  std::vector<std::vector<double>> headline_sizes;  // per member over time
  std::vector<SubBudget> parts;                     // of the headline
  std::vector<JitterCurve> jitter;                  // of requirements by exposure time
  std::vector<SpectralLevel> spectral;              // of contributors with a spectrum
  ErrorSpectrum spectrum;                           // of the members shown; empty where no contributor has one

  bool met() const;  // every requirement
};

// How each requirement is judged, and each part behind them. A first look at it is noted in the store, for those who add members and look
// again.
std::vector<Judgement> look_at_requirements(const BudgetPlan& plan, const BudgetAxes& axes, SampleStore& store);

// From a store that holds all runs. `judgements`: of the requirements and the parts; each as a first look where there are none. Throws
// ComputationError where no member, or not the nominal motion, could be followed.
// of_steps: what the rung's steps may be off by, relative.
Budget budget_of(const BudgetPlan& plan, const BudgetRuns& runs, const Mechanism& mechanism, PointingQuantity quantity,
                 const SampleStore& store, const std::vector<Judgement>& judgements = {}, double of_steps = 0.0);

}  // namespace boresight
