#include "boresight/scene/standing_model_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/ideal_solver.hpp"

namespace boresight {
namespace {

constexpr double kRoundingOfPoses = 1e-12;  // of poses [m or rad]

// Instants that are looked at, both ends among them, each the knot before it: no two of them lie alike in a period of the motion, as the
// number of gaps between them is prime. Where the errors displace most, as beside a singular pose, more is missed in a moment than elsewhere in all
// the motion: from there on it is looked for, in strides of this share of the motion at first, halved where they lead to nothing more.
constexpr int kInstants = 14;
constexpr int kStridesOfMotion = 64;
// Below this share of the others an index counts as next to nothing.
constexpr double kNextToNoError = 1e-4;

// The knots at which errors displace the boresight body most, and any of the bodies, on the mechanism's size.
std::array<int, 2> of_most_displacement(const Mechanism& mechanism, const StandingErrors& influence,
                                        const Eigen::Ref<const VecX>& errors) {
  Vec6 scale;
  scale << Vec3::Constant(1.0 / mechanism.characteristic_length()), Vec3::Ones();
  std::array<int, 2> knots = {0, 0};
  std::array<double, 2> most = {0.0, 0.0};
  for (int k = 0; k <= influence.cells(); ++k)
    for (int b = 0; b < mechanism.bodies(); ++b) {
      const double moved = (scale.asDiagonal() * (influence.at_knot(k, b) * errors)).norm();
      for (std::size_t i = b == mechanism.boresight_body() ? 0 : 1; i < knots.size(); ++i)
        if (moved > most[i]) {
          most[i] = moved;
          knots[i] = k;
        }
    }
  return knots;
}

}  // namespace

std::optional<PoseError> missed_by_linearity(const Mechanism& mechanism, const IdealMotion& ideal,
                                             const StandingErrors& influence, const Parameters& parameters) {
  const int boresight = mechanism.boresight_body();
  const Eigen::Map<const VecX> errors(parameters.error.data(), static_cast<Eigen::Index>(parameters.error.size()));
  PoseError missed;
  try {
    // The solver asks for drives' laws alone of what was commanded, which outlives it here.
    const std::shared_ptr<const IdealMotion> commanded(std::shared_ptr<const IdealMotion>(), &ideal);
    const auto built = built_mechanism(mechanism, parameters, commanded);
    IdealSolver solver(*built);
    std::map<int, double> seen;  // by knot, what is missed there, on the mechanism's size
    bool closed = true;
    const auto look = [&](int knot) {
      if (const auto known = seen.find(knot); known != seen.end()) return known->second;
      const double t = std::min(mechanism.duration(), knot * influence.spacing());
      IdealState state;
      ideal.state(t, state);
      for (int b = 0; b < mechanism.bodies(); ++b) displace(state.bodies[b], influence.at_knot(knot, b) * errors);
      const BodyMotion linear = state.bodies[boresight];
      if (!solver.solve(t, state)) {
        closed = false;
        return 0.0;
      }
      const BodyMotion& exact = state.bodies[boresight];
      const PoseError off = pose_error({exact.p, Quat(exact.R)}, {linear.p, Quat(linear.R)}, mechanism.pointing());
      missed.position = std::max(missed.position, off.position);
      missed.orientation = std::max(missed.orientation, off.orientation);
      missed.boresight = std::max(missed.boresight, off.boresight);
      missed.line_of_sight = std::max(missed.line_of_sight, off.line_of_sight);
      return seen[knot] = off.position / mechanism.characteristic_length() + off.orientation;
    };
    for (int i = 0; i < kInstants && closed; ++i) look(i * influence.cells() / (kInstants - 1));
    for (int knot : of_most_displacement(mechanism, influence, errors)) {
      double most = look(knot);
      for (int stride = std::max(1, influence.cells() / kStridesOfMotion); stride > 0 && closed;) {
        const int before = std::max(0, knot - stride), after = std::min(influence.cells(), knot + stride);
        const int better = look(before) > look(after) ? before : after;
        if (look(better) > most) {
          knot = better;
          most = look(better);
        } else {
          stride /= 2;
        }
      }
    }
    if (!closed) return {};
  } catch (const ComputationError&) {
    return {};
  }
  return missed;
}

PerQuantity standing_model_error(const Mechanism& mechanism, const PreparedScene& prepared,
                                 const StandingDisplacement& standing, const Parameters& parameters,
                                 const PointingIndices& index) {
  PerQuantity share = {};
  if (!standing) return share;
  const std::optional<PoseError> found =
      missed_by_linearity(mechanism, prepared.ideal(), standing.influence(), parameters);
  if (!found) {
    share.fill(1.0);
    return share;
  }
  const PoseError& missed = *found;
  const double length = mechanism.characteristic_length();
  const double largest =
      std::max({index.position_error.max, length * index.orientation_error.max, length * index.boresight_error.max});
  const auto count = [&](PointingQuantity quantity, double miss, double least) {
    // Errors that cancel to first order leave nothing to hold what is missed against but rounding.
    share[static_cast<std::size_t>(quantity)] = miss / std::max({index.of(quantity).max, least, kRoundingOfPoses});
  };
  count(PointingQuantity::position_error, missed.position, kNextToNoError * largest);
  count(PointingQuantity::orientation_error, missed.orientation, kNextToNoError * largest / length);
  count(PointingQuantity::boresight_error, missed.boresight, kNextToNoError * largest / length);
  if (index.has_line_of_sight) count(PointingQuantity::line_of_sight_error, missed.line_of_sight, 0.0);
  return share;
}

}  // namespace boresight
