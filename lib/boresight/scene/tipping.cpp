#include "boresight/scene/tipping.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace boresight {

Tipping tipped_by_loads(const RestingBalance& balance, const SceneLayout& layout, const MatX& K, const VecX& acting) {
  // Of the contacts' stiffness: below, they hold nothing. Of the loads' own: below, it is what differences leave of none. And of what acts, over
  // a clearance: geometric stiffness is a clearance over a length of it, 1e-5 and more, and rounding of differences 1e-12.
  constexpr double kHoldsNothing = 1e-9, kNone = 1e-4, kOfActing = 1e-8, kTakesPart = 0.1;
  const RestingStart rest = balance.solve();
  if (!rest.refusal.empty()) return {};  // another matter, which its user is told
  const MatX& unit = balance.unit();
  VecX F;
  MatX by_z;
  balance.evaluate(rest.z, F, by_z);
  const MatX held = -(unit.transpose() * by_z * unit);
  const Eigen::SelfAdjointEigenSolver<MatX> contact(MatX(0.5 * (held + held.transpose())));
  const double stiffest = contact.eigenvalues().cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < held.rows(); ++k)
    if (!(std::abs(contact.eigenvalues()[k]) > kHoldsNothing * stiffest)) free.push_back(k);
  if (free.empty()) return {};
  const MatX N = unit * contact.eigenvectors()(Eigen::all, free), of_loads = unit.transpose() * K * unit;
  const MatX along = N.transpose() * K * N;
  const Eigen::SelfAdjointEigenSolver<MatX> valley(MatX(0.5 * (along + along.transpose())));
  if (!(valley.eigenvalues()[0] < -std::max(kNone * of_loads.norm(), kOfActing * (unit.transpose() * acting).norm())))
    return {};
  Tipping tipping{{}, N * valley.eigenvectors().col(0), -valley.eigenvalues()[0]};
  std::vector<double> share;
  for (std::size_t c = 0; c < layout.joints.size(); ++c)
    share.push_back((balance.offset_gain(c) * tipping.way).cwiseQuotient(balance.joints()[c].widths(1.0)).norm());
  for (std::size_t c = 0; c < share.size(); ++c)
    if (share[c] > kTakesPart * *std::max_element(share.begin(), share.end()))
      tipping.clearances.push_back(static_cast<int>(c));
  return tipping;
}

std::string tipping_sentence(const Mechanism& mechanism, const SceneLayout& layout) {
  if (!layout.tips) return "";
  const MechanismDescription& description = mechanism.description();
  std::string names;
  for (std::size_t k = 0; k < layout.tipped.size(); ++k) {
    const int joint = description.clearances[static_cast<std::size_t>(layout.tipped[k])].joint;
    names += (k == 0                         ? ""
              : k + 1 < layout.tipped.size() ? ", "
                                             : " and ") +
             ("\"" + description.joints[joint].name + "\"");
  }
  return "the loads tip over what stands in the play of " + names +
         ": nothing pushes it there, and the least tilt or shift makes a load that grows with it; so it leans to one "
         "side from the start, "
         "and to which nothing in the drawing decides";
}

}  // namespace boresight
