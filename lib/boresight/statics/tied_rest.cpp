#include "boresight/statics/tied_rest.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "boresight/mechanism/error.hpp"
#include "boresight/play/play_words.hpp"

namespace boresight {
namespace {

using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

}  // namespace

TiedRest::TiedRest(const PreparedScene& prepared, const StandingDisplacement& standing, const Parameters& parameters,
                   const ReactionTable& reactions)
    : reactions_(reactions),
      layout_(prepared.scene().layout()),
      tables_(prepared.tables(parameters, standing)),
      balance_(layout_, reactions.joints(), reactions.cancelled()),
      inserts_(parts_in_play(reactions.joints()).inserts),
      row_(static_cast<std::size_t>(layout_.width)),
      stiffness_(MatX::Zero(layout_.n, layout_.n)) {
  const ClearanceScene& scene = prepared.scene();
  if (!parameters.spring.empty() || layout_.tips) {
    std::vector<double> values;
    for (int k = 0; k < scene.knots(); ++k) {
      const MatX K = scene.stiffness_at_rest(parameters, k);
      for (int i = 0; i < layout_.n; ++i)
        for (int j = 0; j < layout_.n; ++j) values.push_back(K(i, j));
    }
    springs_ = TimeTable(scene.spacing(), layout_.n * layout_.n, values);
  }
  for (int k = 0; k < scene.knots(); ++k) {
    const ReactionTable::Instant now = reactions_.at_time(k * scene.spacing());
    take(now.t, now.reaction);
    largest_ = std::max(largest_, balance_.load());
  }
}

void TiedRest::take(double t, const VecX& reaction) {
  tables_->at(t, row_.data());
  if (springs_.width() > 0) {
    std::vector<double> values(static_cast<std::size_t>(springs_.width()));
    springs_.at(t, values.data());
    stiffness_ = Rows(values.data(), layout_.n, layout_.n);
  }
  balance_.take(row_.data(), reaction, stiffness_);
}

TiedRest::Rest TiedRest::at(const ReactionTable::Instant& now, const Rest* before) {
  take(now.t, now.reaction);
  std::vector<PlayOffsets> offsets;
  for (std::size_t c = 0; before && c < before->joint.size(); ++c)
    offsets.push_back(offsets_of(before->joint[c].motion));
  const RestingStart rest =
      before ? balance_.solve_near(before->z, offsets, ReactionTable::kRounding * largest_) : balance_.solve();
  if (!rest.refusal.empty())
    throw ComputationError(
        "redundant joints or springs tie the offsets of clearance joints together, and no position was found in which "
        "the " +
        inserts_ + "' contacts carry the loads of t = " + std::to_string(now.t) + " s all together; use perturbation");
  Rest found{rest.z, {}};
  for (std::size_t c = 0; c < layout_.joints.size(); ++c) found.joint.push_back(resting(c, rest.z));
  return found;
}

// The contacts of a joint at its place, and the room that their deflections leave it.
RestingPlay TiedRest::resting(std::size_t joint, const VecX& z) const {
  const JointPlay& law = balance_.joints()[joint];
  RestingPlay rest;
  rest.motion = balance_.motion_of(joint, z);
  PlayWrench<double> wrench;
  law.wrench(rest.motion, kSlowImpacts, wrench);
  rest.contact = wrench.contact;
  rest.carried = wrench.force.norm();
  const std::vector<double> gaps = law.clearances();
  rest.radial_reach.fill(gaps[0]);
  // A pad has no other gap, and is pressed by its deepest point.
  const bool pad =
      std::holds_alternative<PadInSlot>(law.kind) || std::holds_alternative<RectangularPadInSlot>(law.kind);
  if (pad || gaps.size() > 1) rest.axial_reach = gaps.back();
  for (const ContactPlace place : law.places()) {
    const ContactState<double>& contact = rest.contact[static_cast<int>(place)];
    const double pressed = std::max(0.0, contact.penetration);
    if (is_axial(place))
      rest.axial_reach = std::max({rest.axial_reach, gaps.back() + contact.normal_force / law.axial_stiffness(),
                                   pad ? gaps.back() + pressed : std::abs(rest.motion.e.y())});
    else if (place == ContactPlace::radial)
      rest.radial_reach.fill(gaps[0] + pressed);
    else
      rest.radial_reach[place == ContactPlace::radial_minus ? 0 : 1] = gaps[0] + pressed;
  }
  return rest;
}

}  // namespace boresight
