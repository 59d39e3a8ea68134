// A journal's law with the numbers of another sample in every lane. Other kinds of play have no lanes yet: PerturbationLanes::serve().
#pragma once

#include "boresight/play/joint_play.hpp"

namespace boresight {

inline const JournalInSleeve& journal_of(const JointPlay& play) { return std::get<JournalInSleeve>(play.kind); }

// What is the same for all samples, and every lane the numbers of `law`.
template <typename T>
JournalInSleeveT<T> in_all_lanes(JournalInSleeve law) {
  JournalInSleeveT<T> out;
  out.take_shape_of(law);
  // Without friction the coefficient is zero: the common law does.
  if (out.friction.kind == FrictionKind::none) out.friction.kind = FrictionKind::modified_coulomb;
  const auto from = law.numbers();
  const auto to = out.numbers();
  for (std::size_t i = 0; i < to.size(); ++i) *to[i] = T(*from[i]);
  out.complete();
  return out;
}

template <typename T>
void set_lane(JournalInSleeveT<T>& out, int lane, JournalInSleeve law) {
  const auto from = law.numbers();
  const auto to = out.numbers();
  for (std::size_t i = 0; i < to.size(); ++i) to[i]->set(lane, *from[i]);
  out.complete();
}

}  // namespace boresight
