#include "study_reading.hpp"

#include <cmath>
#include <limits>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/allocation/allocation_plan.hpp"
#include "boresight_analyses/budget/budget_plan.hpp"
#include "boresight_analyses/calibration/calibration_plan.hpp"
#include "boresight_analyses/calibration/measured_data.hpp"
#include "boresight_analyses/matching/matching_plan.hpp"
#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/random/csv_column.hpp"
#include "boresight_analyses/sensitivity/sensitivity_plan.hpp"
#include "boresight_analyses/sweep/sweep_plan.hpp"

namespace boresight {
namespace {

const std::string kMechanism = BORESIGHT_EXAMPLES "/crank-slider/crank-slider.toml";

const Mechanism& mechanism() {
  static const Mechanism read(read_mechanism(kMechanism, {{"motion.duration", "20 ms"}}));
  return read;
}

std::string fault_of(const Distribution& d) {
  double before = -std::numeric_limits<double>::infinity();
  for (const double u : {1e-9, 0.01, 0.5, 0.99, 1.0 - 1e-9}) {
    const double x = d.quantile(u);
    if (!std::isfinite(x) || x < before) return "quantile";
    if (!(d.cdf(x) >= 0.0 && d.cdf(x) <= 1.0)) return "cdf";
    before = x;
  }
  return "";
}

std::string fault_of(const RandomInputs& inputs) {
  for (const RandomParameter& p : inputs.parameters) {
    if (p.paths.empty() || p.paths.size() != p.places.size()) return "random parameter without its places";
    if (!p.distribution) return "no distribution";
    if (const std::string fault = fault_of(*p.distribution); !fault.empty()) return fault + " of " + p.name();
  }
  std::vector<double> middle(inputs.size(), 0.5);
  inputs.values(middle);
  for (const double value : middle)
    if (!std::isfinite(value)) return "values at the medians";
  return "";
}

std::string fault_of(const Requirement& r) {
  const bool holds = std::isfinite(r.limit) && r.limit > 0.0 && r.probability > 0.0 && r.probability < 1.0 &&
                     r.confidence > 0.0 && r.confidence < 1.0;
  return holds ? "" : "requirement";
}

bool is_share(double x) { return x > 0.0 && x < 1.0; }

std::string fault_of(const MonteCarloPlan& plan) {
  if (plan.samples == 0 || plan.samples > kMostMonteCarloSamples) return "number of samples";
  if (!is_share(plan.confidence)) return "confidence";
  if (plan.requirement && !fault_of(*plan.requirement).empty()) return "requirement";
  if (!(plan.stop.width >= 0.0 && plan.stop.seconds >= 0.0)) return "stop";
  if (plan.fidelities &&
      (plan.fidelities->models.empty() || !(plan.fidelities->budget > 0.0) || plan.fidelities->pilot == 0))
    return "fidelities";
  if (plan.tail && (!(plan.tail->budget > 0.0) || plan.tail->cheap.empty() || plan.tail->exact.empty())) return "tail";
  return fault_of(plan.inputs);
}

std::string fault_of(const BudgetPlan& plan) {
  if (plan.members == 0 || plan.attribution > plan.members || !is_share(plan.confidence)) return "members";
  if (!(plan.sampling > 0.0) || !(plan.start >= 0.0) || !(plan.duration > 0.0) || plan.duration / plan.sampling > 1e9)
    return "sampling";
  for (const BudgetRequirement& r : plan.requirements)
    if (!(std::isfinite(r.limit) && r.limit > 0.0 && is_share(r.probability) && is_share(r.confidence)))
      return "requirement";
  for (const Contributor& c : plan.contributors)
    if (c.name.empty()) return "contributor";
  return fault_of(plan.inputs);
}

std::string fault_of(const AllocationPlan& plan) {
  if (plan.entries.empty() || plan.samples == 0) return "joints";
  for (const AllocationEntry& joint : plan.entries) {
    if (joint.paths.empty() || !(joint.least >= 0.0)) return "joint";
    for (const AllocationOption& option : joint.options) {
      if (!std::isfinite(option.price) || !option.gap) return "option";
      if (const std::string fault = fault_of(*option.gap); !fault.empty()) return fault + " of " + option.name;
    }
  }
  if (const std::string fault = fault_of(plan.requirement); !fault.empty()) return fault;
  return plan.inputs ? fault_of(*plan.inputs) : "";
}

std::string fault_of(const MatchingPlan& plan) {
  if (plan.variables.empty() || plan.samples == 0 || plan.evaluations <= 0 || !(plan.tolerance > 0.0)) return "search";
  for (const std::vector<double>& start : plan.starts())
    for (const double x : start)
      if (!std::isfinite(x)) return "start";
  for (const MatchingConstraint& c : plan.constraints)
    if (!std::isfinite(c.at_most)) return "constraint";
  return plan.inputs ? fault_of(*plan.inputs) : "";
}

std::string fault_of(const SensitivityPlan& plan) {
  if (plan.rows == 0 || plan.groups.empty() || plan.groups.size() != plan.names.size() || !is_share(plan.confidence))
    return "rows or groups";
  std::vector<double> values(plan.inputs.size());
  plan.values(0, values);
  for (const double value : values)
    if (!std::isfinite(value)) return "values of the first run";
  return fault_of(plan.inputs);
}

std::string fault_of(const SweepPlan& plan) {
  if (plan.axes.empty() || plan.points() == 0 || plan.points() > kMostSweepPoints) return "points";
  for (const SweepAxis& axis : plan.axes)
    for (const double value : axis.values)
      if (!std::isfinite(value)) return "value on an axis";
  return "";
}

std::string fault_of(const CalibrationPlan& plan) {
  if (plan.parameters.empty() || plan.runs.empty()) return "nothing to fit";
  if (!(plan.window > 0.0) || plan.starts < 1 || !is_share(plan.confidence) || !(plan.loss.scale > 0.0))
    return "calibration";
  for (const PlannedParameter& p : plan.parameters)
    for (const std::optional<double>& x : {p.start, p.lower, p.upper})
      if (x && !std::isfinite(*x)) return "start or bound";
  return "";
}

}  // namespace

std::string fault_of_study(std::string_view text, const std::string& folder) {
  Document document = Document::from_text(text, folder + "/fuzz.toml");
  Cursor root(document);
  const Study study = read_study(root, document.content_hash());
  check_index(study, mechanism());
  if (study.accuracy && !(std::isfinite(*study.accuracy) && *study.accuracy > 0.0)) return "accuracy";
  if (!std::isfinite(study.index.start) || study.index.start < 0.0) return "start of the index";
  const auto accepts = [](const Setting& setting) {
    const Mechanism tried(read_mechanism(kMechanism, {{"motion.duration", "20 ms"}, setting}));
  };
  const MechanismDescription& described = mechanism().description();
  // Every verb takes the file for its own, and leaves the tables of the others alone.
  std::string fault;
  const auto take = [&](const char* table, const auto& read) {
    if (fault.empty() && root.has(table)) fault = fault_of(read());
    if (!fault.empty() && fault.find(": ") == std::string::npos) fault = std::string(table) + ": " + fault;
  };
  take("montecarlo", [&] { return read_montecarlo_plan(root, study, described, accepts); });
  take("budget", [&] { return read_budget_plan(root, study, described, mechanism().duration(), accepts); });
  take("allocate", [&] { return read_allocation_plan(root, study, described, accepts); });
  take("match", [&] { return read_matching_plan(root, study, described, accepts); });
  take("sensitivity", [&] { return read_sensitivity_plan(root, study, described, accepts); });
  take("sweep", [&] { return read_sweep_plan(root, described, accepts); });
  take("calibrate", [&] { return read_calibration_plan(root, study, described); });
  return fault;
}

std::string fault_of_data(const std::string& file) {
  const MeasuredData data = read_measured_data(file);
  const auto samples = static_cast<Eigen::Index>(data.time.size());
  if (data.channels.empty() || data.value.rows() != samples ||
      data.value.cols() != static_cast<Eigen::Index>(data.channels.size()))
    return "sizes";
  if (data.line.size() != data.time.size()) return "lines";
  for (const int channel : data.channels)
    if (channel < 0 || channel >= static_cast<int>(channel_names().size())) return "channel";
  for (std::size_t k = 0; k < data.time.size(); ++k)
    if (!std::isfinite(data.time[k]) || (k > 0 && !(data.time[k] > data.time[k - 1]))) return "times";
  for (Eigen::Index k = 0; k < data.value.size(); ++k)
    if (std::isinf(data.value.data()[k])) return "an infinite reading";
  return "";
}

}  // namespace boresight
