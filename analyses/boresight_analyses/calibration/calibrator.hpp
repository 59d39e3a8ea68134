// One calibration under way: what calibrate() goes through, step by step.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "boresight_analyses/calibration/calibrate.hpp"
#include "boresight_analyses/calibration/channel_noise.hpp"

namespace boresight {

// Thrown out of a fit when the user has interrupted it.
struct CalibrationInterrupted {};

class Calibrator {
 public:
  Calibrator(CalibrationProblem& problem, const CalibrationOptions& options);

  CalibrationResult run();

 private:
  void warn_of(const OutlyingReading& reading, const std::string& what_becomes_of_it);
  void name_outliers();
  void name_unexplained_channels();

  // Standing errors alone, at poses: nearly linear, so that one start is enough. Noise that is not given is estimated until it settles.
  void fit_poses();
  void judge_poses();
  void warn_of_play();

  // A fit that has lost its way leaves more than the noise that neighbouring samples show.
  void judge_fit();

  bool noise_is_told(int channel) const;  // channel: among the problem's
  void set_noise(const VecX& sigma);

  // How far the fit has come, of 1, by what its stages take as a rule: a horizon that grows takes as long as what it has reached. Nothing is
  // done twice: it goes back only where windows are gone that nobody could foresee.
  enum class Done { starts, horizon, whole_data, corrections, all };
  static double share_at(Done what);
  void reach(double share) { reached_ = std::max(reached_.load(), share); }
  void reach(Done what) { reach(share_at(what)); }
  void tell(const std::string& stage, const std::string& estimate);

  FitOptions fit_options(const std::string& stage, int iterations, int jobs);

  void note(FitResult fit);

  // Starts on a short horizon, and from the best of them on to the whole; from the next best, and from more
  // starts, where that one loses its way. Where all do, the model does not explain the data, and the best
  // start's fit stands.
  void search();

  static constexpr double kStartsShare = 0.125;  // of the horizon
  // A place lower by this share of s^2 is gone to. Below it intervals are at most a tenth too wide.
  static constexpr double kLower = 1.0;

  struct Descent {
    Globals from, to;
    double cost = 0.0;
    long evaluations = 0;
  };

  // The start given, and others within a factor of two of it (restitution: one in the logit).
  Globals start(int number) const;

  // `count` more of them, side by side.
  void try_starts(const CalibrationProblem& part, int count, std::vector<Descent>& tried);

  // On a horizon that grows from that of the starts to the whole (growing_horizon.cpp). give_up: returns false as soon as the place is
  // lost.
  bool grow(const Globals& at, bool give_up);
  // One such path: fits to the whole data, the lowest first; none where it is lost. path: of those that are always gone, or none of them.
  std::vector<FitResult> grown(const Globals& at, double most_growth, bool give_up, std::size_t path);
  // While the horizon grows: data that the motion at a place no longer foretells are left out from there on (foretold_data.cpp). Whether none were.
  bool keep_what_is_foretold(const CalibrationProblem& part, const Globals& at);
  // The same of windows that are held out, which no fit has cut.
  void cut_what_is_held_out(const Globals& at);
  void score_what_is_held_out();
  void say_what_is_left_out();
  // By all data from the first, in windows that grow until they are half of a run (growing_windows.cpp); none where one cannot be followed. from, to: the share of the fit that it is.
  std::optional<Globals> joined(const Globals& at, double from, double to);
  // Whether that leads to a lower place; goes there.
  bool leads_lower();
  // Side by side. rough: as where the horizon goes on growing.
  std::vector<FitResult> fits_from(const CalibrationProblem& part, const std::vector<Globals>& starts,
                                   const std::string& stage, bool rough);
  // Of fits, the lowest first: their places, each once, without those that are hopeless beside it.
  std::vector<Globals> distinct_places(const std::vector<FitResult>& ended, const Inference& at_lowest) const;

  // Before the search: masses that the data know better than they were told become parameters (fitted_masses.cpp).
  void fit_masses_that_show();

  // Goes on from other valleys until none leads lower.
  void stabilise(const std::string& stage);

  // Intervals by the loss itself. Where a profile comes by a lower place than the optimum, that is the
  // optimum.
  void profile();

  // What the fit's answer is worth.
  void weigh_fit();
  // Errors and intervals of a model that may be wrong.
  void weigh_model_error();

  // Draws of the posterior, where they are asked for.
  void draw();

  Inference infer_now() const;

  void refit(const std::string& stage);

  // Restitution is a matter of impacts alone: where none is seen in its joints, no fit can know it.
  void hold_what_no_impact_shows();
  void explain_what_is_held();

  // First an offset, multibody less the fit's rung at the optimum. From there on multibody's own value and
  // slopes, until that moves nothing that matters; slopes are taken anew where the fit has left the width
  // over which they were taken.
  void correct();

  CalibrationProblem& problem_;
  const CalibrationOptions& options_;
  CalibrationResult result_;
  std::vector<std::pair<int, std::string>> held_;
  std::vector<Globals> optima_;     // where fits to the whole data have ended
  std::vector<Globals> path_ends_;  // of the search
  std::vector<Suspect> suspects_;
  std::map<int, int> left_out_;        // by window, its last sample before data were left out
  std::uint64_t looked_beside_ = 0;    // how many places, while horizons grew
  std::atomic<double> reached_ = 0.0;  // see reach()
  std::mutex mutex_;
};

}  // namespace boresight
