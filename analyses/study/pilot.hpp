// The pilot: tries the rungs on the scene at hand and picks the cheapest one, with its step, that meets the accuracy asked of
// the index.
//
// Reference: multibody at half its own step, the median over neighbouring steps; their spread and what the full step gives
// say how far it can be trusted. A trial is a rung at one step, run likewise at neighbouring steps:
//   error of a trial = |median - reference| / |reference| + half the spread of its own runs
// measured as the chart measures (measurement.hpp). A trial may also be an integrator with error control at one tolerance.
// (Impacts scatter single runs, and a study's runs are single). A rung that cannot follow the motion (a singular pose, an
// unstable step) says why and is passed over; one that a large clearance makes inexact fails by its error: the pilot climbs.
// With several sets of parameters (a study's extremes) each trial counts by its worst.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/study/index_choice.hpp"

namespace boresight {

struct PilotTrial {
  std::string rung;
  double step = 0.0;         // [s]; 0 where a rung takes none, or under error control
  std::string integrator = {};  // "" is the rung's own, RK4
  double tolerance = 0.0;       // of error control; 0: none
  double value = 0.0;        // of the index, at the first set of parameters
  double error = 0.0;        // relative, the worst over all sets
  double estimate = 0.0;     // what the rung itself thought of its error
  double cpu_seconds = 0.0;  // of one run
  std::string refusal;       // why it could not be tried; "" if it was
  bool accepted = false;     // meets the accuracy
  bool reference = false;    // multibody at its own step, which the reference was made with
};

struct PilotResult {
  double accuracy = 0.01;
  std::string index;              // in words
  std::string unit;
  double reference = 0.0;         // at the first set of parameters
  double reference_error = 0.0;   // relative, the worst over all sets
  std::vector<PilotTrial> trials;  // in the order they were made, cheapest kind first
  int chosen = -1;                // among trials
  bool met = false;               // the chosen one meets the accuracy
  double cpu_seconds = 0.0;       // of the whole pilot
  std::string why;                // the choice in a sentence
};

struct PilotOptions {
  double accuracy = 0.01;
  IndexChoice index;
  double step = 0.0;  // given by the user: the only one tried
  // Try the integrators with error control too. Whoever asks for it must hand the chosen one's integrator and tolerance on.
  bool integrators = false;
  // Called between trials with their number so far; return false to stop (throws Interrupted).
  std::function<bool(int)> progress;
};

struct PilotInterrupted {};

// Throws ComputationError where not even multibody can follow the motion.
PilotResult run_pilot(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                      const PilotOptions& options);

}  // namespace boresight
