#include "boresight_analyses/study/overrun_play.hpp"

#include <algorithm>
#include <cstdio>

#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/error_influence.hpp"
#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/play_mobility.hpp"
#include "boresight/play/joint_play.hpp"
#include "boresight_analyses/study/tied_room.hpp"

namespace boresight {
namespace {

// Instants that are looked at, both ends among them; every so many of them where plays are tied, which takes longer.
constexpr int kInstants = 51, kEveryOfTied = 5;

std::string number(const char* form, double value) {
  char text[40];
  std::snprintf(text, sizeof text, form, value);
  return text;
}
std::string name_of(const Mechanism& mechanism, std::size_t clearance) {
  const MechanismDescription& m = mechanism.description();
  return '"' + m.joints[static_cast<std::size_t>(m.clearances[clearance].joint)].name + '"';
}
std::string force_in_words(double newtons) {
  return newtons < 1e3 ? number("%.3g N", newtons) : number("%.3g kN", 1e-3 * newtons);
}

// Where journals that other joints tie together find the least room.
struct Tightest {
  double share = 1.0;  // of the errors, for which there is room
  VecX offsets;        // there, with the whole of them
};

std::string sentence_of(const Mechanism& mechanism, const TiedRoom& room, const std::vector<JointPlay>& plays,
                        const Tightest& tightest) {
  std::string names;
  std::size_t deepest = 0, pressed = 0;
  double most = 0.0;
  for (std::size_t c = 0; c < plays.size(); ++c) {
    const double depth = room.depth(static_cast<int>(c), tightest.offsets);
    if (depth <= TiedRoom::kRounding) continue;
    names += (pressed++ == 0 ? "" : ", ") + name_of(mechanism, c);
    if (depth > most) most = depth, deepest = c;
  }
  constexpr double kLeastShare = 1e-3;
  const std::string times =
      tightest.share < kLeastShare ? "more than a thousand times" : number("%.3g times", 1.0 / tightest.share);
  const PlayWords words = plays[deepest].words();
  return "the standing errors ask for " + times + " the room that the " +
         (pressed == 1 ? "clearance of " : "clearances of ") + names + (pressed == 1 ? " leaves" : " leave together") +
         ": wherever the parts rest, the " + words.insert + " of " + name_of(mechanism, deepest) + " is pressed some " +
         number("%.3g", 1e6 * most) + " µm into its " + words.seat + ", which takes about " +
         force_in_words(room.force(static_cast<int>(deepest), tightest.offsets)) +
         "; make the errors smaller or these clearances larger";
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
    std::vector<bool> moves;
    for (const PlayMobility::Joint& joint : mobility.joint) moves.push_back(joint.movable > 0);
    TiedRoom room(mechanism, influence.offsets(), plays, moves);
    Tightest tightest;
    MatX G;
    for (int i = 0; i < kInstants; ++i) {
      influence.at(mechanism.duration() * i / (kInstants - 1), wanted, G);
      const VecX shift = influence.shift() * errors;
      for (int c = 0; c < mechanism.clearances(); ++c) {
        if (moves[static_cast<std::size_t>(c)]) continue;
        double& most = beyond[static_cast<std::size_t>(c)];
        most = std::max(most, room.depth(c, shift));
      }
      if (i % kEveryOfTied != 0 || room.fits_unmoved(shift)) continue;
      commanded.state(mechanism.duration() * i / (kInstants - 1), state);
      room.take(state.bodies);
      const double share = tightest.share * room.share_with_room(tightest.share * shift);
      if (share < tightest.share) tightest = {share, room.least_pressed(shift)};
    }
    if (tightest.share < 1.0 && !room.fits_unmoved(tightest.offsets))
      sentences.push_back(sentence_of(mechanism, room, plays, tightest));
  } catch (const ComputationError&) {
    return {};
  }
  for (std::size_t c = 0; c < beyond.size(); ++c)
    if (beyond[c] > TiedRoom::kRounding)
      sentences.push_back("the standing errors ask for " + number("%.3g", 1e6 * beyond[c]) +
                          " µm more room than the clearance of " + name_of(mechanism, c) +
                          " has, and other joints hold its parts: the real parts would strain, which no rung computes; "
                          "make the errors smaller or that clearance larger");
  return sentences;
}

}  // namespace boresight
