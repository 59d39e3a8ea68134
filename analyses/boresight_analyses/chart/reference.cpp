#include "boresight_analyses/chart/reference.hpp"

#include <cmath>
#include <limits>

#include "boresight/mechanism/error.hpp"

namespace boresight {

Reference find_reference(const Rung& multibody, const Parameters& parameters, const ReferenceOptions& options) {
  constexpr int kMostRefinements = 8;
  RungSetup setup{.rung = "multibody", .formulation = "tree", .stabilisation = "projection", .integrator = "rk4"};
  Reference reference;
  reference.uncertainty = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostRefinements; ++k) {
    const Measurement m =
        options.measured ? options.measured(setup) : measure(multibody, parameters, setup, options.measure);
    reference.cpu_seconds += m.spent_seconds;
    if (!m.refusal.empty()) {
      if (reference.refinements.size() < 2) throw ComputationError(m.refusal);
      break;
    }
    if (k == 0) reference.own_step = m.step;
    const double change =
        reference.refinements.empty() ? std::numeric_limits<double>::infinity() : std::abs(m.value - reference.value);
    reference.refinements.push_back({m.step, m.value, m.half_spread});
    reference.value = m.value;
    if (std::isfinite(change))
      reference.uncertainty = m.value != 0.0 ? (change + 0.5 * m.half_spread) / std::abs(m.value) : 0.0;
    setup.step = 0.5 * m.step;
    // The next one costs twice as much again.
    if (k > 0 && (reference.uncertainty < options.target ||
                  reference.cpu_seconds + 2.0 * m.spent_seconds > options.most_seconds))
      break;
  }
  return reference;
}

}  // namespace boresight
