// How a journal sits and moves in its sleeve, and what the sleeve does to it: what goes into the contact laws of a clearance
// joint and what comes out, in the sleeve frame (origin at the sleeve's centre, y along its axis).
#pragma once

#include <array>

#include "boresight/contact/contact_memory.hpp"
#include "boresight/math/types.hpp"

namespace boresight {

template <typename T>
using Vec2T = Eigen::Matrix<T, 2, 1>;

template <typename T>
struct JournalMotion {
  Vec3T<T> e, e_dot;  // centre offset [m] and its rate as seen from the sleeve [m/s]
  Vec3T<T> w;         // angular velocity relative to the sleeve [rad/s]
  // Of the journal's axis a, where it may tilt: (a_x, a_z) / a_y, and its rate as seen from the sleeve [1/s].
  Vec2T<T> slope = Vec2T<T>::Constant(T(0.0)), slope_rate = Vec2T<T>::Constant(T(0.0));
};

// One possible contact. Not zero from the start: penetrations() and wrench() write every place.
template <typename T>
struct ContactState {
  T penetration, rate, normal_force;  // [m], [m/s], [N]; penetration < 0: a gap
};

// Force on the journal, and moment about the sleeve's centre.
template <typename T>
struct JournalLoad {
  Vec3T<T> force, moment;
};

// The same with what each contact carries of it.
template <typename T>
struct JournalWrench : JournalLoad<T> {
  std::array<ContactState<T>, kContactPlaces> contact;  // by ContactPlace; unused places keep a gap of -1 m
};

// What a law fills in of a contact: everything where it is kept, nothing where only the load is asked for.
template <typename T>
void keep_contact(JournalLoad<T>&, ContactPlace, const ContactState<T>&) {}
template <typename T>
void keep_contact(JournalWrench<T>& out, ContactPlace place, const ContactState<T>& state) {
  out.contact[static_cast<int>(place)] = state;
}
template <typename T>
void forget_contacts(JournalLoad<T>&) {}
template <typename T>
void forget_contacts(JournalWrench<T>& out) {
  for (ContactState<T>& c : out.contact) c = {T(-1.0), T(0.0), T(0.0)};
}

}  // namespace boresight
