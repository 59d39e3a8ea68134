// The other way to the whole data: all of them from the first, in windows that grow. A short window has a start state of its own, so that no
// impact before it bends its loss, and all windows together know the parameters well before two and two of them are joined: a horizon that
// grows from a short one knows less at first, and may lead into a valley beside the right one (multiple shooting, Bock 1981; for chaotic
// motions Voss, Timmer and Kurths 2004, International Journal of Bifurcation and Chaos 14, 1905-1933). It takes several times as long: gone where
// runs or stretches contradict each other at the end, as they do in wrong valleys.
#include <algorithm>
#include <cmath>

#include "boresight_analyses/calibration/calibrator.hpp"
#include "boresight_analyses/calibration/landscape.hpp"

namespace boresight {
namespace {

// Values that the shortest window has for each number of its start state.
constexpr int kValuesPerState = 5;
constexpr int kMostHalvings = 6;

// Each window from rest that counts in 2^halvings: those of any number of halvings end where those of fewer do.
CalibrationProblem in_pieces(const CalibrationProblem& whole, int halvings) {
  CalibrationProblem part = whole;
  part.windows.clear();
  part.corrections.clear();  // they are of motions from rest
  const int pieces = 1 << halvings;
  for (const Window& w : whole.windows) {
    if (!w.from_rest || w.held_out) {
      part.windows.push_back(w);
      continue;
    }
    const int samples = w.last - w.first + 1;
    for (int k = 0; k < pieces; ++k) {
      Window piece = w;
      piece.first = w.first + samples * k / pieces;
      piece.last = w.first + samples * (k + 1) / pieces - 1;
      if (k > 0) {
        piece.from_rest = false;
        piece.start = whole.start_of(piece);
      }
      piece.end = whole.end_of(piece);
      part.windows.push_back(piece);
    }
  }
  return part;
}

// How often every window can be halved.
int most_halvings(const CalibrationProblem& whole) {
  int halvings = kMostHalvings;
  for (const Window& w : whole.windows) {
    if (!w.from_rest || w.held_out) continue;
    const auto values =
        whole.runs[w.run].data.value.middleRows(w.first, w.last - w.first + 1).array().isFinite().count();
    const double windows = std::min(static_cast<double>(values) / (kValuesPerState * std::max(1, whole.state_size(w))),
                                    0.5 * (w.last - w.first + 1));  // each has two samples or more
    halvings = std::min(halvings, windows < 1.0 ? 0 : static_cast<int>(std::floor(std::log2(windows))));
  }
  return halvings;
}

// Start states of `next`, whose windows each begin where one of `part` does: as they were found there.
std::vector<VecX> carried_on(const CalibrationProblem& part, const FitResult& found, const CalibrationProblem& next) {
  std::vector<VecX> states;
  for (const int w : windows_of(next, {})) {
    const Window& of = next.windows[w];
    for (std::size_t k = 0; k < found.windows.size(); ++k) {
      const Window& had = part.windows[found.windows[k]];
      if (had.run == of.run && had.first == of.first) states.push_back(found.states[k]);
    }
  }
  return states;
}

}  // namespace

std::optional<Globals> Calibrator::joined(const Globals& at, double from, double to) {
  const CalibrationProblem whole = searched_up_to(problem_, 1.0);
  Globals place = at;
  std::vector<VecX> states;  // the first ones are guessed
  const int most = most_halvings(whole);
  for (int halvings = most; halvings > 0; --halvings) {
    reach(std::lerp(from, to, static_cast<double>(most - halvings) / most));
    const CalibrationProblem part = in_pieces(whole, halvings);
    FitResult found =
        fit(part, place, std::move(states),
            fit_options("windows of 1/" + std::to_string(1 << halvings) + " of a run", 30, options_.jobs));
    if (found.interrupted) throw CalibrationInterrupted{};
    result_.evaluations += found.evaluations;
    if (!std::isfinite(found.cost)) return {};
    place = found.globals;
    states = carried_on(part, found, in_pieces(whole, halvings - 1));
  }
  return place;
}

bool Calibrator::leads_lower() {
  if (!follows_from_rest(problem_)) return false;
  // Multibody's corrections hold about one place: two are compared without.
  CalibrationProblem plain = searched_up_to(problem_, 1.0);
  plain.corrections.clear();
  // It takes as long as all before it.
  reached_ = 0.5 * reached_;
  const double from = reached_, to = share_at(Done::corrections);
  const auto fitted = [&](const Globals& at) {
    return std::move(fits_from(plain, {at}, "windows joined", true).front());
  };
  const FitResult here = fitted(result_.fit.globals);
  // Where the search's paths have ended lie the windows' fits in different valleys too.
  std::vector<Globals> starts = path_ends_;
  starts.push_back(result_.fit.globals);
  std::optional<FitResult> lowest;
  for (std::size_t k = 0; k < starts.size(); ++k) {
    const auto share = [&](std::size_t done) {
      return std::lerp(from, to, static_cast<double>(done) / static_cast<double>(starts.size()));
    };
    const std::optional<Globals> place = joined(starts[k], share(k), share(k + 1));
    if (!place) continue;
    FitResult found = fitted(*place);
    path_ends_.push_back(found.globals);
    optima_.push_back(found.globals);
    if (!lowest || found.cost < lowest->cost) lowest = std::move(found);
  }
  if (!lowest || !(lowest->cost < here.cost - kLower * result_.inference.variance_factor)) return false;
  problem_.corrections.clear();
  note(fit(problem_, lowest->globals, {}, fit_options("windows joined", 15, options_.jobs)));
  return true;
}

}  // namespace boresight
