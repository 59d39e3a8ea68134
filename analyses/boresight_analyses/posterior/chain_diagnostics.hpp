// Whether chains have come to the same density, and how many independent draws theirs are worth.
//
// Every chain is cut in half, values become the normal scores of their ranks, so that nothing needs a variance:
//
//   z = Phi^-1((rank - 3/8) / (S + 1/4))
//   R-hat = sqrt(((n - 1) / n W + B / n) / W)      within and between chains; of z, and of the ranks of |x - median|: the larger
//   ESS   = S / (1 + 2 sum rho_t)                  Geyer's initial monotone sequence of the pooled autocorrelation
//
// Vehtari, Gelman, Simpson, Carpenter, Buerkner (2021), Rank-normalization, folding, and localization: an improved R-hat for
// assessing convergence of MCMC, Bayesian Analysis 16, 667-718, equations 1 to 16. They ask for R-hat below 1.01 and for an ESS of 400.
#pragma once

#include <vector>

namespace boresight {

// draws[chain][k] of one quantity; chains of one length, of at least 8.
struct ChainDiagnostics {
  double r_hat = 0.0;     // NaN where all draws are alike
  double bulk_ess = 0.0;  // of the normal scores: for the mean and the middle
  double tail_ess = 0.0;  // the less of those of the 5 % and the 95 % quantile
};
ChainDiagnostics chain_diagnostics(const std::vector<std::vector<double>>& draws);

// Of the draws themselves, split but not ranked: for the Monte Carlo error of their mean.
double mean_ess(const std::vector<std::vector<double>>& draws);

}  // namespace boresight
