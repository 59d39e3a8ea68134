// A ball in its socket: the play of a spherical joint.
//
// In the socket's frame, with e the ball's centre, edot its rate as seen from the socket, w the ball's angular velocity relative to
// it, c the difference of the radii and R_b the socket's radius:
//   n = e / |e|,  d = |e| - c,  ddot = edot . n        one contact, at Q = R_b n on the socket
//   sliding  v = edot + w x (Q - e), its part across n
// Hertz's stiffness of a sphere in a spherical seat is that of Eq. 28 (Sun and others) with the ball's radius for the journal's.
// The normal force goes through the socket's centre, so it turns nothing; friction acts at Q on both bodies.
#pragma once

#include <vector>

#include "boresight/play/play_kind.hpp"

namespace boresight {

template <typename T>
struct BallInSocketT {
  T clearance{};      // c = R_b - R_a [m]
  T socket_radius{};  // R_b [m]
  NormalLawT<T> law;
  FrictionLawT<T> friction;

  static bool serves(const ClearanceDescription&, JointType type) { return type == JointType::spherical; }
  static PlayWords words() { return {"ball", "socket"}; }

  template <typename M>
  void penetrations(const PlayMotion<M>& motion, ContactStates<M>& contact) const {
    for (ContactState<M>& c : contact) c = {M(-1.0), M(0.0), M(0.0)};
    const Touch<M> at = touch(motion);
    contact[static_cast<int>(ContactPlace::radial)] = {at.penetration, at.rate, M(0.0)};
  }

  // M: the scalar of the motion, T itself or one that carries derivatives besides. Out: PlayWrench<M>, or PlayLoad<M>.
  template <typename M, typename Friction, typename Out>
  void wrench(const PlayMotion<M>& m, const ImpactSpeeds<T>& impact_speed, const Friction& traction, Out& out) const {
    forget_contacts(out);
    out.force.setConstant(M(0.0));
    out.moment.setConstant(M(0.0));
    constexpr int place = static_cast<int>(ContactPlace::radial);
    const Touch<M> at = touch(m);
    ContactState<M> state{at.penetration, at.rate, M(0.0)};
    if (any(at.penetration > T(0.0))) {
      state.normal_force = law.force(at.penetration, at.rate, impact_speed[place]);
      const Vec3T<M> Q = socket_radius * at.n;
      const Vec3T<M> v = m.e_dot + m.w.cross(Vec3T<M>(Q - m.e));
      const Plane<M> across(at.n);
      const auto [f_one, f_other] = traction(place, state.normal_force, M(across.one.dot(v)), M(across.other.dot(v)));
      const Vec3T<M> rub = f_one * across.one + f_other * across.other;
      out.force = rub - state.normal_force * at.n;
      out.moment = Q.cross(rub);
    }
    keep_contact(out, ContactPlace::radial, state);
  }

  void keep_only(const std::array<bool, kContactPlaces>& touching) {
    if (!touching[static_cast<int>(ContactPlace::radial)]) clearance = T(kOutOfReach);
  }
  std::array<T*, 12> numbers() {
    return {&clearance,
            &socket_radius,
            &law.stiffness,
            &law.damping_factor,
            &law.length,
            &law.exponent,
            &law.dashpot,
            &friction.coefficient,
            &friction.static_speed,
            &friction.dynamic_speed,
            &friction.stiction,
            &friction.stribeck_speed};
  }
  template <typename U>
  void take_shape_of(const BallInSocketT<U>& other) {
    law.curve = other.law.curve;
    friction.kind = other.friction.kind;
  }
  void complete() {}

 private:
  template <typename M>
  struct Touch {
    Vec3T<M> n;
    M penetration, rate;
  };
  template <typename M>
  Touch<M> touch(const PlayMotion<M>& m) const {
    // A concentric ball has no normal; length_from_square gives it some.
    const M distance = length_from_square(M(m.e.dot(m.e)));
    Touch<M> at;
    at.n = m.e / distance;
    at.penetration = distance - clearance;
    at.rate = at.n.dot(m.e_dot);
    return at;
  }

  // Two directions across n (Duff and others 2017, Journal of Computer Graphics Techniques 6, 1-8). Where n crosses the plane of x
  // and y they turn at once, of which a law that asks for the sliding speed alone knows nothing.
  template <typename M>
  struct Plane {
    Vec3T<M> one, other;
    explicit Plane(const Vec3T<M>& n) {
      const M side = select(n.z() > M(0.0), M(1.0), M(-1.0));
      const M a = M(-1.0) / (side + n.z()), b = n.x() * n.y() * a;
      one = Vec3T<M>(M(1.0) + side * n.x() * n.x() * a, side * b, -side * n.x());
      other = Vec3T<M>(b, side + n.y() * n.y() * a, -n.y());
    }
  };
};

struct BallInSocket : BallInSocketT<double> {
  BallInSocket() = default;
  BallInSocket(const ClearanceDescription& description, JointType joint, const ClearanceParameters& parameters);

  // As play_kind.hpp asks.
  std::vector<ContactPlace> places() const { return {ContactPlace::radial}; }
  static constexpr std::array kInputs = {MotionInputs::turning};
  MotionInputs inputs() const { return kInputs[0]; }
  double elastic_energy(const PlayMotion<double>& motion) const;
  BallInSocket elastic_only() const;
  ContactTangent tangent(const PlayMotion<double>& motion) const;
  RestingPlay rest_under(const PlayOffsets& load, const JointCoordinates& joint, const RestingPlay& before) const;
  std::vector<GapPart> gap_parts(const RestingPlay& rest, const JointCoordinates& joint) const;
  std::vector<double> clearances() const { return {clearance}; }
  PlayOffsets widths(double other) const;
  OffsetGroups pushed_together() const { return {{0, 1, 2}}; }
  double lever() const { return socket_radius; }
  double size() const { return socket_radius; }
  const NormalLaw& normal_law() const { return law; }
  double axial_stiffness() const { return 0.0; }
  PlayOffsets root_stiffness(double load) const;
};

}  // namespace boresight
