// The size of the next step from the error of this one.
#pragma once

#include <algorithm>
#include <cmath>

#include "boresight/integrate/integration_options.hpp"

namespace boresight {

// Root mean square of error_i / (absolute_i + relative max(|y0_i|, |y1_i|)): Hairer, Norsett, Wanner (1993), equation
// II.4.11.
inline double error_norm(const VecX& error, const VecX& y0, const VecX& y1, const IntegrationOptions& options) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    const double absolute =
        options.absolute_tolerances.size() > 0 ? options.absolute_tolerances[i] : options.absolute_tolerance;
    const double scaled =
        error[i] / (absolute + options.relative_tolerance * std::max(std::abs(y0[i]), std::abs(y1[i])));
    sum += scaled * scaled;
  }
  return std::sqrt(sum / static_cast<double>(error.size()));
}

// Proportional-integral control. Gustafsson (1991), ACM Transactions on Mathematical Software 17, 533-554; in the form
// of Hairer and Wanner (1996), section IV.2.
class StepControl {
 public:
  StepControl(const IntegrationOptions& options, int error_order) : options_(options), k_(error_order + 1.0) {}

  // After a start or an event the error before says nothing.
  void restart() { before_ = 1e-4; }

  // Factor for the next step.
  double accept(double error) {
    const double e = std::max(error, 1e-10);
    double factor =
        options_.safety * std::pow(e, -(1.0 / k_ - 0.75 * options_.gain)) * std::pow(before_, options_.gain);
    factor = std::clamp(factor, options_.smallest_factor, rejected_ ? 1.0 : options_.largest_factor);
    before_ = std::max(error, 1e-4);
    rejected_ = false;
    return factor;
  }
  // Factor for the next attempt; an error that is not a number asks for the smallest.
  double reject(double error) {
    rejected_ = true;
    const double factor = options_.safety * std::pow(error, -1.0 / k_);
    return factor > options_.smallest_factor ? std::min(factor, options_.safety) : options_.smallest_factor;
  }

 private:
  const IntegrationOptions& options_;
  double k_, before_ = 1e-4;
  bool rejected_ = false;
};

}  // namespace boresight
