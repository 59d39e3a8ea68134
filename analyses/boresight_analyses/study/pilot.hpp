// The pilot: tries the rungs on the scene at hand and picks the cheapest way of computing it that meets the accuracy asked
// of the index. A way is a rung with its integrator and its step or tolerance, or a rung on SIMD lanes.
//
// The reference is multibody at half its own step; what its own step gives against that says how far it can be trusted. A
// reference that is worse than the accuracy is said to be, and then nothing meets the accuracy: the cheapest way is taken
// that cannot be told from multibody within what multibody itself is good to. Two questions differ:
//
//   one motion    (`run`, the corners of a sweep or of a design): the index of this motion. Each way is run at
//                 neighbouring steps, for impacts scatter single runs; error = what a single run is off by from the mean
//                 of the reference's neighbours, with 95 percent confidence. Several motions count by the worst.
//   the scatter   (studies): the mean, or a quantile, of the index over parameters that scatter. Ways compute the same
//                 samples and are compared pair by pair (scatter_comparison.hpp); pairs are added until the answer is
//                 clear or the time is spent. error = |difference| + half of its 95 percent interval.
//
// Where no joint has play and standing errors alone move the boresight, all of it is geometry. The rungs but multibody are then one way,
// linear in the errors; multibody closes the joints exactly, and is what that is held against, in the same two questions.
//
// A rung that cannot follow the motion (a singular pose, an unstable step) says why and is passed over; one that a large
// clearance makes inexact fails by its error: the pilot climbs.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/study/index_choice.hpp"
#include "boresight_analyses/study/scatter_comparison.hpp"

namespace boresight {

struct PilotTrial {
  std::string rung;
  double step = 0.0;            // [s]; 0 where a rung takes none, or under error control
  std::string integrator = {};  // "" is the rung's own, RK4
  double tolerance = 0.0;       // of error control; 0: none
  bool lanes = false;           // on SIMD lanes, which control their error by the tolerance
  double value = 0.0;           // of the index at the first motion, or of its statistic over the scatter
  double error = 0.0;           // relative, with 95 percent confidence; the worst over all motions
  double difference = 0.0;      // of it: how far the means, or statistics, are apart
  double estimate = 0.0;        // what the rung itself thought of its error
  double cpu_seconds = 0.0;     // of one run
  std::size_t pairs = 0;        // of the scatter
  std::string refusal;          // why it could not be tried; "" if it was
  bool accepted = false;        // meets the accuracy
  bool reference = false;       // multibody at its own step, which the reference was made with
};

struct PilotResult {
  double accuracy = 0.01;
  bool geometry = false;  // no play: errors added up linearly, held against joints closed exactly
  std::string index;      // in words
  std::string unit;
  double reference = 0.0;        // as PilotTrial::value
  double reference_error = 0.0;  // relative, with 95 percent confidence; the worst over all motions
  double scatter = 0.0;   // one motion: what single runs of the reference scatter by, standard deviation, relative
  std::size_t pairs = 0;  // samples of the scatter that were compared; 0: single motions were
  std::vector<PilotTrial> trials;  // in the order they were made, cheapest kind first
  int chosen = -1;                 // among trials
  // Over the scatter: what the chosen way is off by in every statistic that a study may report, and in the mean
  // (probability 0), relative, with 95 percent confidence.
  struct ErrorOfStatistic {
    double probability = 0.0, error = 0.0;
  };
  std::vector<ErrorOfStatistic> errors;
  bool met = false;          // the chosen one is shown to meet the accuracy
  double cpu_seconds = 0.0;  // of the whole pilot
  std::string why;           // the choice in a sentence
};

struct PilotOptions {
  double accuracy = 0.01;
  IndexChoice index;
  // Over the scatter of the samples; nothing: each sample is a motion of its own.
  std::optional<ScatterStatistic> statistic = {};
  // Given by the user: the only ones tried.
  double step = 0.0;
  std::string integrator = {};
  double tolerance = 0.0;
  // Try the integrators with error control too, and lanes. Whoever asks for either must hand what was chosen on.
  bool integrators = false, lanes = false;
  bool scene_varies = true;    // over the scatter: whether more than contacts does
  std::uint64_t runs = 0;      // that the study will make: the pilot's time is bounded by theirs; 0: not known
  double most_seconds = 20.0;  // of CPU, or a tenth of what the study's runs would take on multibody, if that is more
  int jobs = 1;
  // Called between runs with their number so far; return false to stop (throws PilotInterrupted).
  std::function<bool(int)> progress;
};

struct PilotInterrupted {};

// Throws ComputationError where not even multibody can follow the motion.
PilotResult run_pilot(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                      const PilotOptions& options);

}  // namespace boresight
