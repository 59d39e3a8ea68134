// A stationary Gaussian noise by its spectrum: a power density through transfer functions, and what the error indices keep of it.
//
//     S(f) = |H(i 2 pi f)|^2 S_in(f),       variance of an index = integral of |F(2 pi f)|^2 S(f) df
//
// with the filters F of the windows (window_filter.hpp; ESSB-HB-E-003, 8): exact, in the frequency domain. Where the windows are long
// beside a period, |F|^2 is taken apart into cosines of the window's and the separation's length, whose integrals have rules of their own.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight_analyses/budget/error_index.hpp"
#include "boresight_analyses/budget/power_density.hpp"
#include "boresight_analyses/budget/transfer_function.hpp"

namespace boresight {

class Noise {
 public:
  explicit Noise(PowerDensity density, std::vector<TransferFunction> through = {});

  // Why its variance has no bound, in words that name what would give it one; "" where it has.
  std::string unbounded() const;

  double at(double f) const;                                        // S(f) [unit^2/Hz], f > 0 [Hz]
  double power(double from, double to) const;                       // integral of S between two frequencies [Hz]
  double power_from(double from) const;                             // and from one on
  double variance(ErrorIndex index, const Windows& windows) const;  // windows hold what the index needs
  double least() const { return density_.least(); }                 // of its band [Hz]
  double most() const { return density_.most(); }
  std::vector<double> corners() const { return corners_; }  // where S is not smooth, or turns, ascending [Hz]
  std::string text() const;                                 // equal texts are equal noises

 private:
  std::vector<double> pieces(double from, double to) const;

  PowerDensity density_;
  std::vector<TransferFunction> through_;
  std::vector<double> corners_;
};

using NoisePtr = std::shared_ptr<const Noise>;

}  // namespace boresight
