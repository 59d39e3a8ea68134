#include "boresight/perturbation/missed_at_rest.hpp"

#include "boresight/mechanism/error.hpp"
#include "boresight/multibody/multibody_start.hpp"
#include "boresight/scene/resting_start.hpp"

namespace boresight {

MissedAtRest missed_at_rest(const Mechanism& mechanism, const PreparedScene& prepared, const Parameters& parameters,
                            bool want_start) {
  if (mechanism.description().journals == JournalStart::centred) return {};
  const RestingBodies resting = resting_bodies(mechanism, parameters, prepared.ideal());
  if (resting.linear.size() == 0) return {};  // then this rung starts centred, and says so
  if (resting.exact.empty()) throw ComputationError(resting.refusal);
  IdealState state;
  prepared.ideal().state(0.0, state);
  const int body = mechanism.boresight_body();
  MissedAtRest missed;
  missed.pose = DisplacementSizes(mechanism, state.bodies[body])(displacement(state.bodies[body], resting.exact[body]) -
                                                                 Vec6(resting.linear.segment<6>(6 * body)));
  if (!want_start) return missed;
  const std::shared_ptr<const SceneTables> tables = prepared.tables(parameters);
  std::string warning;
  missed.start = -start_coordinates(mechanism, tables->layout, tables->start,
                                    joint_plays(mechanism.description(), parameters), warning);
  const DeviationCoordinates::Deviation exact = prepared.scene().coordinates().deviation(state, resting.exact, {});
  missed.start.head(exact.z.size()) += exact.z;
  missed.start.tail(exact.z.size()) += exact.z_dot;
  return missed;
}

}  // namespace boresight
