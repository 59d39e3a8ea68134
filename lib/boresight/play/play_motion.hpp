// How the parts of a joint with play sit and move in one another, and what the one does to the other: what goes into the contact
// laws and what comes out, in the seat's frame (the sleeve's, the socket's: origin at its centre, y along the joint's axis).
// The other part, the journal, the ball or the pad, is the insert.
#pragma once

#include <array>
#include <vector>

#include "boresight/contact/contact_memory.hpp"
#include "boresight/math/types.hpp"

namespace boresight {

template <typename T>
struct PlayMotion {
  Vec3T<T> e, e_dot;  // centre of the insert [m] and its rate as seen from the seat [m/s]
  Vec3T<T> w;         // angular velocity relative to the seat [rad/s]
  // Of the insert's axis a, where it may tilt: (a_x, a_z) / a_y, and its rate as seen from the seat [1/s].
  Vec2T<T> slope = Vec2T<T>::Constant(T(0.0)), slope_rate = Vec2T<T>::Constant(T(0.0));
  T roll = T(0.0);  // of the insert about its axis, where play frees it: the twist of joint_rows.hpp [rad]
  // Cosine and sine of that twist, where the joint itself leaves it free and the contacts turn with the insert. It may be large.
  Vec2T<T> twist = Vec2T<T>(T(1.0), T(0.0));
};

// Numbers of a PlayMotion: e, e_dot, w (3 each), then slope, slope_rate (2 each), then roll, then twist (2). Their rates follow from w and slope.
inline constexpr int kMotionNumbers = 16;

// The joint's own coordinates, free even without play, as far as contacts see them.
struct JointCoordinates {
  double slide = 0.0;                             // along its axis [m]
  Vec2T<double> twist = Vec2T<double>(1.0, 0.0);  // as PlayMotion has it
};

// The offsets that play can free: x y z of the insert's centre [m], then the slopes x z of its axis [-], then its roll about it [rad]. A kind
// that frees fewer leaves the rest zero. With forces in their place: the loads on them [N], couples on slopes and roll [N m].
inline constexpr int kMostOffsets = 6;
using PlayOffsets = Eigen::Matrix<double, kMostOffsets, 1>;

// Offsets by their numbers, in groups that the seat's shape does not tell apart: however its frame lies, what is said of one of a
// group (free, pushed by next to nothing) is said of all. A group is of lengths or of slopes. The first one carries the joint: a
// load on it, however small, presses the insert against its seat; it is empty where none does so alone.
using OffsetGroups = std::vector<std::vector<int>>;

inline PlayMotion<double> at_rest_at(const PlayOffsets& offsets) {
  PlayMotion<double> motion{offsets.head<3>(), Vec3::Zero(), Vec3::Zero()};
  motion.slope = offsets.segment<2>(3);
  motion.roll = offsets[5];
  return motion;
}
inline PlayMotion<double> at_rest_at(const PlayOffsets& offsets, const JointCoordinates& joint) {
  PlayMotion<double> motion = at_rest_at(offsets);
  motion.twist = joint.twist;
  return motion;
}
inline PlayOffsets offsets_of(const PlayMotion<double>& motion) {
  PlayOffsets offsets;
  offsets << motion.e, motion.slope, motion.roll;
  return offsets;
}

// One possible contact. Not zero from the start: penetrations() and wrench() write every place.
template <typename T>
struct ContactState {
  T penetration, rate, normal_force;  // [m], [m/s], [N]; penetration < 0: a gap
};
template <typename T>
using ContactStates = std::array<ContactState<T>, kContactPlaces>;  // by ContactPlace; unused places keep a gap of -1 m
template <typename T>
using ImpactSpeeds = std::array<T, kContactPlaces>;  // by ContactPlace [m/s]

// For laws without dissipation, which ask for them all the same [m/s].
inline constexpr ImpactSpeeds<double> kSlowImpacts = [] {
  ImpactSpeeds<double> speeds{};
  speeds.fill(1e-3);
  return speeds;
}();

// Force on the insert, and moment about the seat's centre.
template <typename T>
struct PlayLoad {
  Vec3T<T> force, moment;
};

// The same with what each contact carries of it.
template <typename T>
struct PlayWrench : PlayLoad<T> {
  ContactStates<T> contact;
};

// Of the couple (gx, gz) on the slopes, about the insert's centre: the moment that works at gx, gz per unit of their rates.
template <typename M>
Vec3T<M> moment_of_couple(const M& gx, const M& gz, const PlayMotion<M>& m) {
  const Vec3T<M> along(m.slope[0], M(1.0), m.slope[1]);
  return along.cross(Vec3T<M>(gx, -gx * m.slope[0] - gz * m.slope[1], gz));
}

// By which the insert's angular velocity relative to the seat becomes the rate of its roll, and a couple on the roll a moment: m of
// joint_rows.hpp, (y + a) / (1 + y . a) with the slopes for a.
template <typename M>
Vec3T<M> roll_axis(const PlayMotion<M>& m) {
  using std::sqrt;
  const M n = sqrt(M(1.0) + m.slope[0] * m.slope[0] + m.slope[1] * m.slope[1]), share = M(1.0) / (M(1.0) + n);
  return {share * m.slope[0], M(1.0), share * m.slope[1]};
}

// The couples on slopes and roll (x, z, roll) whose moment this is, about the insert's centre: how moment_of_couple() and roll_axis() made it. Of a
// moment that works along the axis only by the roll.
template <typename M>
Vec3T<M> couples_of(const Vec3T<M>& moment, const PlayMotion<M>& m) {
  using std::sqrt;
  const Vec3T<M> along(m.slope[0], M(1.0), m.slope[1]);
  const M square = along.squaredNorm(), on_roll = along.dot(moment) / sqrt(square);
  const Vec3T<M> of_slopes = moment - on_roll * roll_axis(m);
  const Vec3T<M> couple = of_slopes.cross(along) / square;
  return {couple[0], couple[2], on_roll};
}

// What a law fills in of a contact: everything where it is kept, nothing where only the load is asked for.
template <typename T>
void keep_contact(PlayLoad<T>&, ContactPlace, const ContactState<T>&) {}
template <typename T>
void keep_contact(PlayWrench<T>& out, ContactPlace place, const ContactState<T>& state) {
  out.contact[static_cast<int>(place)] = state;
}
template <typename T>
void forget_contacts(PlayLoad<T>&) {}
template <typename T>
void forget_contacts(PlayWrench<T>& out) {
  for (ContactState<T>& c : out.contact) c = {T(-1.0), T(0.0), T(0.0)};
}

}  // namespace boresight
