// Exact slopes of an index by parameters of the contacts and by standing errors, from one motion of the perturbation rung with its
// derivatives carried through impacts (sensitive_motion.hpp). With e(t) the error at a time and e' = de/dq,
//
//   mean = (1/T) int e dt          d mean / dq = (1/T) int e' dt
//   rms^2 = (1/T) int e^2 dt       d rms / dq = (1/T) int e e' dt / rms
//   max = e(t_m)                   d max / dq = e'(t_m), as de/dt = 0 there (or t_m is an end)
//
// The integrals are those of the indices themselves (indices.hpp): trapezoids over the points of time.
// The 99.73 % value is e at one of these, and its slope e' there.
//
// A standing error displaces the pose beside the motion's deviation and does not change that, to first order: its e' is closed form.
//
// They are slopes of this very motion, in the limit of a vanishing change: over many impacts they grow
// without bound, as neighbouring motions part, and then say nothing of a finite change. How the maximum moves
// to another impact they do not see.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight_analyses/study/index_choice.hpp"

namespace boresight {

struct SlopeOptions {
  double end = 0.0;                  // [s]; 0: the mechanism's duration
  VecX start_state;                  // offsets and rates, of no parameter; empty: as the file has the journals start
  double start_offset = 0.0;         // of every coordinate besides [m, or rad]
  int points = 4000;                 // of time
  double tolerance = 1e-3;           // of a step, over the smallest clearance
  bool control_derivatives = false;  // hold the derivatives to it too
  // Further slopes, by standing errors: what a unit of each changes all errors by, in the order of the description.
  std::vector<std::vector<double>> errors = {};
};

struct IndexSlopes {
  double value = 0.0;      // of the index [SI]
  std::vector<double> by;  // per parameter, then per entry of SlopeOptions::errors [SI]; NaN where there is none
  std::vector<std::string> why_not = {};  // one an entry of by: why there is none; "": there is, or it overflows
  int impacts = 0, grazing = 0;           // grazing: contacts that a change of the parameters may undo
};

// parameters_at: the mechanism's parameters at values > 0 of those varied, which may change numbers of the
// contacts only (every "clearance." path). Throws ComputationError where the motion cannot be followed, and Interrupted.
IndexSlopes index_slopes(const Mechanism& mechanism, const PreparedScene& prepared,
                         const std::function<Parameters(const std::vector<double>&)>& parameters_at,
                         const std::vector<double>& values, const IndexChoice& index, const SlopeOptions& options);

}  // namespace boresight
