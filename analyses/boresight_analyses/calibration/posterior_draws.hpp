// Draws of what a calibration's parameters may be (posterior_density.hpp), by tempered Hamiltonian Monte Carlo
// (posterior/sample_posterior.hpp), with what says whether they can be relied on.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight_analyses/calibration/posterior_density.hpp"

namespace boresight {

struct DrawOptions {
  int draws = 1600;      // of all chains together
  int chains = 4;        // ladders beside one another
  int temperatures = 5;  // of each, the reference and the target among them
  int warm_up = 150;     // iterations
  int thin = 1;          // iterations for one draw
  // How much wider than the density would be by its curvature the reference is, from which chains start and are drawn afresh.
  double reach = 3.0;
};

// One sampled quantity, SI.
struct DrawnQuantity {
  std::string name, si_unit, written_unit;
  double mean = 0.0, deviation = 0.0, low = 0.0, median = 0.0, high = 0.0;  // low, high: at the confidence
  double r_hat = 0.0, bulk_ess = 0.0, tail_ess = 0.0;                       // chain_diagnostics.hpp
};

struct PosteriorDraws {
  std::vector<DrawnQuantity> quantities;
  MatX values;  // draws x quantities, ladder after ladder
  std::vector<double> beta, acceptance, swap_rejection;
  double barrier = 0.0;
  int restarts = 0;
  long evaluations = 0;
  // R-hat below 1.01 and an effective size of 400, as Vehtari and others (2021) ask.
  bool settled = false;
  std::string says;
};

// spread: covariance of the sampled globals by which other optima lie off; zero where there are none. progress: return false to stop, and
// nothing is returned. What is kept (problem.kept) goes on where it was. Throws ComputationError.
std::optional<PosteriorDraws> posterior_draws(
    const CalibrationProblem& problem, const PosteriorDensity& density, const MatX& spread, double confidence,
    const DrawOptions& options, std::uint64_t seed, int jobs,
    const std::function<bool(double share, const std::string& estimate)>& progress);

// A row for each draw, columns called as the parameters, SI: what `rows` of a [[random]] table reads.
std::string csv_of(const PosteriorDraws& draws);
// That table, for the parameters of the mechanism; `file`: of the rows.
std::string posterior_toml(const PosteriorDraws& draws, const CalibrationProblem& problem, const std::string& file);

}  // namespace boresight
