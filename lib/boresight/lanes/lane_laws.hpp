// A clearance joint's law with the numbers of another sample in every lane.
#pragma once

#include <array>

#include "boresight/contact/contact_numbers.hpp"

namespace boresight {

// What is the same for all samples, and every lane the numbers of `law`.
template <typename T>
JournalInSleeveT<T> in_all_lanes(JournalInSleeve law) {
  JournalInSleeveT<T> out;
  out.has_faces = law.has_faces;
  out.tilts = law.tilts;
  out.tilted.has_faces = law.tilted.has_faces;
  out.tilted.slides = law.tilted.slides;
  // Without friction the coefficient is zero: the common law does.
  out.friction.kind = law.friction.kind == FrictionKind::none ? FrictionKind::modified_coulomb : law.friction.kind;
  const auto from = numbers_of<double>(law);
  const auto to = numbers_of<T>(out);
  for (std::size_t i = 0; i < to.size(); ++i) *to[i] = T(*from[i]);
  out.tilted.friction = out.friction;
  return out;
}

template <typename T>
void set_lane(JournalInSleeveT<T>& out, int lane, JournalInSleeve law) {
  const auto from = numbers_of<double>(law);
  const auto to = numbers_of<T>(out);
  for (std::size_t i = 0; i < to.size(); ++i) to[i]->set(lane, *from[i]);
  out.tilted.friction = out.friction;
}

}  // namespace boresight
