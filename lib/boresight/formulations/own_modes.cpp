#include "boresight/formulations/own_modes.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/math/eigenvalues.hpp"

namespace boresight {
namespace {

// Of differences, relative to turns of a radian and slides of a metre or what they are: truncation falls with its square,
// rounding grows with its inverse.
constexpr double kIncrement = 1e-6;
// Instants along the motion at which the rates are looked at.
constexpr int kInstants = 5;

}  // namespace

double fastest_own_rate(Formulation& formulation, double t, const VecX& y) {
  formulation.forces().replace_contact(
      std::vector<PlayOffsets>(formulation.forces().clearances(), PlayOffsets::Zero()));
  const std::vector<ContactMemory> memory(formulation.forces().clearances());
  const Eigen::Index n = y.size();
  if (n == 0) return 0.0;
  MatX J(n, n);
  VecX before(n), after(n), shifted = y;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double by = kIncrement * std::clamp(std::abs(y[k]), 1e-3, 1.0);
    shifted[k] = y[k] - by;
    formulation.derivative(t, shifted, memory, before);
    shifted[k] = y[k] + by;
    formulation.derivative(t, shifted, memory, after);
    shifted[k] = y[k];
    J.col(k) = (after - before) / (2.0 * by);
  }
  if (!J.allFinite()) return 0.0;
  return Eigen::EigenSolver<MatX>(J, false).eigenvalues().cwiseAbs().maxCoeff();
}

double fastest_own_rate(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal) {
  if (mechanism.description().springs.empty()) return 0.0;
  double fastest = 0.0;
  for (int i = 0; i < kInstants; ++i) {
    const auto formulation = make_tree_formulation(mechanism, parameters, &ideal, {});
    IdealState state;
    ideal.state(mechanism.duration() * i / (kInstants - 1), state);
    VecX y;
    formulation->start(state, y);
    fastest = std::max(fastest, fastest_own_rate(*formulation, state.t, y));
  }
  return fastest;
}

}  // namespace boresight
