#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"

#include <algorithm>
#include <cstdio>

#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/montecarlo/montecarlo_keys.hpp"

namespace boresight {
namespace {

SiUnit unit_of_index(const std::string& si_unit) { return si_unit == "rad" ? kAngle : kLength; }

StopRule read_stop(Cursor table) {
  table.only(stop_keys());
  StopRule stop;
  if (table.has("width")) stop.width = table.quantity("width");
  stop.of = table.choice("of");
  if (table.has("time")) stop.seconds = table.quantity("time");
  table.require(stop.width > 0.0 || stop.seconds > 0.0, "width", "width, or time, or both");
  table.finish();
  return stop;
}

void read_budget(Cursor& table, double& budget, std::uint64_t& pilot) {
  budget = table.quantity("budget");
  pilot = static_cast<std::uint64_t>(table.integer("pilot"));
}

FidelityQuestion read_fidelities(Cursor table) {
  table.only(fidelities_keys());
  FidelityQuestion q;
  q.models = table.choices("models");
  for (std::size_t i = 0; i < q.models.size(); ++i) {
    const std::string& name = q.models[i];
    if (std::find(q.models.begin(), q.models.begin() + static_cast<std::ptrdiff_t>(i), name) !=
        q.models.begin() + static_cast<std::ptrdiff_t>(i))
      table.fail_found("models", "\"" + name + "\" a second time", "each rung once");
  }
  read_budget(table, q.budget, q.pilot);
  table.finish();
  return q;
}

TailQuestion read_tail(Cursor table) {
  table.only(tail_keys());
  TailQuestion q;
  q.cheap = table.choice("cheap");
  q.exact = table.choice("exact");
  table.require(q.cheap != q.exact, "cheap", "another rung than exact");
  read_budget(table, q.budget, q.pilot);
  table.finish();
  return q;
}

}  // namespace

Requirement read_requirement(Cursor table, const Study& study) {
  table.only(requirement_keys());
  Requirement r;
  r.limit = table.quantity("limit", unit_of_index(study.index.si_unit()));
  r.unit = table.unit_as_written("limit");
  r.probability = table.number("probability");
  r.confidence = table.number("confidence");
  table.finish();
  return r;
}

const std::vector<Headline>& headlines() {
  static const std::vector<Headline> all = {{"mean", 0.0}, {"sd", 0.0},   {"p50", 0.5},
                                            {"p95", 0.95}, {"p99", 0.99}, {"p99.73", 0.9973}};
  return all;
}

namespace {

// To the last bit: two limits a nanometre apart are two studies.
std::string exact_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

}  // namespace

std::string MonteCarloPlan::sample_text(const Study& study) const {
  std::string text = inputs.text + design.text() + "\nindex " + study.index.text() + "\n";
  // The budget divides the samples: another one is another study.
  if (fidelities) {
    text += "fidelities";
    for (const std::string& model : fidelities->models) text += " " + model;
    text += " " + exact_text(fidelities->budget) + " " + std::to_string(fidelities->pilot) + "\n";
    // So does what is to be shown: the first rung has as many samples as that takes.
    if (requirement)
      text += "to show " + exact_text(requirement->probability) + " at " + exact_text(requirement->confidence) + "\n";
  }
  if (tail)
    text += "tail " + tail->cheap + " " + tail->exact + " " + exact_text(tail->budget) + " " +
            std::to_string(tail->pilot) + " " + exact_text(requirement->limit) + "\n";
  return text;
}

MonteCarloPlan read_montecarlo_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism,
                                    const std::function<void(const Setting&)>& accepts) {
  Cursor table = root.table("montecarlo");
  table.only(montecarlo_keys());
  MonteCarloPlan plan;
  // Those that have a budget take as many samples as it pays.
  const bool by_budget = table.has("fidelities") || table.has("tail");
  const long long samples = by_budget ? table.integer("samples", 1) : table.integer("samples");
  plan.samples = static_cast<std::uint64_t>(samples);
  plan.design.seed = static_cast<std::uint64_t>(table.integer("seed"));

  const std::string design = table.choice("design");
  for (const SamplingKind kind : {SamplingKind::random, SamplingKind::lhs, SamplingKind::sobol})
    if (design == to_string(kind)) plan.design.kind = kind;
  if (by_budget && plan.design.kind != SamplingKind::random)
    table.fail("design", "\"random\" with fidelities or tail: their intervals are for independent samples");
  plan.samples_of_budget = by_budget && table.has("samples");
  plan.confidence_of_requirement = table.has("tail") && table.has("confidence");
  if (table.has("strata") && plan.design.kind != SamplingKind::lhs)
    table.fail("strata", "strata with design = \"lhs\" only");
  if (table.has("replicates") && plan.design.kind != SamplingKind::sobol)
    table.fail("replicates", "replicates with design = \"sobol\" only");
  plan.design.strata = static_cast<std::uint64_t>(table.integer("strata"));
  plan.design.replicates = static_cast<std::uint64_t>(table.integer("replicates"));
  const std::uint64_t unit = plan.design.kind == SamplingKind::lhs     ? plan.design.strata
                             : plan.design.kind == SamplingKind::sobol ? plan.design.replicates
                                                                       : 1;
  if (plan.samples % unit != 0 || (unit > 1 && plan.samples < 2 * unit))
    table.fail("samples", std::string("a multiple of ") +
                              (plan.design.kind == SamplingKind::lhs ? "strata" : "replicates") + " (" +
                              std::to_string(unit) + "), at least twice: " +
                              std::to_string(std::max<std::uint64_t>(2, (plan.samples + unit - 1) / unit) * unit));

  plan.confidence = table.number("confidence");
  if (table.has("requirement")) plan.requirement = read_requirement(table.table("requirement"), study);
  if (table.has("stop")) plan.stop = read_stop(table.table("stop"));
  if (table.has("fidelities")) plan.fidelities = read_fidelities(table.table("fidelities"));
  if (table.has("tail")) plan.tail = read_tail(table.table("tail"));
  if (by_budget) {
    if (plan.fidelities && plan.tail) table.fail("tail", "fidelities, or tail, not both");
    if (table.has("stop")) table.fail("stop", "no stop with fidelities or tail: their budget ends them");
    if (plan.tail && !plan.requirement)
      table.fail("requirement", "a requirement with tail: its limit is what is exceeded");
  }
  table.finish();
  plan.inputs = read_random_inputs(root, mechanism, accepts);
  if (plan.design.kind == SamplingKind::sobol &&
      plan.inputs.size() > static_cast<std::size_t>(SobolNet::kMostDimensions))
    table.fail("design", "at most " + std::to_string(SobolNet::kMostDimensions) + " random parameters with \"sobol\"");
  return plan;
}

}  // namespace boresight
