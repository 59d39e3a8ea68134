// What the designs seen on the way show beside the optimum: which are as good, the map of the objective, the front of accuracy against
// stability.
#include <algorithm>
#include <cmath>

#include "boresight_analyses/matching/confirmation_sentence.hpp"
#include "boresight_analyses/matching/matching_under_way.hpp"
#include "boresight_analyses/statistics/independent_samples.hpp"

namespace boresight {

bool MatchingUnderWay::is_worse(const std::vector<double>& b, const std::vector<double>& a) {
  if (a == b) return false;
  const auto& of_a = evaluator_->at(a);
  const auto& of_b = evaluator_->at(b);
  const double value_a = plan_.objective.of(of_a), value_b = plan_.objective.of(of_b);
  if (!std::isfinite(value_b)) return true;
  if (plan_.objective.over != Over::mean || of_a.size() < 2)
    return value_b > value_a + options_.accuracy * std::abs(value_a);
  std::vector<double> difference;
  for (std::size_t k = 0; k < of_a.size(); ++k)
    difference.push_back(plan_.objective.of(of_b[k]) - plan_.objective.of(of_a[k]));
  return IndependentSamples(difference).mean(options_.confidence).low > options_.accuracy * std::abs(value_a);
}

bool MatchingUnderWay::keeps_constraints(const std::vector<double>& design) {
  for (const MatchingConstraint& c : plan_.constraints)
    if (excess(c, evaluator_->at(design)) > 1e-6) return false;
  return true;
}

void MatchingUnderWay::judge_descents() {
  for (MatchingDescent& d : result_.descents)
    d.agrees = keeps_constraints(d.end) == result_.feasible && !is_worse(d.end, result_.design);
  find_as_good(0);
}

void MatchingUnderWay::find_as_good(std::size_t first) {
  result_.as_good_from = result_.as_good_to = result_.design;
  const std::vector<MatchingVisit> visits(result_.visits.begin() + static_cast<std::ptrdiff_t>(first),
                                          result_.visits.end());
  for (const MatchingVisit& v : visits) {
    if (v.violation > result_.violation + 1e-6 || is_worse(v.design, result_.design)) continue;
    for (std::size_t i = 0; i < v.design.size(); ++i) {
      result_.as_good_from[i] = std::min(result_.as_good_from[i], v.design[i]);
      result_.as_good_to[i] = std::max(result_.as_good_to[i], v.design[i]);
    }
  }
}

std::vector<double> MatchingUnderWay::grid(const DesignVariable& v, double through) const {
  std::vector<double> values;
  const double low = v.to_search(v.from), high = v.to_search(v.to);
  for (int i = 0; i < plan_.map; ++i)
    values.push_back(v.from_search(low + (high - low) * static_cast<double>(i) / static_cast<double>(plan_.map - 1)));
  values.front() = v.from;
  values.back() = v.to;
  values.push_back(through);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

void MatchingUnderWay::draw_map() {
  if (plan_.map == 0) return;
  stage_ = "map";
  MatchingMap& map = result_.map;
  map.x = grid(plan_.variables[0], result_.design[0]);
  if (plan_.variables.size() > 1) map.y = grid(plan_.variables[1], result_.design[1]);
  // Gaps until they are known: an interruption leaves a map of the same shape.
  map.value.assign(std::max<std::size_t>(1, map.y.size()), std::vector<double>(map.x.size(), std::nan("")));
  for (std::size_t r = 0; r < map.value.size(); ++r)
    for (std::size_t c = 0; c < map.x.size(); ++c) {
      std::vector<double> design = result_.design;
      design[0] = map.x[c];
      if (!map.y.empty()) design[1] = map.y[r];
      const MatchingVisit v = visit(design);
      if (!(v.violation > 1e-6)) map.value[r][c] = v.objective;
    }
}

void MatchingUnderWay::take_from_map() {
  if (plan_.map == 0) return;
  const std::vector<double> before = result_.design;
  best_of_visits();
  if (result_.design == before) return;
  descend(result_.design, "the map", plan_.evaluations);
  best_of_visits();
}

void MatchingUnderWay::gather_front(const MeasureChoice& accuracy, const MeasureChoice& stability) {
  std::vector<FrontPoint> all;
  for (const auto& [design, outcomes] : evaluator_->all()) {
    const FrontPoint p{design, accuracy.of(outcomes), stability.of(outcomes)};
    if (std::isfinite(p.index) && std::isfinite(p.free_flight_share) && keeps_constraints(design)) all.push_back(p);
  }
  std::sort(all.begin(), all.end(), [](const FrontPoint& l, const FrontPoint& r) {
    return l.index != r.index ? l.index < r.index : l.free_flight_share < r.free_flight_share;
  });
  result_.front.clear();
  for (const FrontPoint& p : all)
    if (result_.front.empty() || p.free_flight_share < result_.front.back().free_flight_share)
      result_.front.push_back(p);
}

void MatchingUnderWay::seek_front() {
  MeasureChoice accuracy = plan_.objective, stability = plan_.objective;
  accuracy.measure = Measure::index;
  stability.measure = Measure::free_flight_share;
  gather_front(accuracy, stability);
  if (plan_.front == 0 || result_.front.size() < 2) return;
  stage_ = "front";
  const double low = result_.front.back().free_flight_share, high = result_.front.front().free_flight_share;
  const std::vector<FrontPoint> known = result_.front;
  constexpr int kEvaluationsPerPoint = 12;
  for (int k = 1; k <= plan_.front; ++k) {
    // The most accurate design with at most this much free flight (the epsilon-constraint method, Haimes
    // 1971).
    const MatchingConstraint level{stability, low + (high - low) * k / (plan_.front + 1.0)};
    MinimisationProblem p = problem(&accuracy, &level);
    for (const FrontPoint& f : known)
      if (f.free_flight_share <= level.at_most) {
        p.start = place_of(f.design);
        break;
      }
    MinimisationOptions o = search_options(false, kEvaluationsPerPoint);
    o.local = "cobyla";
    o.initial_step = 0.05;
    if (minimise(p, o).interrupted) throw EvaluationInterrupted{};
  }
  gather_front(accuracy, stability);
}

}  // namespace boresight
