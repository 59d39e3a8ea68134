// A calibration as least squares: runs with their data, cut into windows; residuals of a window and their
// derivatives.
//
// Where impacts dissipate, neighbouring motions come together again and a window may be a whole run. Where
// they part (high restitution, small clearance), one residual over a whole run has a useless landscape: data
// are then cut into shorter windows; each starts from a state of its own, which is estimated along with the
// parameters and then eliminated (multiple shooting without continuity: Bock 1981, with every window an
// experiment of its own).
//
//   r = (model(t + offset; theta, start state) + bias + drift t - data) / sigma       per sample and channel
//   f(r): Huber or Cauchy, written as a residual whose square is the loss, so that every sample is bounded
//   alone
//
// Where the sensor lags, what it reads is a mean over the past of the motion, of first order:
//
//   y(t) = int_0^inf e^-s model(t - lag s) ds                              by Gauss's and Laguerre's rule
//
// A weak prior holds the start state within reach of the clearance where the channels do not see all of it.
//
// Standing errors displace the boresight body beside its play: with E z what the play does, x(eps) what the errors do (standing_poses.hpp),
// a channel reads the pose displaced by E z + x(eps). What the errors change of the play's own motion is of second order. Where no
// parameter of a contact is fitted no play is followed: the readings are then those of poses, at any instants, and no motion is integrated.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boresight/scene/scene_rung.hpp"
#include "boresight/slopes/sensitive_motion.hpp"
#include "boresight_analyses/calibration/fitted_parameter.hpp"
#include "boresight_analyses/calibration/measured_data.hpp"
#include "boresight_analyses/calibration/standing_poses.hpp"

namespace boresight {

class KeptResults;

struct CalibrationRun {
  std::string name;
  std::shared_ptr<const Mechanism> mechanism;  // with this run's settings
  std::shared_ptr<const PreparedScene> prepared;
  std::shared_ptr<const SceneTables> tables;      // where a play can move
  std::shared_ptr<const StandingPoses> standing;  // where errors are fitted, or other than zero; by prepare()
  MeasuredData data;
  bool implicit_steps = false;  // of its motions: where they pay at the start; by prepare()

  std::shared_ptr<const Parameters> taken;  // in place of the mechanism's own; none: these

  CalibrationRun() = default;
  CalibrationRun(std::string run_name, std::shared_ptr<const Mechanism> with_settings, MeasuredData measured);

  // What is taken of all that is not fitted.
  const Parameters& told() const { return taken ? *taken : mechanism->parameters(); }
  // From here on these, other masses included.
  void take(const Parameters& parameters);
};

enum class Loss { none, huber, cauchy };

struct ResidualLoss {
  Loss kind = Loss::huber;
  double scale = 2.0;  // standard deviations beyond which a residual counts less

  double residual(double r) const;  // f(r): f^2 is the loss
  double slope(double r) const;     // f'
  double score(double r) const;     // psi = f f'
  double weight(double r) const;    // psi', not below zero
};

struct Window {
  int run = 0;
  int first = 0, last = 0;        // samples, inclusive
  double start = 0.0, end = 0.0;  // of the motion followed [s]
  bool held_out = false;
  bool from_rest = false;  // starts as the mechanism's file says; no start state is estimated
  long most_steps = 0;     // of its motion, attempts; 0: any
};

// What all windows share, in the coordinates of the fit.
struct Globals {
  VecX u;                    // parameters
  double time_offset = 0.0;  // model time less data time [s]
  double lag = 0.0;          // of the sensor [s]
  VecX bias;                 // per offset of CalibrationProblem::offsets, SI; empty: none
  VecX drift;                // of the bias, likewise [SI/s], from each run's t = 0; empty: none

  double offset_at(int offset, double t) const {
    return (bias.size() > 0 ? bias[offset] : 0.0) + (drift.size() > 0 ? drift[offset] * t : 0.0);
  }
};

struct WindowResiduals {
  VecX r;                            // standardised, without loss
  std::vector<int> sample, channel;  // of each
  MatX by_global;                    // x (parameters, time offset, biases)
  MatX by_state;                     // x 2n, in units of state_scale(); zero where the window starts from rest
  SensitiveMotion motion;
};

// A richer model in place of this one near `at`: its readings and its slopes. Matrices: samples x the run's
// channels, SI.
struct TangentModel {
  VecX at;  // u
  double time_offset = 0.0, lag = 0.0;
  MatX reading, by_time, by_lag;
  std::vector<MatX> slope;  // per parameter, by its u
  SensitiveMotion motion;   // this model's, for its impacts
};

// What is known of a richer model, of a run's motion from rest: how far its readings are from this model's;
// once it is there, its tangent.
struct ModelCorrection {
  MatX offset;  // added to this model's readings
  std::optional<TangentModel> tangent;
};

class CalibrationProblem {
 public:
  std::vector<CalibrationRun> runs;
  std::vector<FittedParameter> parameters;
  std::vector<Window> windows;
  std::vector<ModelCorrection> corrections;  // per run; empty: none
  bool noise_told = false;                   // that of all channels
  std::vector<int> channels;                 // among channel_names(), of all runs together
  VecX sigma;                                // noise per channel [SI]
  // Of each channel: which estimate by residuals its sigma is, numbered from 0; channels that share one have its number. -1: it was told.
  // Empty: intervals are those of one variance factor for all.
  std::vector<int> noise_of;
  bool fit_time_offset = false, fit_lag = false, fit_bias = false, fit_drift = false;
  bool offsets_per_run = false;  // whether each run has biases and drifts of its own
  // Of each bias, and of each drift, in the order of their columns: whose it is. By prepare().
  struct Offset {
    int run, channel;  // run: -1 of all of them; channel: index into `channels`
  };
  std::vector<Offset> offsets;
  double largest_time_offset = 0.0;                  // [s]
  double time_offset_prior = 0.0, lag_prior = 2e-4;  // standard deviations about none [s]; 0: nothing is known before
  ResidualLoss loss;
  // Of the integration (MotionRequest). What a motion jitters by from one choice of steps to the next
  // roughens the landscape at the width of a standard error: at 1e-5 by as much as one unit of the loss, at
  // 1e-7 by nothing that matters.
  double tolerance = 1e-7;
  double derivative_tolerance = 1e-4;
  // Where what takes long is kept as it is done, and what an earlier start computed is found; none: nowhere.
  KeptResults* kept = nullptr;

  // Collects the channels, cuts the windows. from_rest: a run's first window starts at t = 0 where the model
  // does, its journals where the mechanism's file has them. Throws InputError where the data reach beyond the motion or do not tell an
  // error's sign; ComputationError where no play can move, or where errors meet a motion that is simulated.
  void prepare(double window_length, bool from_rest);
  // When the motion of a window that is not from rest begins, so that an offset and a lag may look back; when that of any ends [s].
  double start_of(const Window& window) const;
  double end_of(const Window& window) const;
  // Whether a contact's parameter is fitted, so that the motion of the play matters.
  bool follows_play() const;
  bool fits_errors() const;
  // Coordinates of the play's deviation that are followed.
  int freedoms(int run) const { return follows_play() && runs[run].tables ? runs[run].tables->layout.n : 0; }

  int parameter_count() const { return static_cast<int>(parameters.size()); }
  // Globals: the parameters, then those of these that are fitted.
  int time_offset_column() const { return parameter_count(); }
  int lag_column() const { return time_offset_column() + (fit_time_offset ? 1 : 0); }
  int bias_column() const { return lag_column() + (fit_lag ? 1 : 0); }
  int drift_column() const { return bias_column() + (fit_bias ? static_cast<int>(offsets.size()) : 0); }
  int global_count() const { return drift_column() + (fit_drift ? static_cast<int>(offsets.size()) : 0); }
  // Which of `offsets` a run's channel has; -1 where it was not measured.
  int offset_index(int run, int channel) const {
    return offset_index_[static_cast<std::size_t>(run) * channels.size() + static_cast<std::size_t>(channel)];
  }
  std::vector<std::string> global_names() const;
  std::string global_unit(int g) const;  // SI
  // What was known of each before: one over its variance.
  VecX prior_information() const;
  // All of them as one vector, in the order of their names; and back.
  VecX packed(const Globals& globals) const;
  Globals unpacked(const VecX& packed) const;
  int state_size(const Window& window) const { return 2 * freedoms(window.run); }
  // A start state of one, SI: the clearance, and the clearance in a millisecond.
  VecX state_scale(const Window& window) const;
  // Of the prior on the scaled state.
  VecX prior_deviation(const Window& window) const;
  // Column of a run's data, -1 if the run has not this channel (index into `channels`).
  int column(int run, int channel) const;

  Globals start() const;
  std::vector<double> values(const Globals& globals) const;
  Parameters parameters_at(int run, const std::vector<double>& values) const;
  ContactNumbers contact_numbers_at(int run, const std::vector<double>& values) const;

  // Throws ComputationError. state: scaled.
  void evaluate(const Window& window, const Globals& globals, const VecX& state, bool derivatives,
                WindowResiduals& out) const;
  // Loss over a window, prior included.
  double cost(const Window& window, const Globals& globals, const VecX& state) const;
  // What priors add to the loss.
  double prior_cost(const Globals& globals) const;
  // A start state that fits the window better, parameters held: Levenberg-Marquardt on the state alone.
  // Returns the loss.
  double refine_state(const Window& window, const Globals& globals, VecX& state, int most_iterations) const;
  // What channels read, channel by time, of a motion's own readings at the instants that reading_times() names.
  std::vector<double> reading_times(const Window& window, const Globals& globals) const;
  MatX mean_readings(const Window& window, const Globals& globals, const MatX& at_times) const;
  // A first guess of a window's start state: of several local fits of its data, and of `carried` where it is
  // not empty (where the window before led), the one that the model follows best after a few steps of
  // refinement.
  VecX guess_state(const Window& window, const Globals& globals, const VecX& carried = {}) const;
  // How the residuals follow jumps of the state, in its scales, at its start and at some `jumps` instants on the way: residuals x 2n of
  // each. Of a window from rest, by this model itself, whatever corrects it.
  MatX by_jumps(const Window& window, const Globals& globals, int jumps) const;
  // Where a window's motion stands at the start of the next window; scaled.
  VecX state_at(const Window& window, const Globals& globals, const VecX& state, double t) const;

 private:
  void find_offsets();

  std::vector<int> offset_index_;  // runs x channels
  // Into request: what a window's motion starts with.
  void set_start(const Window& window, const std::vector<double>& values, const VecX& state, bool derivatives,
                 MotionRequest& request) const;
  // Instants of the motion that a reading is a mean of, with their weights.
  struct Moment {
    double back, weight;  // back: in lags
  };
  std::vector<Moment> moments(double lag) const;
  std::shared_ptr<const SceneTables> tables_at(int run, const std::vector<double>& values) const;
  // Of those of bodies.
  std::vector<TablesBeside> tables_beside(int run, const std::vector<double>& values) const;
  void choose_steps(int run);
  SensitiveMotion follow(const Window& window, const std::vector<double>& values, const VecX& state,
                         const std::vector<double>& times, bool derivatives) const;
  Vec6 play_displaces(const CalibrationRun& run, double t, const VecX& z) const;
  void evaluate_tangent(const Window& window, const Globals& globals, bool derivatives, WindowResiduals& out) const;
  // How a reading follows the body's pose and the coordinates of the play, to first order; one row used, or three of which the size counts.
  struct ChannelRows {
    Eigen::Matrix<double, 3, 6> by_pose;
    Eigen::Matrix<double, 3, Eigen::Dynamic> rows;
    bool size = false;
  };
  void channel_rows(const CalibrationRun& run, int kind, double t, int n, ChannelRows& out) const;
  void prepare_errors();
  // The parameters of the play's motion, of contacts and of bodies: by_parameters of a motion has a column for each.
  std::vector<int> followed_parameters() const;
  std::function<Parameters(const std::vector<double>&)> with_followed(int run, const std::vector<double>& values) const;
  std::vector<double> followed_values(const std::vector<double>& values) const;
};

}  // namespace boresight
