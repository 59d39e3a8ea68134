#include "boresight/rungs/second_order.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/formulation.hpp"

namespace boresight {
namespace {

using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
using Loads = std::vector<Eigen::Matrix<double, 5, 1>>;

// What makes lengths of all coordinates [m]: slopes count at the sleeve's ends, turns of joints on the
// mechanism's size.
VecX lengths(const Mechanism& mechanism, const Parameters& parameters, const SceneLayout& at) {
  VecX unit = VecX::Constant(at.n, mechanism.characteristic_length());
  for (std::size_t c = 0; c < at.joints.size(); ++c)
    for (int k = 0; k < at.joints[c].offsets; ++k)
      if (const int source = at.joints[c].source[k]; source >= 0)
        unit[source] = k < 3 ? 1.0 : 0.5 * parameters.clearance[c].sleeve_length;
  return unit;
}

// The ideal joints' reactions on the journals, which contact replaces on the average.
Loads reactions(const SceneLayout& at, const VecX& r) {
  Loads loads(at.joints.size(), Eigen::Matrix<double, 5, 1>::Zero());
  for (std::size_t c = 0; c < at.joints.size(); ++c)
    for (int k = 0; k < at.joints[c].offsets; ++k)
      if (const int source = at.joints[c].source[k]; source >= 0) loads[c][k] = -r[source];
  return loads;
}

// Coordinates whose forces decide together where a journal rests: across its axis, tilts included; along it;
// and every coordinate that is no offset.
std::vector<std::vector<int>> pushed_together(const SceneLayout& at) {
  std::vector<std::vector<int>> groups;
  std::vector<bool> taken(at.n, false);
  for (const SceneLayout::Joint& joint : at.joints) {
    std::vector<int> across, along;
    for (int k = 0; k < joint.offsets; ++k) {
      if (joint.source[k] < 0) continue;
      (k == 1 ? along : across).push_back(joint.source[k]);
      taken[joint.source[k]] = true;
    }
    groups.push_back(across);
    groups.push_back(along);
  }
  for (int i = 0; i < at.n; ++i)
    if (!taken[i]) groups.push_back({i});
  return groups;
}

Vec6 displacement(const BodyMotion& from, const BodyMotion& to) {
  const Eigen::AngleAxisd turn(to.R * from.R.transpose());
  Vec6 x;
  x << to.p - from.p, turn.angle() * turn.axis();
  return x;
}

}  // namespace

double second_order_share(const Mechanism& mechanism, const PreparedScene& prepared,
                          const Parameters& parameters, const LargestDeviations& largest) {
  const std::shared_ptr<const SceneTables> tables = prepared.tables(parameters);
  const SceneLayout& at = tables->layout;
  const VecX unit = lengths(mechanism, parameters, at);
  const double length = mechanism.characteristic_length();
  const std::vector<std::vector<int>> groups = pushed_together(at);
  const auto weight = [&](const Vec6& x) { return x.head<3>().norm() + length * x.tail<3>().norm(); };
  const std::vector<ContactMemory> memory(at.joints.size());
  DeviationCoordinates coordinates = prepared.scene().coordinates();
  const auto formulation = make_tree_formulation(mechanism, parameters, &prepared.ideal(), {});
  std::vector<double> row(tables->dynamics.width());
  // Largest misses and sizes met.
  double moved = 0.0, moved_off = 0.0, turned = 0.0, turned_off = 0.0, aimed = 0.0, aimed_off = 0.0, sighted = 0.0, sighted_off = 0.0;
  const std::optional<LineOfSight>& line_of_sight = mechanism.pointing().line_of_sight;
  // Of each group, over the instants: a force that is off early shows in where the journal gets to later.
  std::vector<double> weighs(groups.size(), 0.0), pushed_off(groups.size(), 0.0);
  try {
    for (const LargestDeviations::Deviation& deviation : largest.parts()) {
      if (!(deviation.size > 0.0)) continue;
      tables->dynamics.at(deviation.t, row.data());
      MatX T, A;
      coordinates.gain(deviation.t, T);
      at.inverse_mass(row.data(), A);
      const VecX Ar = Eigen::Map<const VecX>(row.data() + at.Ar, at.n);
      const Eigen::LLT<MatX> inverse_mass(A);
      const VecX reaction = inverse_mass.solve(Ar);
      formulation->forces().replace_contact(reactions(at, reaction));

      IdealState state;
      prepared.ideal().state(deviation.t, state);
      IdealState displaced = state;
      for (int b = 0; b < mechanism.bodies(); ++b)
        displace(displaced.bodies[b], T.middleRows<6>(6 * b) * deviation.z);
      VecX y;
      formulation->start(displaced, y);
      formulation->settle(deviation.t, y);
      VecX dy(y.size());
      formulation->derivative(deviation.t, y, memory, dy);
      const std::vector<BodyMotion> bodies = formulation->bodies(deviation.t, y);
      VecX z, z_dot, z_ddot;
      coordinates.coordinate_rates(bodies, z_dot, z);
      coordinates.coordinate_accelerations(bodies, formulation->acceleration(), z_ddot);

      const int body = mechanism.boresight_body();
      const Vec6 linear = T.middleRows<6>(6 * body) * z,
                 off = displacement(state.bodies[body], bodies[body]) - linear;
      moved = std::max(moved, linear.head<3>().norm());
      moved_off = std::max(moved_off, off.head<3>().norm());
      turned = std::max(turned, linear.tail<3>().norm());
      turned_off = std::max(turned_off, off.tail<3>().norm());
      const Vec3 axis = state.bodies[body].R * mechanism.pointing().boresight_B;
      aimed = std::max(aimed, axis.cross(linear.tail<3>()).norm());
      aimed_off = std::max(aimed_off, axis.cross(off.tail<3>()).norm());
      if (line_of_sight) {
        const Eigen::Matrix<double, 3, 6> G = line_of_sight->gain({state.bodies[body].p, Quat(state.bodies[body].R)});
        sighted = std::max(sighted, (G * linear).norm());
        sighted_off = std::max(sighted_off, (G * off).norm());
      }
      VecX left = z_ddot + Rows(row.data() + at.AC, at.n, at.n) * z_dot;
      if (at.stiff) left += Rows(row.data() + at.AK, at.n, at.n) * z;
      const VecX push = reaction.cwiseQuotient(unit), push_off = inverse_mass.solve(left).cwiseQuotient(unit);
      const double whole = weight(linear);
      for (std::size_t g = 0; g < groups.size(); ++g) {
        double size = 0.0, size_off = 0.0;
        Vec6 part = Vec6::Zero();
        for (int i : groups[g]) {
          size += push[i] * push[i];
          size_off += push_off[i] * push_off[i];
          part += T.block<6, 1>(6 * body, i) * z[i];
        }
        if (whole > 0.0) weighs[g] = std::max(weighs[g], std::min(1.0, weight(part) / whole));
        if (size_off > 0.0)
          pushed_off[g] =
              std::max(pushed_off[g], std::min(1.0, std::sqrt(size_off / std::max(size, 1e-300))));
      }
    }
  } catch (const ComputationError&) {
    return 1.0;
  }
  // Turns weigh against displacements on the mechanism's size: one that is next to none has no relative error
  // worth stating.
  constexpr double kWeighs = 1e-3;
  double share = 0.0;
  if (moved > kWeighs * length * turned) share = std::max(share, moved_off / moved);
  if (length * turned > kWeighs * moved) share = std::max(share, turned_off / turned);
  if (length * aimed > kWeighs * moved) share = std::max(share, aimed_off / aimed);
  if (sighted > 0.0) share = std::max(share, sighted_off / sighted);
  for (std::size_t g = 0; g < groups.size(); ++g) share += weighs[g] * pushed_off[g];
  return std::isfinite(share) ? std::min(share, 1.0) : 1.0;
}

}  // namespace boresight
