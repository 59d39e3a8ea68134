#include "boresight_analyses/study/overrun_play.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/error_influence.hpp"
#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/play_mobility.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace {

// Instants that are looked at, both ends among them.
constexpr int kInstants = 51;
// What is no more than this beyond a clearance is rounding [m].
constexpr double kRounding = 1e-9;

double deepest(const JointPlay& play, const PlayMotion<double>& motion) {
  std::array<ContactState<double>, kContactPlaces> contact;
  play.penetrations(motion, contact);
  double most = -1.0;
  for (const ContactPlace place : play.places())
    most = std::max(most, contact[static_cast<std::size_t>(place)].penetration);
  return most;
}

}  // namespace

std::vector<std::string> overrun_plays(const Mechanism& mechanism, const Parameters& parameters,
                                       const IdealMotion& commanded) {
  std::vector<std::string> sentences;
  if (mechanism.clearances() == 0 || !has_errors(parameters)) return sentences;
  IdealState state;
  commanded.state(generic_instant(0.0, commanded.duration()), state);
  const PlayMobility mobility = analyse_play(mechanism, state.bodies);
  std::vector<double> beyond(static_cast<std::size_t>(mechanism.clearances()), 0.0);
  try {
    ErrorInfluence influence(mechanism, commanded);
    if (!influence.shifts()) return sentences;
    std::vector<bool> wanted;
    for (const double value : parameters.error) wanted.push_back(value != 0.0);
    const Eigen::Map<const VecX> errors(parameters.error.data(), static_cast<Eigen::Index>(parameters.error.size()));
    const std::vector<JointPlay> plays = joint_plays(mechanism.description(), parameters);
    MatX G;
    for (int i = 0; i < kInstants; ++i) {
      influence.at(mechanism.duration() * i / (kInstants - 1), wanted, G);
      const VecX shift = influence.shift() * errors;
      for (int c = 0; c < mechanism.clearances(); ++c) {
        if (mobility.joint[static_cast<std::size_t>(c)].movable > 0) continue;
        const OffsetLayout::Joint& joint = influence.offsets().joint(c);
        PlayOffsets offsets = PlayOffsets::Zero();
        offsets.head(joint.count()) = shift.segment(joint.first, joint.count());
        double& most = beyond[static_cast<std::size_t>(c)];
        most = std::max(most, deepest(plays[static_cast<std::size_t>(c)], at_rest_at(offsets)));
      }
    }
  } catch (const ComputationError&) {
    return {};
  }
  const MechanismDescription& description = mechanism.description();
  for (std::size_t c = 0; c < beyond.size(); ++c) {
    if (beyond[c] <= kRounding) continue;
    char much[32];
    std::snprintf(much, sizeof much, "%.3g", 1e6 * beyond[c]);
    sentences.push_back("the standing errors ask for " + std::string(much) + " µm more room than the clearance of \"" +
                        description.joints[static_cast<std::size_t>(description.clearances[c].joint)].name +
                        "\" has, and other joints hold its parts: the real parts would strain, which no rung computes; "
                        "make the errors smaller or that clearance larger");
  }
  return sentences;
}

}  // namespace boresight
