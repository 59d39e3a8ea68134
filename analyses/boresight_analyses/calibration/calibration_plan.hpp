// What a study file asks of `calibrate`:
//
//   [calibrate]
//   window = "whole"                  # or a time, "20 ms": see calibration_problem.hpp
//   start = "rest"                    # where a run's first window begins: as the file starts, or "free": anywhere
//   loss = "huber"                    # "none", "cauchy"; loss_scale: in standard deviations
//   starts = 4
//   time_offset = "2 ms"              # the largest; left out: none is fitted
//   sensor_lag = "0.3 ms"             # what its first-order lag may well be; left out: none is fitted
//   mounting_bias = true
//   drift = true                      # of the channels' offsets
//   discrepancy = { axial = "10 %", masses = "0.5 %", lag = "0 ms", law = false }   # how well the rest is known
//   hold_out = "20 %"
//   corrections = 6                   # by multibody, at most
//   profile = true
//   posterior = { draws = 1600 }      # draws of it as well; calibrate.posterior
//   laws = ["flores", "hertz"]
//   noise = { dx = "1 um" }           # of single channels; those left out are estimated
//
//   [[calibrate.parameter]]
//   path = "clearance.D.radial"
//   start = "0.25 mm"                 # left out: the mechanism's own; lower, upper likewise
//
//   [[calibrate.parameter]]
//   path = "error.rod1.length"        # a standing error
//   start = "0 mm"
//   prior = "20 um"                   # standard deviation of what was known of it before; left out: nothing was
//
//   [[calibrate.parameter]]
//   path = "body.rod1.mass"           # a mass, by its prior
//   prior = "2 %"
//
//   [[calibrate.run]]
//   data = "run-1.csv"                # beside the study
//   set = ["motion.drives.A=2*pi*t"]  # the mechanism's settings in this run
//
//   [[calibrate.run.sensor]]          # in place of data: sensor_plan.hpp
//
//   [[calibrate.candidate]]           # of a next test
//   name = "faster"
//   set = ["motion.drives.A=4*pi*t"]
#pragma once

#include <map>
#include <optional>

#include "boresight/io/cursor.hpp"
#include "boresight_analyses/calibration/calibrate.hpp"
#include "boresight_analyses/calibration/sensor_plan.hpp"
#include "boresight_analyses/study/study.hpp"

namespace boresight {

struct PlannedParameter {
  std::string path;
  std::optional<double> start, lower, upper, prior;
  bool prior_is_share = false;  // of the start
  std::string written_unit;     // of the first of them that is given
  Origin origin;
};

struct PlannedRun {
  std::string name, data;  // data: the file, "" for a candidate and where sensors have files of their own
  std::vector<Setting> settings;
  Origin origin;  // of the text that names the file
  std::vector<PlannedSensor> sensors = {};
};

struct CalibrationPlan {
  double window = std::numeric_limits<double>::infinity();
  bool from_rest = true;
  double data_from = 0.0;  // readings before are left out, though the motion is followed from its start [s]
  ResidualLoss loss;
  int starts = 4;
  std::uint64_t seed = 1;
  double confidence = 0.95;
  double largest_time_offset = 0.0, sensor_lag = 0.0;  // 0: none is fitted [s]
  bool mounting_bias = false, drift = false, offsets_per_run = false;
  Discrepancy discrepancy;
  double hold_out = 0.0;
  Origin hold_out_origin;
  std::map<int, Origin> noise_origin;  // per channel whose noise was told
  int corrections = 6;
  bool profile = true;
  std::optional<DrawOptions> draws;
  Origin draws_origin;
  std::vector<std::string> laws;
  VecX noise;
  std::vector<PlannedParameter> parameters;
  std::vector<PlannedRun> runs, candidates;
};

// mechanism: of the study, for the units of paths. Throws InputError.
CalibrationPlan read_calibration_plan(Cursor& root, const Study& study, const MechanismDescription& mechanism);

// Reads the data and prepares the problem. mechanism_with: the study's mechanism with a run's settings.
CalibrationProblem calibration_problem(
    const CalibrationPlan& plan,
    const std::function<std::shared_ptr<const Mechanism>(const std::vector<Setting>&)>& mechanism_with);

}  // namespace boresight
