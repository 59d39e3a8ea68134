#include "boresight/integrate/growth_watch.hpp"

#include <cmath>
#include <complex>
#include <limits>

#include "boresight/math/eigenvalues.hpp"

namespace boresight {
namespace {

// Growth by e in the rest of the motion, and by more than differences make of a vibration that keeps its size.
constexpr double kGrowth = 1.0, kShareOfRate = 1e-3;
// A radian of the vibration a step: methods of any kind follow it so.
constexpr double kRadians = 1.0;

Eigen::Index fastest_that_grows(const Eigen::EigenSolver<MatX>& solver, double rest) {
  Eigen::Index fastest = -1;
  if (solver.info() != Eigen::Success) return fastest;
  for (Eigen::Index i = 0; i < solver.eigenvalues().size(); ++i) {
    const std::complex<double> rate = solver.eigenvalues()[i];
    if (rate.real() * rest > kGrowth && rate.real() > kShareOfRate * std::abs(rate) &&
        (fastest < 0 || std::abs(rate) > std::abs(solver.eigenvalues()[fastest])))
      fastest = i;
  }
  return fastest;
}

}  // namespace

GrowingVibration growing_vibration(const MatX& jacobian, double rest) {
  const GrowingVibration none{std::numeric_limits<double>::infinity(), {}};
  if (!jacobian.allFinite()) return none;
  if (fastest_that_grows(Eigen::EigenSolver<MatX>(jacobian, false), rest) < 0) return none;
  const Eigen::EigenSolver<MatX> solver(jacobian);  // with vectors, which take most of its time
  const Eigen::Index fastest = fastest_that_grows(solver, rest);
  if (fastest < 0) return none;
  return {kRadians / std::abs(solver.eigenvalues()[fastest]), solver.eigenvectors().col(fastest).real()};
}

}  // namespace boresight
