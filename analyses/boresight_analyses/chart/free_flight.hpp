// Trajectory error before the first impact: what the ways' own orders show where nothing scatters.
//
// The motion is cut short a little before the reference's first contact, so that its end is an accepted step
// of every way; the error is the distance of the boresight body's position error there from the finest one's,
// over the clearance.
#pragma once

#include "boresight_analyses/chart/setups.hpp"
#include "boresight_analyses/runs/kept_results.hpp"

namespace boresight {

struct FlightPoint {
  RungSetup setup;
  std::string family;
  double error = 0.0;          // over the largest clearance
  double cpu_seconds = 0.0;    // of one run, the least
  double spent_seconds = 0.0;  // of all runs
  std::string refusal;         // "" if it ran
};

struct FreeFlight {
  double first_contact = 0.0;  // [s]
  double end = 0.0;            // of the motion compared [s]
  double rounding = 0.0;       // how far the two finest references are apart, over the clearance
  std::vector<FlightPoint> points;
  std::vector<std::string> left_out;  // families for which there was no time
  std::string why_not;                // why there is nothing to compare; "" where there is
};

// most_seconds: of CPU, beyond which no further family is begun. advance: called before every run; return
// false to stop (throws MeasurementInterrupted).
//
// kept: where points are kept as they are done, and those of an earlier start are found; none: nowhere.
FreeFlight fly(const Mechanism& mechanism, const Parameters& parameters, double own_step, double most_seconds,
               const std::function<bool()>& advance, KeptResults* kept = nullptr);

}  // namespace boresight
