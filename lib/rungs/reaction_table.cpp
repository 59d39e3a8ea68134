#include "boresight/rungs/reaction_table.hpp"

#include <algorithm>
#include <cmath>

namespace boresight {
namespace {

// Instants a knot spacing: the scene's knots are 2 ms apart, the reaction's direction may turn faster than that.
constexpr int kInstantsPerKnot = 4;

}  // namespace

ReactionTable::ReactionTable(const Mechanism& mechanism, const ClearanceScene& scene, const Parameters& parameters)
    : mechanism_(mechanism),
      n_(scene.offsets()),
      instants_((scene.knots() - 1) * kInstantsPerKnot + 1),
      spacing_(scene.spacing() / kInstantsPerKnot) {
  std::vector<double> values;
  MatX M, C;
  VecX r;
  for (int k = 0; k < scene.knots(); ++k) {
    scene.assemble(parameters, k, M, C, r);
    values.insert(values.end(), r.data(), r.data() + n_);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < n_; ++j) values.push_back(scene.pose_gain(k)(i, j));
  }
  table_ = TimeTable(scene.spacing(), 7 * n_, values);
  for (int c = 0; c < mechanism.clearances(); ++c) {
    const ClearanceDescription& d = mechanism.description().clearances[c];
    joints_.emplace_back(d, mechanism.description().joints[d.joint].type, parameters.clearance[c]);
  }
}

ReactionTable::Instant ReactionTable::at(int instant) const {
  std::vector<double> row(7 * n_);
  const double t = instant * spacing_;
  table_.at(t, row.data());
  return {t, Eigen::Map<const VecX>(row.data(), n_),
          Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>>(row.data() + n_, 6, n_)};
}

std::vector<ContactSummary> ReactionTable::summaries() const {
  std::vector<ContactSummary> result(joints_.size());
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    result[c].joint = mechanism_.description().joints[mechanism_.description().clearances[c].joint].name;
    result[c].contact_fraction = 1.0;
    result[c].validity_speed = joints_[c].validity_speed;
  }
  return result;
}

void ReactionTable::note(const Rest& rest, ContactSummary& summary) const {
  summary.max_force = std::max({summary.max_force, rest.radial_force, rest.axial_force});
  for (std::size_t c = 0; c < joints_.size(); ++c)
    if (mechanism_.description().joints[mechanism_.description().clearances[c].joint].name == summary.joint) {
      summary.max_penetration = std::max(summary.max_penetration, rest.radial_reach - joints_[c].radial_clearance);
      if (rest.axial_force > 0.0)
        summary.max_penetration = std::max(summary.max_penetration, rest.axial_reach - joints_[c].axial_clearance);
    }
}

}  // namespace boresight
