// A four-bar on a test rig, whose contacts are known because its data are made here.
#pragma once

#include <cmath>
#include <map>
#include <random>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight_analyses/calibration/calibrate.hpp"
#include "boresight_analyses/calibration/channel_noise.hpp"
#include "boresight_analyses/calibration/rig.hpp"

namespace boresight::four_bar {

inline std::shared_ptr<const Mechanism> mechanism(double speed, double duration, std::vector<Setting> more = {}) {
  std::vector<Setting> settings = {{"motion.duration", std::to_string(duration) + " s"},
                                   {"motion.drives.A", "2*pi*" + std::to_string(speed) + "*t"},
                                   {"initial.journals", "centred"},
                                   {"clearance.D.radial", "0.2 mm"},
                                   {"clearance.D.contact.restitution", "0.6"},
                                   {"clearance.D.friction.coefficient", "0.1"}};
  settings.insert(settings.end(), more.begin(), more.end());
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml", settings));
}

inline std::vector<double> times(double duration, double spacing = 1e-3) {
  std::vector<double> t;
  for (int i = 0; i * spacing < duration * (1.0 + 1e-9); ++i) t.push_back(std::min(i * spacing, duration));
  return t;
}

// Readings of the perturbation model itself, without errors.
inline MatX own_readings(const std::shared_ptr<const Mechanism>& m, const std::vector<double>& t,
                         const std::vector<int>& channels) {
  RunOptions options;
  options.integrator = "dopri5";
  options.tolerance = 1e-7;
  options.sample_spacing = t[1] - t[0];
  const RunResult run = make_rung("perturbation", m)->run(m->parameters(), options);
  MatX readings(static_cast<Eigen::Index>(t.size()), static_cast<Eigen::Index>(channels.size()));
  for (std::size_t i = 0; i < t.size(); ++i)
    for (std::size_t c = 0; c < channels.size(); ++c)
      readings(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c)) =
          channel_reading(channels[c], run.boresight.samples[i], m->boresight_B());
  return readings;
}

struct Bench {
  std::vector<std::shared_ptr<const Mechanism>> mechanisms;
  std::vector<MatX> clean;
  std::vector<double> t;
  bool multibody = false;

  Bench(const std::vector<double>& speeds, double duration, bool by_multibody, std::vector<Setting> more = {},
        std::vector<int> channels = {0, 1, 2, 3, 4, 5})
      : t(times(duration)), multibody(by_multibody) {
    for (double speed : speeds) {
      mechanisms.push_back(mechanism(speed, duration, more));
      clean.push_back(by_multibody ? multibody_readings(mechanisms.back(), mechanisms.back()->parameters(), t, channels)
                                   : own_readings(mechanisms.back(), t, channels));
    }
  }

  // Fits start a fifth off.
  CalibrationProblem problem(const SyntheticRig& rig, const std::vector<std::string>& paths) const {
    CalibrationProblem p;
    for (std::size_t r = 0; r < mechanisms.size(); ++r)
      p.runs.emplace_back("run " + std::to_string(r + 1), mechanisms[r],
                          with_rig_errors(rig, t, clean[r], static_cast<int>(r)));
    for (const std::string& path : paths) {
      const double truth = ParameterPath(mechanisms[0]->description(), path).get(mechanisms[0]->parameters());
      p.parameters.push_back(
          fitted_parameter(mechanisms[0]->description(), path, truth * (path.ends_with("restitution") ? 0.8 : 1.2)));
    }
    p.prepare(10.0, true);
    return p;
  }
  double truth(const std::string& path) const {
    return ParameterPath(mechanisms[0]->description(), path).get(mechanisms[0]->parameters());
  }
};

inline const std::vector<std::string> kFour = {"clearance.D.radial", "clearance.D.contact.restitution",
                                               "clearance.D.friction.coefficient",
                                               "clearance.D.contact.stiffness_scale"};

// With first-order noise, of this share of the largest root mean square of the displacements or rotations.
inline CalibrationProblem with_following_noise(const Bench& bench, const std::vector<std::string>& paths, double noise,
                                               double follows, unsigned seed) {
  SyntheticRig rig;
  rig.noise = 0.0;
  CalibrationProblem p = bench.problem(rig, paths);
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  p.sigma.resize(6);
  for (CalibrationRun& run : p.runs) {
    MatX& value = run.data.value;
    for (int kind = 0; kind < 2; ++kind) {
      const double size = value.middleCols(3 * kind, 3).colwise().norm().maxCoeff() / std::sqrt(double(value.rows()));
      for (int c = 3 * kind; c < 3 * kind + 3; ++c) {
        p.sigma[c] = noise * size;
        double last = normal(engine);
        for (Eigen::Index i = 0; i < value.rows(); ++i) {
          last = follows * last + std::sqrt(1.0 - follows * follows) * normal(engine);
          value(i, c) += p.sigma[c] * last;
        }
      }
    }
  }
  return p;
}

// Where the truth stands in the fit's coordinates.
inline Globals truth_of(const Bench& bench, const CalibrationProblem& problem) {
  Globals at = problem.start();
  for (int p = 0; p < problem.parameter_count(); ++p)
    at.u[p] = problem.parameters[p].coordinate(bench.truth(problem.parameters[p].path));
  return at;
}

// Ten runs of 1 s at 1 kHz, each at its own speed.
inline Bench ten_runs() {
  std::vector<double> speeds;
  for (int r = 0; r < 10; ++r) speeds.push_back(1.5 + 0.15 * r);
  return Bench(speeds, 1.0, false);
}

}  // namespace boresight::four_bar
