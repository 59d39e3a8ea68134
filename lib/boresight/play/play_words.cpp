#include "boresight/play/play_words.hpp"

#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace {

void add(const PlayWords& words, PartsInPlay& parts) {
  const std::string insert = words.insert, seat = words.seat;
  if (parts.inserts.find(insert) != std::string::npos) return;
  const bool first = parts.insert.empty();
  parts.insert += (first ? "" : " or ") + insert;
  parts.seat += (first ? "" : " or ") + seat;
  parts.inserts += (first ? "" : " and ") + insert + "s";
  parts.seats += (first ? "" : " and ") + seat + "s";
}

}  // namespace

PartsInPlay parts_in_play(const std::vector<JointPlay>& joints) {
  PartsInPlay parts;
  for (const JointPlay& joint : joints) add(joint.words(), parts);
  return parts;
}

PartsInPlay parts_in_play(const MechanismDescription& mechanism) {
  PartsInPlay parts;
  for (const ClearanceDescription& c : mechanism.clearances)
    add(JointPlay::words(c, mechanism.joints[c.joint].type), parts);
  return parts;
}

}  // namespace boresight
