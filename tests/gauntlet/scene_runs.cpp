#include "scene_runs.hpp"

#include <algorithm>

#include "boresight/rungs/integrator_choice.hpp"

namespace boresight::gauntlet {
namespace {

constexpr double kRounded = 1e-12;    // of a gap, and some times it: what a drawing a few metres away leaves of 0.1 mm
constexpr double kFurtherRuns = 4.0;  // times the limit, for the runs that measure what steps do

// The same run as one that chose for itself, at other steps or another tolerance.
Asked beside(Asked asked, const Measured& chosen, double factor, double finer = 1.0) {
  if (chosen.taken.empty()) {
    asked.step = (finer < 1.0 ? 0.5 : 1.0) * factor * chosen.step;
    return asked;
  }
  asked.integrator = chosen.taken;
  asked.tolerance = finer * factor * (asked.rung == "multibody" ? kMultibodyTolerance : kPerturbationTolerance);
  return asked;
}

}  // namespace

Center center(const std::vector<Measured>& runs, std::size_t figure) {
  std::vector<double> values;
  for (const Measured& m : runs) values.push_back(m.figure[figure]);
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]),
          0.5 * (values.back() - values.front())};
}

std::optional<Measured> SceneRuns::measure_safely(const Asked& asked, bool quiet) {
  const Outcome outcome = in_sandbox(
      options_.limits, [&] { return measure(mechanism_, asked, kMostOfLimit * options_.limits.cpu_seconds); });
  verdict_.cpu_seconds += outcome.cpu_seconds;
  switch (outcome.end) {
    case Outcome::End::crashed:
      verdict_.fault("crash", asked.label(), outcome.reason);
      return {};
    case Outcome::End::out_of_time:
      verdict_.fault("hang", asked.label(), outcome.reason);
      return {};
    case Outcome::End::refused:
      if (!quiet) verdict_.refusals.push_back({asked.label(), outcome.reason});
      return {};
    case Outcome::End::answered:
      break;
  }
  Measured m = measured(outcome.answer);
  if (!m.not_finite.empty()) {
    verdict_.fault("not finite", asked.label(), m.not_finite);
    return {};
  }
  return m;
}

void SceneRuns::make_reference() {
  const Asked own{.rung = "multibody"};
  const std::optional<Measured> first = measure_safely(own);
  if (!first) {
    if (!verdict_.refusals.empty()) verdict_.refused = "multibody: " + verdict_.refusals.back().reason;
    return;
  }
  base_["multibody"] = *first;
  for (double factor : {1.0, 0.93, 1.06}) add_reference(factor);
}

Asked SceneRuns::reference_asked(double factor) {
  return beside({.rung = "multibody"}, base_["multibody"], factor, 0.1);
}

void SceneRuns::add_reference(double factor) {
  const std::optional<Measured> m = measure_safely(reference_asked(factor), true);
  if (m) reference_.push_back(*m);
}

double SceneRuns::floor_of(std::size_t figure) const {
  const double play = smallest_clearance(mechanism_->parameters());
  const double length = mechanism_->characteristic_length();
  const double smallest = play > 0.0 ? 1e-4 * play : 1e-9 * length;
  if (figure < 2) return smallest;
  const auto& sight = mechanism_->description().line_of_sight;
  return smallest / (figure >= 6 && sight ? std::max(length, (sight->target - sight->from).norm()) : length);
}

void SceneRuns::add_references(std::size_t count, double first, double spacing) {
  while (reference_.size() < count) {
    const std::size_t before = reference_.size();
    add_reference(first + spacing * static_cast<double>(before));
    if (reference_.size() == before) return;
  }
}

void SceneRuns::know_steps_of_reference() {
  if (!reference_steps_known_) know_steps(reference_.front(), reference_asked(1.0), mechanism_);
  reference_steps_known_ = true;
}

void SceneRuns::add_neighbours(std::vector<Measured>& runs, const Asked& asked, const std::vector<double>& factors) {
  if (asked.rung == "quasistatic") return;
  const bool perturbed = asked.rung == "perturbation";
  const bool stepped = asked.integrator.empty() || asked.integrator == "generalized-alpha";
  const Measured chosen = runs.front();
  for (const double factor : factors) {
    Asked neighbour = asked;
    if (perturbed) neighbour.start_offset = (factor - 1.0) * 1e-3 * smallest_clearance(mechanism_->parameters());
    if (stepped)
      neighbour = beside(neighbour, chosen, factor);
    else if (!perturbed)
      neighbour.tolerance = factor * kMultibodyTolerance;
    if (const auto n = measure_safely(neighbour, true)) runs.push_back(*n);
  }
}

void SceneRuns::know_steps(Measured& run, const Asked& asked, const std::shared_ptr<const Mechanism>& mechanism) {
  Limits limits = options_.limits;  // it takes several times what the run takes
  limits.cpu_seconds *= kFurtherRuns;
  limits.wall_seconds *= kFurtherRuns;
  const Outcome outcome = in_sandbox(limits, [&] { return measure_steps(mechanism, asked, 0.4 * limits.cpu_seconds); });
  verdict_.cpu_seconds += outcome.cpu_seconds;
  run.steps_measured = outcome.end == Outcome::End::answered && outcome.answer.contains("by_steps");
  if (run.steps_measured)
    for (std::size_t k = 0; k < kFigures.size(); ++k)
      run.by_steps[k] = outcome.answer["by_steps"][k].is_number() ? outcome.answer["by_steps"][k].get<double>() : 0.0;
  else if (run.steps_refused = outcome.end == Outcome::End::answered; run.steps_refused)
    verdict_.refusals.push_back({asked.label() + ", steps not measured", outcome.answer["why_not"]});
}

double SceneRuns::neighbours_spread(const Asked& asked, std::size_t figure, int count) {
  std::vector<Measured>& runs = neighbours_[asked.rung];
  int& tried = neighbours_tried_[asked.rung];
  if (runs.empty()) runs.push_back(base_[asked.rung]);
  for (; tried + 1 < count; ++tried) {
    Asked neighbour = asked;
    const double by = 0.0025 * (2 + tried / 2);
    neighbour = beside(neighbour, base_[asked.rung], tried % 2 == 0 ? 1.0 - by : 1.0 + by);
    if (const auto m = measure_safely(neighbour, true)) runs.push_back(*m);
  }
  return center(runs, figure).spread;
}

double SceneRuns::rounded_spread(const Asked& asked, std::size_t figure) {
  std::vector<Measured>& runs = rounded_[asked.rung];
  if (runs.empty()) {
    runs.push_back(base_[asked.rung]);
    for (int k = 1; k <= 12; ++k) {
      Asked neighbour = asked;
      neighbour.rounding = kRounded * k;
      if (const auto m = measure_safely(neighbour, true)) runs.push_back(*m);
    }
  }
  return center(runs, figure).spread;
}

}  // namespace boresight::gauntlet
