// How many independent values a series is worth that follows itself, and Akaike's criterion with that number.
//
// The mean of N values with autocorrelations rho_l scatters as that of N / tau independent ones,
//
//   tau = 1 + 2 sum rho_l                                                                   (Bayley, Hammersley 1946)
//
// over the lags before the autocorrelation is lost in its noise. So does whatever a model adds to a fit that changes more slowly
// than the residuals do: its gain in the loss is tau times what white residuals would have given it by chance. With s^2 the
// residuals' variance and K numbers estimated,
//
//   AIC = loss / (s^2 tau) + 2 K + 2 K (K + 1) / (N / tau - K - 1),    s^2 = mean square N / (N - K tau)
//
// A fit takes K tau of N mean squares out of its residuals, and out of their autocorrelations: with b = K tau / N those of the noise
// are b + (1 - b) times those of the residuals.
//
// Akaike (1974); the correction for few values by Hurvich and Tsai (1989); the division by what the data scatter beyond the model
// by Lebreton, Burnham, Clobert, Anderson (1992). s^2 and tau are one pair for all models that are compared, those of the one
// that fits best: what a wrong model leaves follows itself too, and must not excuse it.
#pragma once

#include <vector>

namespace boresight {

// tau, at least 1, of the residuals of a fit of `parameters` numbers to `values`. autocorrelations: by lag, from 0; ends at the
// first that is not above `noise`.
double values_per_independent_one(const std::vector<double>& autocorrelations, double noise, double values,
                                  double parameters);

// mean_square: of the residuals of the model that fits best, of which tau is, and its number of parameters. Infinite where there
// are too few values for so many parameters.
struct ResidualsOfBest {
  double mean_square = 1.0, per_independent_one = 1.0, parameters = 0.0;
};
double akaike(double loss, double values, double parameters, const ResidualsOfBest& best);

}  // namespace boresight
