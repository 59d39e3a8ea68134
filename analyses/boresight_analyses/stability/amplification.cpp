#include "boresight_analyses/stability/amplification.hpp"

#include <cmath>
#include <complex>
#include <limits>

#include "boresight/math/orthogonal_factors.hpp"

namespace boresight {
namespace {

using Complex = std::complex<double>;
constexpr double kNoFrequency = std::numeric_limits<double>::quiet_NaN();

}  // namespace

double theoretical_growth(const MethodCoefficients& method, double alpha_h, double beta_h) {
  const Complex root = std::sqrt(Complex(alpha_h * alpha_h - beta_h * beta_h, 0.0));
  return std::max(std::abs(stability_function(method, -alpha_h + root)),
                  std::abs(stability_function(method, -alpha_h - root)));
}

double theoretical_limit(const MethodCoefficients& method, double zeta) {
  if (zeta <= 1.0) return stability_limit(method, Complex(-zeta, std::sqrt(1.0 - zeta * zeta)));
  return stability_limit(method, Complex(-1.0, 0.0)) / (zeta + std::sqrt(zeta * zeta - 1.0));
}

double measured_growth(const std::vector<double>& signal) {
  const Eigen::Index equations = static_cast<Eigen::Index>(signal.size()) - 2;
  if (equations < 2) return kNoFrequency;
  Eigen::Matrix<double, Eigen::Dynamic, 2> A(equations, 2);
  VecX b(equations);
  double size = 0.0;
  for (Eigen::Index n = 0; n < equations; ++n) {
    const double here = std::hypot(signal[n], signal[n + 1], signal[n + 2]);
    if (!std::isfinite(here)) return kNoFrequency;
    size = std::max(size, here);
    if (size == 0.0) return kNoFrequency;
    A.row(n) << signal[n + 1] / size, -signal[n] / size;
    b[n] = signal[n + 2] / size;
  }
  const Eigen::Vector2d pq = A.colPivHouseholderQr().solve(b);
  const Complex root = std::sqrt(Complex(0.25 * pq[0] * pq[0] - pq[1], 0.0));
  return std::max(std::abs(0.5 * pq[0] + root), std::abs(0.5 * pq[0] - root));
}

double measured_limit(const std::function<double(double)>& growth, double guess) {
  const double stride = 0.02 * guess;
  for (double low = 0.89 * guess; low < 1.2 * guess; low += stride) {
    if (growth(low) > 1.0) return low == 0.89 * guess ? kNoFrequency : low;
    double a = low, b = low + stride;
    if (!(growth(b) > 1.0)) continue;
    while (b - a > 1e-5 * guess) {
      const double middle = 0.5 * (a + b);
      (growth(middle) > 1.0 ? b : a) = middle;
    }
    return 0.5 * (a + b);
  }
  return kNoFrequency;
}

}  // namespace boresight
