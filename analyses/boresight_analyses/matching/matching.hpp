// Matching: the values of the variables at which the objective is least within the constraints.
//
// The whole box is searched once, then a descent goes out from its best place and from each of the user's
// starts; they are held against each other. The winner is confirmed with other random numbers on the next
// rung up; where that disagrees a descent goes on there. Descents go by gradients where motions have them to
// their end.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/matching/matching_plan.hpp"
#include "boresight_analyses/optimise/design_evaluator.hpp"
#include "boresight_analyses/optimise/minimise.hpp"

namespace boresight {

struct MatchingVisit {
  std::vector<double> design;  // SI
  double objective = 0.0;      // NaN where a sample failed
  double violation = 0.0;      // the largest of value / at_most - 1, 0 if all hold
  std::string stage;
};

struct MatchingDescent {
  std::string from;  // "the box", "start 1", ...
  std::vector<double> start, end;
  double objective = 0.0;
  int evaluations = 0;
  bool converged = false;
  bool agrees = false;  // its end is as good as the best one, as far as the samples can tell
  std::string algorithm = {};
};

struct MatchingMap {
  std::vector<double> x, y;                // of the first and second variable; y empty where there is one only
  std::vector<std::vector<double>> value;  // [y][x]; NaN: failed or a constraint broken by `violation` > 0
};

struct FrontPoint {
  std::vector<double> design;
  double index = 0.0, free_flight_share = 0.0;
};

struct MatchingConfirmation {
  std::string rung;
  std::uint64_t seed = 0;
  std::size_t samples = 0, failed = 0;
  double value = 0.0;  // NaN where any of them failed: the optimum is then not confirmed
  ReportedInterval interval{};
  bool agrees = false;
  bool went_on = false;        // a descent on this rung moved the optimum
  std::vector<double> design;  // where it ended
  double objective = 0.0;
  std::vector<double> constraint_values;  // there, on this rung
  std::string sentence;
};

struct MatchingResult {
  std::vector<double> design;  // the optimum
  double objective = 0.0, violation = 0.0;
  bool feasible = false, converged = false, interrupted = false;
  ReportedInterval interval{};  // of the objective there
  // Values of the variables among those tried that are as good, as far as the samples can tell (paired
  // differences, 95 %).
  std::vector<double> as_good_from, as_good_to;
  // The objective, its interval and the constraints' values are of the rung that confirms, where a descent went on there; otherwise of the
  // search's.
  bool on_confirming_rung = false;
  std::vector<double> constraint_values;
  std::vector<bool> active;    // constraints within 1 % of their bound
  std::vector<bool> at_bound;  // variables
  std::int64_t evaluations = 0, reused = 0;
  std::string global, local, why;
  std::vector<MatchingDescent> descents;
  std::vector<MatchingVisit> visits;  // in the order they were asked for
  MatchingMap map;
  std::vector<FrontPoint> front;                   // ascending index
  std::vector<MatchingConfirmation> confirmation;  // none or one

  // Whether a confirmation that was asked for has a value: the optimum is its own, or held against it.
  bool confirmed() const { return confirmation.empty() || std::isfinite(confirmation.front().value); }
};

struct MatchingOptions {
  double accuracy = 0.01;  // within which a confirmation agrees, beside the samples' own scatter
  double confidence = 0.95;
  // Of the objective by each variable [SI] at a design; none where there is none there, and why. Empty: `no_slopes` says why.
  std::function<std::optional<std::vector<double>>(const std::vector<double>& design, std::string& why)> slopes = {};
  std::string no_slopes = "impacts leave no derivatives to go by";
  // How sentences show a value of the objective, in the unit in which `beside` is shown; empty: as a number in SI.
  std::function<std::string(double value, double beside)> shown = {};
  std::function<bool()> interrupted = {};
  std::function<void(const MatchingResult&)> progress = {};  // after each evaluation
};

// `confirm`: on the next rung up, with another seed.
MatchingResult run_matching(const MatchingPlan& plan, DesignEvaluator& evaluator, DesignEvaluator* confirm,
                            const std::string& confirming_rung, const MatchingOptions& options);

}  // namespace boresight
