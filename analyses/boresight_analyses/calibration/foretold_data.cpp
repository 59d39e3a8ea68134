// Impacts part neighbouring motions, until steps a little finer lead somewhere else: past that time the model foretells nothing, and data from
// there tell nothing of its parameters, however well they are fitted before. Fits that were to follow them lost their way in valleys without number,
// and their slopes left no direction in which a parameter was known.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/calibrator.hpp"
#include "boresight_analyses/calibration/landscape.hpp"
#include "boresight_analyses/threads/on_threads.hpp"

namespace boresight {
namespace {

// How far apart steps of a tenth of the tolerance may lead, in play and in standard deviations of the noise.
// A search finds its way by steps that lead ten times as far apart.
constexpr double kFiner = 0.1, kOfPlay = 0.001, kOfNoise = 1.0, kOfSearch = 10.0;

// Whether a window's motion at a place can be followed, by steps as fine as the problem's and finer ones; and its last sample up to which
// these agree. times: how much farther apart is near enough.
std::optional<int> last_alike(const CalibrationProblem& problem, const Window& w, const Globals& at, double times) {
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
    if (!(apart <= times * std::max(kOfPlay * play[c], kOfNoise * problem.sigma[c])))
      last = std::min(last, here.sample[i] - 1);
  }
  return last;
}

// The last sample of a window that the motion at a place foretells: two at least.
int last_foretold(const CalibrationProblem& problem, const Window& w, const Globals& at, double times) {
  Window followed = w;
  std::optional<int> last = last_alike(problem, w, at, times);
  while (!last && followed.last > w.first + 1) {
    followed.last = w.first + 1 + (followed.last - w.first - 1) / 2;
    followed.end = problem.end_of(followed);
    last = last_alike(problem, followed, at, times);
  }
  return std::max(last.value_or(w.first), w.first + 1);
}

// The same of every window of `part` from rest, by the steps of `problem`; of the others their own.
std::vector<int> all_last_foretold(const CalibrationProblem& problem, const CalibrationProblem& part, const Globals& at,
                                   double times, int jobs) {
  std::vector<int> last(part.windows.size());
  for_each_on_threads(static_cast<int>(last.size()), jobs, [&](int k) {
    const Window& w = part.windows[static_cast<std::size_t>(k)];
    last[static_cast<std::size_t>(k)] = w.from_rest && !w.held_out ? last_foretold(problem, w, at, times) : w.last;
  });
  return last;
}

}  // namespace

bool steps_suffice(const CalibrationProblem& part, const Globals& at, int jobs) {
  const std::vector<int> last = all_last_foretold(part, part, at, kOfSearch, jobs);
  return std::equal(last.begin(), last.end(), part.windows.begin(), [](int k, const Window& w) { return k == w.last; });
}

bool Calibrator::keep_what_is_foretold(const CalibrationProblem& part, const Globals& at) {
  const std::vector<int> last = all_last_foretold(problem_, part, at, 1.0, options_.jobs);
  bool all = true;
  for (std::size_t k = 0; k < last.size(); ++k) {
    if (last[k] == part.windows[k].last) continue;
    Window& w = problem_.windows[k];
    left_out_.try_emplace(static_cast<int>(k), w.last);
    w.last = last[k];
    w.end = problem_.end_of(w);
    all = false;
  }
  return all;
}

void Calibrator::cut_what_is_held_out(const Globals& at) {
  if (std::none_of(problem_.windows.begin(), problem_.windows.end(), [](const Window& w) { return w.held_out; }))
    return;
  // The motions themselves: what corrects them is a straight line about the fit, and that foretells anything.
  CalibrationProblem plain = problem_;
  plain.corrections.clear();
  for (std::size_t k = 0; k < problem_.windows.size(); ++k) {
    Window& w = problem_.windows[k];
    if (!w.held_out || !w.from_rest || !problem_.follows_play()) continue;
    const int last = last_foretold(plain, w, at, 1.0);
    if (last == w.last) continue;
    result_.warnings.push_back(problem_.runs[w.run].data.file + ": of " + std::to_string(w.last - w.first + 1) +
                               " samples that are held out " + std::to_string(last - w.first + 1) +
                               " are scored, those that a motion of this place foretells");
    w.last = last;
    w.end = problem_.end_of(w);
  }
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
