// The interface of the ladder: a rung is a function from (mechanism, parameters) to a pointing history and its indices.
//
//   auto rung = make_rung("multibody", mechanism);
//   Parameters sample = mechanism->parameters();
//   sample.clearance[0].radial = 2e-4;
//   RunResult result = rung->run(sample, {});
//
// ladder/ladder.hpp makes them by name. What a rung can precompute for a mechanism it does once, on first use; run() is reentrant.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"

namespace boresight {

struct RunProgress {
  double t = 0.0, duration = 0.0;          // simulated time reached and wanted [s]
  double position_error_max_so_far = 0.0;  // running estimate of the index [m]
};

// How closely a rung looks at what it leaves out (ErrorEstimate::model): not at all, where nobody asks; by shares of what acts at some
// instants of its motion, for one of many samples; or by further motions besides, for one that stands alone.
enum class ModelLook { none, shares, motions };

struct RunOptions {
  double step = 0.0;             // [s]; 0: the rung's own choice
  double sample_spacing = 1e-3;  // spacing of the histories [s]; 0: no histories
  std::vector<int> pose_bodies;  // further bodies whose poses are kept
  double frame_spacing = 0.0;    // of the frames, each at a sample [s]; 0: none
  bool events = true;            // keep one ContactEvent per contact
  double start = 0.0;            // indices, contact summaries and peaks leave out what comes before [s]

  // Rungs that follow the motion: integrator_choice.hpp.
  std::string
      integrator;  // "rk4", "dopri5", "rosenbrock", multibody also "generalized-alpha"; "" is the rung's own, rk4
  double tolerance = 0.0;  // of error control: error of one step over the smallest clearance; 0: the rung's own
  // Of the longest step that error control takes on this motion, or of the spacing of the instants that rungs without steps look at.
  double share_of_longest_step = 1.0;
  // Error control follows vibrations that grow from the first (IntegrationOptions::follow_growth): implicit methods otherwise step over
  // them, and so may hold a motion that friction would drive apart.
  bool follow_growth = false;

  // Perturbation only: every coordinate starts this much off the ideal motion [m, or rad], to see how fast neighbours
  // part.
  double start_offset = 0.0;

  ModelLook model_look = ModelLook::motions;  // all but multibody, which is what the others are held against

  // Multibody only.
  std::string formulation;  // "tree" or "paper"; "" is the rung's default, the tree
  std::string
      stabilisation;  // "baumgarte" or "projection"; "" is the formulation's own: paper baumgarte, tree projection
  double baumgarte_alpha = 40.0;  // [1/s], Sun et al. section 4
  double baumgarte_beta = 50.0;   // [1/s]

  // Called now and then; return false to stop early (the result is then marked interrupted and holds what was reached).
  std::function<bool(const RunProgress&)> progress;
};

class Rung {
 public:
  virtual ~Rung() = default;
  virtual std::string name() const = 0;
  // One sentence for the report: what this model does not contain.
  virtual std::string leaves_out() const = 0;
  // Throws ComputationError when the motion cannot be followed (singular pose, unstable step).
  virtual RunResult run(const Parameters& parameters, const RunOptions& options) const = 0;
};

}  // namespace boresight
