#include "boresight_analyses/calibration/suspects.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/contact/normal_law.hpp"
#include "boresight_analyses/calibration/kept_fits.hpp"

namespace boresight {
namespace {

// Differences are taken over this share of a deviation to either side: valleys are a hundred times narrower than what is suspected.
constexpr double kShare = 3e-3;

struct Asked {
  Suspect suspect;
  // The problem and the globals with it off by `share` of a deviation.
  std::function<void(CalibrationProblem&, Globals&, double share)> off;
  int as_parameter = -1;  // what it does is what this parameter does, for so much of its coordinate
  double coordinate = 0.0;
};

Asked number_off(const CalibrationProblem& problem, const std::string& path, double deviation, std::string says) {
  const ParameterPath place(problem.runs.front().mechanism->description(), path);
  return {{path, std::move(says), deviation, "%", {}},
          [place, deviation](CalibrationProblem& p, Globals&, double share) {
            for (CalibrationRun& run : p.runs) {
              Parameters off = run.told();
              place.set(off, place.get(off) * (1.0 + share * deviation));
              run.take(off);
            }
          },
          -1,
          0.0};
}

double restitution_of(const NormalLawEntry& law, double factor) {
  double low = 1e-3, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (law.damping_factor(middle) > factor ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// By how much restitutions differ, root mean square, that laws of this family mean who damp alike: those that hold for all restitutions.
double spread_of_laws(const std::string& own, double restitution) {
  const NormalLawEntry& law = normal_law(own);
  if (law.geometry != ContactGeometry::point || !law.damping_factor || law.lowest_restitution < 0.0) return 0.0;
  double square = 0.0;
  int count = 0;
  for (const NormalLawEntry& other : normal_laws()) {
    if (other.name == own || other.geometry != ContactGeometry::point || !other.damping_factor ||
        other.lowest_restitution < 0.0)
      continue;
    square += std::pow(restitution_of(other, law.damping_factor(restitution)) - restitution, 2);
    ++count;
  }
  return count > 0 ? std::sqrt(square / count) : 0.0;
}

std::vector<Asked> asked_of(const CalibrationProblem& problem, const FitResult& fit, const Discrepancy& d) {
  std::vector<Asked> asked;
  const MechanismDescription& m = problem.runs.front().mechanism->description();
  const Parameters& parameters = problem.runs.front().told();
  for (const BodyDescription& b : m.bodies) {
    const std::string path = "body." + b.name + ".mass";
    const bool fitted = std::any_of(problem.parameters.begin(), problem.parameters.end(),
                                    [&](const FittedParameter& p) { return p.path == path; });
    if (fitted || !(d.masses > 0.0) || !(ParameterPath(m, path).get(parameters) > 0.0)) continue;
    asked.push_back(number_off(problem, path, d.masses, "a mass of " + b.name + " other than the file's"));
  }
  if (d.lag > 0.0 && !problem.fit_time_offset && !problem.fit_lag)
    asked.push_back({{"lag", "a lag of the sensor", d.lag, "s", {}},
                     [lag = d.lag](CalibrationProblem&, Globals& at, double share) { at.time_offset -= share * lag; },
                     -1,
                     0.0});
  for (int p = 0; d.law && p < problem.parameter_count(); ++p) {
    const FittedParameter& parameter = problem.parameters[p];
    if (!parameter.path.ends_with(".contact.restitution")) continue;
    double spread = 0.0;
    for (const ClearanceDescription& c : m.clearances) {
      const std::string& joint = m.joints[static_cast<std::size_t>(c.joint)].name;
      if (parameter.path.starts_with("clearance.*.") || parameter.path.starts_with("clearance." + joint + "."))
        spread = std::max(spread, spread_of_laws(c.contact_law, parameter.value(fit.globals.u[p])));
    }
    if (!(spread > 0.0)) continue;
    const double deviation = spread / parameter.slope(fit.globals.u[p]);
    // Of one family, other damping is another restitution: its slope is that of the fit, and nothing in the data tells them apart.
    asked.push_back({{parameter.path, "another damping law of like restitution", spread, "1", {}}, {}, p, deviation});
  }
  return asked;
}

}  // namespace

void allow_for_lag(CalibrationProblem& problem, const Discrepancy& discrepancy) {
  if (!(discrepancy.lag > 0.0) || problem.fit_time_offset || problem.fit_lag || !problem.follows_play()) return;
  problem.fit_time_offset = true;
  problem.time_offset_prior = discrepancy.lag;
  problem.largest_time_offset = 5.0 * discrepancy.lag;
}

std::vector<Suspect> suspects(const CalibrationProblem& problem, const FitResult& fit, const Discrepancy& discrepancy,
                              int jobs) {
  CalibrationProblem plain = problem;
  plain.corrections.clear();
  plain.kept = nullptr;
  // The slopes of the fit, corrections included.
  const auto by_parameter = [&](int p, double coordinate) {
    std::vector<VecX> change;
    for (std::size_t k = 0; k < fit.windows.size(); ++k) {
      WindowResiduals window;
      problem.evaluate(problem.windows[fit.windows[k]], fit.globals, fit.states[k], true, window);
      change.push_back(coordinate * window.by_global.col(p));
    }
    return change;
  };
  const auto readings = [&](const CalibrationProblem& of, const Globals& at) {
    std::vector<VecX> r;
    for (std::size_t k = 0; k < fit.windows.size(); ++k) {
      WindowResiduals window;
      of.evaluate(of.windows[fit.windows[k]], at, fit.states[k], false, window);
      r.push_back(window.r);
    }
    return r;
  };
  std::vector<Asked> asked = asked_of(problem, fit, discrepancy);
  const auto computed = [&](const Asked& one) {
    if (one.as_parameter >= 0) return by_parameter(one.as_parameter, one.coordinate);
    const auto off_by = [&](double share) {
      CalibrationProblem changed = plain;
      Globals at = fit.globals;
      one.off(changed, at, share);
      return readings(changed, at);
    };
    std::vector<VecX> change = off_by(kShare), less = off_by(-kShare);
    for (std::size_t k = 0; k < change.size(); ++k) change[k] = (change[k] - less[k]) / (2.0 * kShare);
    return change;
  };
  for_each_on_threads(static_cast<int>(asked.size()), jobs, [&](int s) {
    Suspect& suspect = asked[s].suspect;
    const std::uint64_t key = CalibrationKey("suspect", problem)
                                  .add(suspect.name, suspect.deviation, fit.globals, fit.windows, fit.states)
                                  .value();
    suspect.change = kept_or_computed<std::vector<VecX>>(problem.kept, key, [&] { return computed(asked[s]); });
  });
  std::vector<Suspect> out;
  for (Asked& a : asked) {
    a.suspect.as_parameter = a.as_parameter;
    a.suspect.coordinate = a.coordinate;
    out.push_back(std::move(a.suspect));
  }
  return out;
}

}  // namespace boresight
