#include "boresight/scene/tipping.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "boresight/play/play_words.hpp"

namespace boresight {
namespace {

// Of a way through the plays a clearance long: with less a joint takes no part in it.
constexpr double kTakesPart = 0.1;

// Those that these ways, each a clearance long, lead through.
std::vector<int> clearances_along(const RestingBalance& balance, const MatX& ways) {
  std::vector<int> taking_part;
  for (std::size_t c = 0; c < balance.joints().size(); ++c) {
    MatX crossed = balance.joints()[c].widths(1.0).cwiseInverse().asDiagonal() * MatX(balance.offset_gain(c) * ways);
    if (balance.slides_along_axis(c)) crossed.row(1).setZero();
    if (crossed.norm() > kTakesPart) taking_part.push_back(static_cast<int>(c));
  }
  return taking_part;
}

std::string joints_of(const Mechanism& mechanism, const std::vector<int>& clearances) {
  const MechanismDescription& description = mechanism.description();
  std::string names;
  for (std::size_t k = 0; k < clearances.size(); ++k) {
    const int joint = description.clearances[static_cast<std::size_t>(clearances[k])].joint;
    names += (k == 0                      ? ""
              : k + 1 < clearances.size() ? ", "
                                          : " and ") +
             ("\"" + description.joints[joint].name + "\"");
  }
  return names;
}

}  // namespace

MatX ways_not_held(const RestingBalance& balance, const VecX& z) {
  constexpr double kHoldsNothing = 1e-9;  // of the stiffest
  VecX F;
  MatX by_z;
  balance.evaluate(z, F, by_z);
  const MatX held = -(balance.unit().transpose() * by_z * balance.unit());
  const Eigen::SelfAdjointEigenSolver<MatX> contact(MatX(0.5 * (held + held.transpose())));
  const double stiffest = contact.eigenvalues().cwiseAbs().maxCoeff();
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < held.rows(); ++k)
    if (!(std::abs(contact.eigenvalues()[k]) > kHoldsNothing * stiffest)) free.push_back(k);
  return contact.eigenvectors()(Eigen::all, free);
}

Tipping tipped_by_loads(const RestingBalance& balance, const SceneLayout& layout, const MatX& K, const VecX& acting) {
  // Of the loads' own stiffness: below, it is what differences leave of none. And of what acts, over a clearance: geometric stiffness is a
  // clearance over a length of it, 1e-5 and more, and rounding of differences 1e-12.
  constexpr double kNone = 1e-4, kOfActing = 1e-8;
  const RestingStart rest = balance.solve();
  if (!rest.refusal.empty()) return {};  // another matter, which its user is told
  const MatX& unit = balance.unit();
  const MatX free = ways_not_held(balance, rest.z);
  if (free.cols() == 0) return {};
  const MatX N = unit * free, of_loads = unit.transpose() * K * unit;
  const MatX along = N.transpose() * K * N;
  const Eigen::SelfAdjointEigenSolver<MatX> valley(MatX(0.5 * (along + along.transpose())));
  const double none = std::max(kNone * of_loads.norm(), kOfActing * (unit.transpose() * acting).norm());
  std::vector<Eigen::Index> loose;
  for (Eigen::Index k = 0; k < valley.eigenvalues().size(); ++k)
    if (std::abs(valley.eigenvalues()[k]) <= none) loose.push_back(k);
  Tipping tipping;
  if (!loose.empty()) tipping.undecided = clearances_along(balance, N * valley.eigenvectors()(Eigen::all, loose));
  if (!(valley.eigenvalues()[0] < -none)) return tipping;
  tipping.way = N * valley.eigenvectors().col(0);
  tipping.fall = -valley.eigenvalues()[0];
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
  return "the loads tip over what stands in the play of " + joints_of(mechanism, layout.tipped) +
         ": nothing pushes it there, and the least tilt or shift makes a load that grows with it; so it leans to one "
         "side from the start, "
         "and to which nothing in the drawing decides";
}

std::string undecided_sentence(const Mechanism& mechanism, const SceneLayout& layout) {
  if (layout.undecided.empty() || mechanism.description().journals == JournalStart::centred) return "";
  const PartsInPlay parts = parts_in_play(mechanism.description());
  return "at t = 0 nothing pushes the " + parts.inserts + " of " + joints_of(mechanism, layout.undecided) +
         " to a side along part of their play: there they start in the middle, and may as well stand anywhere else "
         "(--rung envelope bounds what that does)";
}

}  // namespace boresight
