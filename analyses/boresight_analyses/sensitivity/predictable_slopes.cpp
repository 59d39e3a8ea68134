#include "boresight_analyses/sensitivity/predictable_slopes.hpp"

#include <cstdio>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/keys/numbers_together.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/perturbation/perturbation_system.hpp"
#include "boresight/perturbation/predictability.hpp"

namespace boresight {
namespace {

std::string beyond(const Predictability& horizon, double duration) {
  char text[240];
  std::snprintf(text, sizeof text,
                "withheld: the motion is predictable for %.3g s of its %.3g s only (impacts part motions that start a "
                "picometre apart), and beyond that its slope says nothing of any change that could be made",
                horizon.horizon, duration);
  return text;
}

}  // namespace

std::vector<double> errors_of_unit(const Mechanism& mechanism, const std::vector<ParameterPath>& places) {
  Parameters without = mechanism.parameters(), with = without;
  for (const ParameterPath& place : places) {
    place.set(without, 0.0);
    place.set(with, 1.0);
  }
  for (std::size_t e = 0; e < with.error.size(); ++e) with.error[e] -= without.error[e];
  return with.error;
}

IndexSlopes predictable_slopes(const std::shared_ptr<const Mechanism>& mechanism,
                               const std::function<Parameters(const std::vector<double>&)>& parameters_at,
                               const std::vector<double>& values, const IndexChoice& index, double start_offset,
                               std::vector<std::vector<double>> errors) {
  const Parameters parameters = parameters_at(values);
  // Each number alone may be in a file; of a mechanism that no file may hold there is no motion to follow.
  if (const auto impossible = impossible_numbers(mechanism->description(), parameters))
    throw ComputationError(impossible->text());
  const Predictability horizon = measure_predictability(mechanism, parameters);
  if (!horizon.measured) throw ComputationError(horizon.refusal);
  if (horizon.parted) throw ComputationError(beyond(horizon, mechanism->duration()));
  const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, parameters), parameters);
  const PerturbationSystem system(*mechanism, parameters, prepared.tables(parameters, prepared.standing(parameters)),
                                  false);
  if (!system.elements().empty()) throw ComputationError("friction with a state (LuGre) carries no derivatives");
  SlopeOptions options;
  // Steps that serve the motion alone leave its derivatives to grow where a journal rests on its sleeve: there they stand at the
  // limit of stability, which only the derivatives' own error tells.
  options.tolerance = 1e-6;
  options.control_derivatives = true;
  options.start_offset = start_offset;
  options.errors = std::move(errors);
  return index_slopes(*mechanism, prepared, parameters_at, values, index, options);
}

}  // namespace boresight
