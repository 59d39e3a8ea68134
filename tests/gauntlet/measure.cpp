#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/stepping/measured_error.hpp"

namespace boresight::gauntlet {
namespace {

// Every number that a result holds; remembers the name of the first that is not finite.
class FiniteCheck {
 public:
  void see(const char* name, double x) {
    if (name_.empty() && !std::isfinite(x)) name_ = name;
  }
  void see(const char* name, const Vec3& x) {
    for (double each : x) see(name, each);
  }
  const std::string& first() const { return name_; }

 private:
  std::string name_;
};

void see_statistics(FiniteCheck& check, const char* name, const Statistics& s) {
  for (double x : {s.max, s.rms, s.mean, s.p9973, s.time_of_max}) check.see(name, x);
}

void see_history(FiniteCheck& check, const BodyHistory& history) {
  for (const PoseSample& s : history.samples) {
    check.see("pose", s.pose.p);
    check.see("pose", Vec3(s.pose.q.vec()));
    check.see("error", s.error.displacement);
    check.see("error", s.error.rotation);
    check.see("velocity", s.v);
    check.see("angular velocity", s.w);
    check.see("acceleration", s.a);
    check.see("angular acceleration", s.alpha);
  }
}

std::string first_not_finite(const RunResult& r) {
  FiniteCheck check;
  see_statistics(check, "position error", r.index.position_error);
  see_statistics(check, "orientation error", r.index.orientation_error);
  see_statistics(check, "boresight error", r.index.boresight_error);
  for (const ContactSummary& c : r.contact)
    for (double x : {c.contact_fraction, c.max_penetration, c.max_force, c.max_load, c.max_impact_speed})
      check.see("contact summary", x);
  check.see("platform acceleration", r.platform_acceleration_max);
  check.see("constraint drift", r.constraint_drift);
  for (double share : r.error.model) check.see("error estimate, model", share);
  if (!std::isnan(r.error.discretisation))
    check.see("error estimate, discretisation", r.error.discretisation);  // NaN: not measured
  see_history(check, r.boresight);
  for (const BodyHistory& h : r.others) see_history(check, h);
  for (const auto& clearance : r.clearances)
    for (const ClearanceSample& s : clearance) {
      check.see("offset", s.offset);
      check.see("penetration", s.penetration);
      check.see("normal force", s.normal_force);
    }
  for (const ContactEvent& e : r.events)
    for (double x : {e.start, e.start_speed, e.duration, e.max_penetration, e.max_force, e.end_speed})
      check.see("event", x);
  return check.first();
}

RunOptions options_of(const Asked& asked, const Mechanism& mechanism) {
  RunOptions options;
  options.step = asked.step;
  options.integrator = asked.integrator;
  options.formulation = asked.formulation;
  options.start_offset = asked.start_offset;
  options.tolerance = asked.tolerance;
  options.sample_spacing = mechanism.duration() / 50.0;
  return options;
}

// Of each figure.
std::array<double, kFigures.size()> stated_by_model(const ErrorEstimate& error) {
  using enum PointingQuantity;
  std::array<double, kFigures.size()> stated;
  std::size_t k = 0;
  for (const PointingQuantity quantity : {position_error, boresight_error, orientation_error, line_of_sight_error})
    for (int statistic = 0; statistic < 2; ++statistic) stated[k++] = error.model_of(quantity);
  return stated;
}

std::array<double, kFigures.size()> figures(const PointingIndices& i) {
  const Statistics none, &sight = i.has_line_of_sight ? i.line_of_sight_error : none;
  return {i.position_error.max,
          i.position_error.rms,
          i.boresight_error.max,
          i.boresight_error.rms,
          i.orientation_error.max,
          i.orientation_error.rms,
          sight.max,
          sight.rms};
}

}  // namespace

Json measure(const std::shared_ptr<const Mechanism>& mechanism, const Asked& asked, double most_seconds) {
  RunOptions options = options_of(asked, *mechanism);
  options.progress = [most_seconds](const RunProgress&) {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC < most_seconds;
  };
  Parameters parameters = mechanism->parameters();
  parameters.gravity *= 1.0 + asked.rounding;
  for (ClearanceParameters& c : parameters.clearance)
    for (double* gap : {&c.radial, &c.axial, &c.width_gap, &c.height_gap}) *gap *= 1.0 + asked.rounding;
  const RunResult r = make_rung(asked.rung, mechanism)->run(parameters, options);
  if (r.interrupted) throw ComputationError("longer than the limit, ended when asked to");
  std::string start;
  for (const std::string& warning : r.warnings)
    if (warning.find(" start in the middle of their ") != std::string::npos) start = warning;
  double deepest = 0.0;
  for (const ContactSummary& c : r.contact) deepest = std::max(deepest, c.max_penetration);
  const double play = smallest_clearance(mechanism->parameters());
  return {{"figure", figures(r.index)},
          {"model", stated_by_model(r.error)},
          {"basis", r.error.basis},
          {"step", r.cost.steps > 0 ? mechanism->duration() / static_cast<double>(r.cost.steps) : 0.0},
          {"deepest", play > 0.0 ? deepest / play : 0.0},
          {"start", start},
          {"taken", r.integrator_taken},
          {"not_finite", first_not_finite(r)},
          {"cpu", r.cost.cpu_seconds}};
}

Json measure_steps(const std::shared_ptr<const Mechanism>& mechanism, const Asked& asked, double most_seconds) {
  const std::unique_ptr<Rung> rung = make_rung(asked.rung, mechanism);
  const RunOptions options = options_of(asked, *mechanism);
  const RunResult result = rung->run(mechanism->parameters(), options);
  const MeasuredError error =
      measure_discretisation(*rung, mechanism->parameters(), options, result, {.most_seconds = most_seconds});
  if (!error.measured) return {{"why_not", error.why_not}};
  PointingIndices stated = error.stated;
  stated.has_line_of_sight = result.index.has_line_of_sight;
  return {{"by_steps", figures(stated)}};
}

Measured measured(const Json& json) {
  Measured m;
  m.not_finite = json.at("not_finite");
  if (!m.not_finite.empty()) return m;  // JSON has no infinity: nothing else can be relied on
  for (std::size_t k = 0; k < kFigures.size(); ++k) {
    m.figure[k] = json.at("figure").at(k);
    m.model[k] = json.at("model").at(k);
  }
  m.taken = json.at("taken");
  m.basis = json.at("basis");
  m.start = json.at("start");
  m.step = json.at("step");
  m.deepest = json.at("deepest");
  m.cpu_seconds = json.at("cpu");
  return m;
}

}  // namespace boresight::gauntlet
