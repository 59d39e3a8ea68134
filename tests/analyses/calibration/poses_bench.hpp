// A mechanism without play whose standing errors are known because its data are made here: by multibody's motion at poses, with noise.
#pragma once

#include <cmath>
#include <random>

#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/calibration/calibrate.hpp"
#include "boresight_analyses/calibration/rig.hpp"

namespace boresight::poses {

constexpr double kArcsec = M_PI / 648000.0;

// Of channel_names().
constexpr int kDisplacements[] = {0, 1, 2}, kRotations[] = {3, 4, 5}, kAxis[] = {6, 7, 8};

inline std::shared_ptr<const Mechanism> gimbal() {
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/altaz-gimbal.toml"));
}

struct Bench {
  std::shared_ptr<const Mechanism> mechanism;
  std::vector<std::string> paths;
  std::vector<int> channels;
  std::vector<double> times;
  MatX clean;
  CalibrationRun run;  // without data: its scene and ideal motion are the same in every problem

  // poses: at equal times over the whole motion, the last one at its end.
  Bench(std::shared_ptr<const Mechanism> with_errors, std::vector<std::string> fitted, std::vector<int> measured,
        int poses)
      : mechanism(std::move(with_errors)), paths(std::move(fitted)), channels(std::move(measured)) {
    for (int i = 1; i <= poses; ++i) times.push_back(mechanism->duration() * i / poses);
    clean = multibody_readings(mechanism, mechanism->parameters(), times, channels);
    run = CalibrationRun("poses", mechanism, {});
  }

  // noise: standard deviation of each channel [SI]; follows: the correlation of neighbouring readings of one, as a first-order process has it.
  // Fits start at the drawing.
  CalibrationProblem problem(const std::vector<double>& noise, unsigned seed, double follows = 0.0) const {
    MeasuredData data;
    data.file = "synthetic";
    data.channels = channels;
    data.time = times;
    data.value = clean;
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<double> last(noise.size());
    for (Eigen::Index i = 0; i < clean.rows(); ++i) {
      data.line.push_back(static_cast<int>(i) + 2);
      for (Eigen::Index c = 0; c < clean.cols(); ++c) {
        double& now = last[static_cast<std::size_t>(c)];
        now = i == 0 ? normal(engine) : follows * now + std::sqrt(1.0 - follows * follows) * normal(engine);
        data.value(i, c) += noise[static_cast<std::size_t>(c)] * now;
      }
    }
    CalibrationProblem p;
    p.runs.push_back(run);
    p.runs.back().data = std::move(data);
    for (const std::string& path : paths) p.parameters.push_back(fitted_parameter(mechanism->description(), path, 0.0));
    p.prepare(std::numeric_limits<double>::infinity(), true);
    return p;
  }

  double truth(const std::string& path) const {
    return ParameterPath(mechanism->description(), path).get(mechanism->parameters());
  }
  // Of a combination that the data know.
  double truth(const KnownCombination& combination) const {
    double sum = 0.0;
    for (const auto& [p, coefficient] : combination.terms)
      sum += coefficient * truth(paths[static_cast<std::size_t>(p)]);
    return sum;
  }
};

// Whether as many of the intervals of 95 % hold the truth as chance allows: within two standard errors of 95 %.
struct Coverage {
  int inside = 0, all = 0;

  void add(double truth, double low, double high) {
    inside += low <= truth && truth <= high;
    ++all;
  }
  double share() const { return static_cast<double>(inside) / all; }
  double allowed() const { return 2.0 * std::sqrt(0.95 * 0.05 / all); }
};

}  // namespace boresight::poses
