// How the power of a stationary noise lies over frequency: its one-sided power spectral density S(f) [unit^2/Hz], so that the variance is
//
//     sigma^2 = integral of S(f) df from 0 to infinity
//
// (Bendat and Piersol 2010, Random Data, 5.2.1, where it is called G). Three kinds add up within one band:
//
//     S(f) = white + flicker (1 Hz / f)^exponent + 4 s^2 tau / (1 + (2 pi f tau)^2),     lower <= f <= upper
//
// the last one the noise of first order with deviation s and correlation time tau; or S is a table, straight between its points in the
// logarithms of both, nothing beyond its ends.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace boresight {

struct PowerDensity {
  double white = 0.0;                                      // [unit^2/Hz]
  double flicker = 0.0;                                    // at 1 Hz [unit^2/Hz]
  double exponent = 1.0;                                   // of flicker, positive
  double deviation = 0.0, correlation_time = 0.0;          // of first order: s [unit], tau [s]
  double lower = 0.0;                                      // of the band [Hz]
  double upper = std::numeric_limits<double>::infinity();  // of the band [Hz]
  std::vector<double> frequency = {}, density = {};  // the table [Hz, unit^2/Hz], rising and positive; empty: none

  double at(double f) const;  // f > 0 [Hz]
  // The ends of its band: those of the table where there is one.
  double least() const { return frequency.empty() ? lower : frequency.front(); }
  double most() const { return frequency.empty() ? upper : frequency.back(); }
  // e of S ~ f^e towards zero and towards infinity, if the band goes there.
  double power_at_zero() const;
  double power_at_infinity() const;
  // Frequencies where it is not smooth, or turns [Hz].
  std::vector<double> corners() const;
  // Equal texts are equal densities.
  std::string text() const;
};

}  // namespace boresight
