// Impacts part neighbouring motions, until steps a little finer lead somewhere else: past that time the model foretells nothing, and data from
// there tell nothing of its parameters, however well they are fitted before. Fits that were to follow them lost their way in valleys without number,
// and their slopes left no direction in which a parameter was known.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/calibrator.hpp"
#include "boresight_analyses/calibration/landscape.hpp"

namespace boresight {
namespace {

// How far apart steps of a tenth of the tolerance may lead, in play and in standard deviations of the noise.
constexpr double kFiner = 0.1, kOfPlay = 0.001, kOfNoise = 1.0;

// Whether a window's motion at a place can be followed, by steps as fine as the problem's and finer ones; and its last sample up to which these
// agree.
std::optional<int> last_alike(const CalibrationProblem& problem, const Window& w, const Globals& at) {
  CalibrationProblem finer = problem;
  finer.tolerance *= kFiner;
  WindowResiduals here, there;
  const VecX rest = VecX::Zero(problem.state_size(w));
  try {
    problem.evaluate(w, at, rest, false, here);
    finer.evaluate(w, at, rest, false, there);
  } catch (const ComputationError&) {
    return {};
  }
  // As noise_of_steps() has it: of each channel, in its own unit.
  const VecX play = noise_of_steps(problem) / kNoiseOfSteps;
  int last = w.last;
  for (Eigen::Index i = 0; i < here.r.size(); ++i) {
    const int c = here.channel[i];
    const double apart = problem.sigma[c] * std::abs(here.r[i] - there.r[i]);
    if (!(apart <= std::max(kOfPlay * play[c], kOfNoise * problem.sigma[c]))) last = std::min(last, here.sample[i] - 1);
  }
  return last;
}

// The last sample of a window that the motion at a place foretells: two at least.
int last_foretold(const CalibrationProblem& problem, const Window& w, const Globals& at) {
  Window followed = w;
  std::optional<int> last = last_alike(problem, w, at);
  while (!last && followed.last > w.first + 1) {
    followed.last = w.first + 1 + (followed.last - w.first - 1) / 2;
    followed.end = problem.end_of(followed);
    last = last_alike(problem, followed, at);
  }
  return std::max(last.value_or(w.first), w.first + 1);
}

}  // namespace

bool steps_suffice(const CalibrationProblem& part, const Globals& at) {
  return std::all_of(part.windows.begin(), part.windows.end(), [&](const Window& w) {
    return !w.from_rest || w.held_out || last_foretold(part, w, at) == w.last;
  });
}

bool Calibrator::keep_what_is_foretold(const CalibrationProblem& part, const Globals& at) {
  bool all = true;
  for (std::size_t k = 0; k < problem_.windows.size(); ++k) {
    const Window& of_part = part.windows[k];
    if (!of_part.from_rest || of_part.held_out) continue;
    const int last = last_foretold(problem_, of_part, at);
    if (last == of_part.last) continue;
    Window& w = problem_.windows[k];
    left_out_.try_emplace(static_cast<int>(k), w.last);
    w.last = last;
    w.end = problem_.end_of(w);
    all = false;
  }
  return all;
}

void Calibrator::say_what_is_left_out() {
  for (const auto& [k, last] : left_out_) {
    const Window& w = problem_.windows[static_cast<std::size_t>(k)];
    const CalibrationRun& run = problem_.runs[w.run];
    char text[200];
    std::snprintf(
        text, sizeof text,
        ": %d of %d samples are left out, those past %.4g s: impacts part neighbouring motions, and from there on "
        "no step is fine enough to foretell this one",
        last - w.last, last - w.first + 1, run.data.time[w.last]);
    result_.warnings.push_back(run.data.file + text);
  }
}

}  // namespace boresight
