// A sweep: the same motion at every point of a grid of parameters, on one rung, on several threads.
//
// A point's result depends on the point alone; threads only take turns at points. So results are the same for
// any `jobs`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/runs/kept_results.hpp"
#include "boresight_analyses/sweep/sweep_plan.hpp"

namespace boresight {

struct SweepPoint {
  enum class Status { not_reached, done, failed, interrupted };
  Status status = Status::not_reached;
  std::vector<double> values;  // per axis
  RunResult result;            // of `done`, and as far as it came of `interrupted`
  std::string failure;         // why it failed
};
const char* to_string(SweepPoint::Status status);

struct SweepProgress {
  double done = 0.0;  // points, parts of points included
  std::size_t points = 0;
  double position_error_max_so_far = 0.0;  // over all points [m]
};

struct SweepOptions {
  RunOptions run;  // its `progress` is not used
  int jobs = 1;
  // Called from one thread at a time; return false to stop: points under way are then marked interrupted.
  std::function<bool(const SweepProgress&)> progress;
  // Where points are kept as they are done, and those of an earlier start are found; none: nowhere.
  KeptResults* kept = nullptr;
};

struct SweepResult {
  std::vector<SweepPoint> points;  // in the order of the plan
  bool interrupted = false;
  std::size_t failed = 0;
};

// A point that throws ComputationError is marked failed; the others go on.
SweepResult run_sweep(const Rung& rung, const Mechanism& mechanism, const SweepPlan& plan, const SweepOptions& options);

}  // namespace boresight
