// The least value of a function in a box, under inequality constraints: NLopt (Johnson 2007), a search of the
// whole box followed by a descent from the best place found.
//
//   MinimisationProblem problem{.lower = {0, 0}, .upper = {1, 1}, .start = {0.5, 0.5}};
//   problem.objective = [](std::span<const double> x, std::span<double>) { return x[0] * x[0] + x[1]; };
//   const Minimum minimum = minimise(problem, {});
//
// Variables are scaled to the unit box before NLopt sees them, so that metres and kilograms weigh alike.
// Which algorithm is taken, and why, is part of the result. A constraint g(x) <= 0 should be scaled to the
// order of 1: a violation below `constraint_tolerance` counts as none.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace boresight {

struct MinimisationProblem {
  // `gradient` is empty, or (if `gradients`) to be filled: d value / d x.
  using Function = std::function<double(std::span<const double> x, std::span<double> gradient)>;

  std::vector<double> lower, upper, start;
  Function objective = {};
  std::vector<Function> constraints = {};  // each <= 0
  bool gradients = false;

  std::size_t size() const { return lower.size(); }
};

struct MinimisationOptions {
  std::string global = "auto";             // none, direct-l, crs2, mlsl, isres
  std::string local = "auto";              // none, cobyla, bobyqa, slsqp, mma
  int global_evaluations = 100;            // the most of the global search
  int local_evaluations = 100;             // and of the local one
  double tolerance = 1e-4;                 // of the variables, as a share of their ranges: where the descent ends
  double constraint_tolerance = 1e-8;      // see above
  double initial_step = 0.1;               // the first step of a descent, as a share of the ranges
  unsigned long seed = 1;                  // of the searches that draw random points
  std::function<bool()> interrupted = {};  // looked at before each evaluation
};

struct Minimum {
  std::vector<double> x;
  double objective = 0.0;
  double violation = 0.0;  // the largest constraint, 0 if all hold
  bool converged = false;  // the descent came to rest, or the search was exhausted where there is no descent
  bool interrupted = false;
  int evaluations = 0;        // of the objective
  std::string global, local;  // what was taken, "none" where there was none
  std::string why;            // and why
  std::string stopped;        // why it ended
};

std::vector<std::string> global_algorithms();  // the words, "auto" first
std::vector<std::string> local_algorithms();

// Throws std::invalid_argument for options that contradict each other or the problem (an algorithm that wants
// gradients or cannot take constraints).
Minimum minimise(const MinimisationProblem& problem, const MinimisationOptions& options);

}  // namespace boresight
