// The part that each standing error has in where the boresight body is and points: its column of influence times its value,
// G_e(t) eps_e (scene/standing_errors.hpp). Parts are of first order and add up; what a motion is off by beside them is play and what
// errors do together or by their size.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/pointing/indices.hpp"
#include "boresight/rungs/run_result.hpp"
#include "boresight/scene/standing_errors.hpp"

namespace boresight {

// What one unit of each error does to the boresight body over the commanded motion.
class ErrorColumns {
 public:
  // Throws ComputationError where nothing is known of any of them: freedoms that nothing drives, a singular pose.
  ErrorColumns(const Mechanism& mechanism, const IdealMotion& commanded);

  // Why an error, by its place in the file, has no column that tells what it does: the mechanism cannot take it up without straining, or its
  // play takes it up, and then where all journals rest says what it does; "": it has one.
  std::string refusal(std::size_t error) const;
  // Displacement and turn, world axes, per unit of each error [m and rad, per m, rad or K]: 6 x errors.
  MatX at(double t) const;
  // Times from `start` to `end`, close enough for statistics of the columns over time [s].
  std::vector<double> times(double start, double end) const;

 private:
  const Mechanism& mechanism_;
  std::shared_ptr<const StandingErrors> influence_;
  int body_;
};

// Why such an error has no column, in words.
std::string taken_up_by_play(const MechanismDescription& mechanism, std::size_t error);

// A small displacement and turn of the body, world axes, as error_vector() of pointing/indices.hpp counts them, to first order.
Vec3 linear_error_vector(PointingQuantity quantity, const Vec6& displacement, const Pose& ideal,
                         const Pointing& pointing, double length);

struct ErrorPart {
  std::string name, unit;   // "error.rod1.length"; "m", "rad", "K" or "1" of a scale
  double value = 0.0;       // [SI]
  PointingIndices index;    // of this error alone
  std::vector<Vec6> poses;  // at the run's samples: displacement and turn, world axes [m, rad]
  // Of the motion's mean squares over its samples, in the sense of Euler's allocation: E[part . error] / E[error . error]. They
  // add up to 1 with those of what is left, and are negative where a part cancels others.
  double position_share = 0.0, boresight_share = 0.0;
};

struct ErrorParts {
  // Of the errors that are not zero. First those whose RMS is the largest share of the largest one, of the position or of the boresight.
  std::vector<ErrorPart> parts;
  ErrorPart rest;                         // what the motion is off by beside them
  std::vector<std::string> without_part;  // a sentence for each error that has none
};

// `run`: of the mechanism with these parameters, on any rung. Throws ComputationError as ErrorColumns does.
ErrorParts parts_of_errors(const Mechanism& mechanism, const Parameters& parameters, const RunResult& run);

}  // namespace boresight
