// A match under way, each part of it in a file of its own: the search of the box and the descents (matching.cpp), what the designs seen on
// the way show beside the optimum (matching_map.cpp), and what confirms it (matching_confirmation.cpp).
#pragma once

#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/matching/matching.hpp"

namespace boresight {

class MatchingUnderWay {
 public:
  MatchingUnderWay(const MatchingPlan& plan, DesignEvaluator& evaluator, const MatchingOptions& options)
      : plan_(plan), evaluator_(&evaluator), options_(options) {}

  MatchingResult run(DesignEvaluator* confirm, const std::string& rung);

 private:
  std::vector<double> design_at(std::span<const double> x) const;
  std::vector<double> place_of(const std::vector<double>& design) const;
  MatchingVisit visit(const std::vector<double>& design);
  // An objective and constraints as the search sees them. A design that fails is worse than any seen.
  MinimisationProblem problem(const MeasureChoice* objective, const MatchingConstraint* further);

  // Where a descent by gradients meets a design without.
  struct NoSlopes {};
  void slopes_at(std::span<const double> x, const std::vector<double>& design, std::span<double> gradient);
  MinimisationOptions search_options(bool global, int evaluations) const;
  Minimum descend(const std::vector<double>& from, const std::string& name, int evaluations);
  // Where it is the best so far. A place whose runs failed is no optimum, whatever stood for its objective.
  void take(const Minimum& m);
  std::string shown(double value, double beside) const;
  void search();
  void best_of_visits();

  // Whether b is worse than a beyond what the common samples leave open: Student's t of the paired
  // differences.
  bool is_worse(const std::vector<double>& b, const std::vector<double>& a);
  bool keeps_constraints(const std::vector<double>& design);
  void judge_descents();
  // Of the visits from here on.
  void find_as_good(std::size_t first);
  std::vector<double> grid(const DesignVariable& v, double through) const;
  void draw_map();
  // A narrow valley that the search went past may show there.
  void take_from_map();
  // Points that no other one beats in both accuracy and stability, of designs that keep the constraints.
  void gather_front(const MeasureChoice& accuracy, const MeasureChoice& stability);
  void seek_front();

  void confirm_on(DesignEvaluator& confirm, const std::string& rung);
  // At the optimum, on this evaluator's rung.
  std::vector<double> constraints_of(DesignEvaluator& evaluator) const;
  void describe_constraints(DesignEvaluator& evaluator);
  void describe(DesignEvaluator& evaluator);

  const MatchingPlan& plan_;
  DesignEvaluator* evaluator_;
  const MatchingOptions& options_;
  MatchingResult result_;
  std::string stage_;
  std::string no_slopes_;  // why descents no longer go by gradients
  double largest_ = 0.0;
};

}  // namespace boresight
