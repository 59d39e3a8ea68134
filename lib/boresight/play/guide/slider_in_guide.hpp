// A slider in a rectangular guide: the play of a prismatic joint.
//
// In the guide's frame, y along its axis, x along its width, with e the slider's centre, sigma = (a_x, a_z) / a_y the slope of its axis a, phi its
// roll about it, w, h, L its half width, half height and half length, c_x, c_z the gaps on each side:
//   face s = +-1 across the width, at x = s (w + c_x), the slider's edge at its end k = +-1, points z from -h to h along it:
//     d = s (e_x + k L sigma_x + phi z) - c_x                       pressed as edge_contact.hpp says: d0 + A |z| / h at the deeper end
//   across the height   d = s (e_z + k L sigma_z - phi x) - c_z,    x from -w to w
//   normal force        times 1 + h_d d_P' / v0, plus D d_P', never below zero; d_P' the rate of d at the centre of pressure
//   sliding             v = edot + w x (Q - e), its part along the face, at the centre of pressure Q
// A slider that keeps parallel (axes = "parallel") touches with whole faces: d = s e_x - c_x, d = s e_z - c_z, at their middle.
// The faces of the guide are as long as the slider goes. Each force acts along the gradient of its penetration on e, sigma and phi, so that
// elastic contact keeps energy exactly. Penetrations are of first order in offsets, slopes and roll.
// Stiffness: a face that lies flat is a rigid rectangular punch on a half-space (flat_face_stiffness.hpp), and its two end edges have half of it each;
// or that of the law "kelvin-voigt" and its D. The law that the file names lends its h_d: the restitution that it gives is the same for any
// elastic force (exact_restitution.hpp).
// The contact modes are those of Flores, Ambrosio, Claro and Lankarani (2008), J. Comput. Nonlinear Dyn. 3, 011007: none, one corner, two
// adjacent ones (a face), two opposite ones (jammed). Derived for this program; held against the gradient of the energy in a test.
#pragma once

#include <vector>

#include "boresight/play/guide/edge_contact.hpp"
#include "boresight/play/play_kind.hpp"

namespace boresight {

template <typename T>
struct SliderInGuideT {
  std::array<T, 2> gap{};        // c_x, c_z: on each side [m]
  std::array<T, 2> half{};       // w, h [m]
  T half_length{};               // L [m]
  std::array<T, 2> stiffness{};  // of a whole face across the width, across the height [N/m]
  T damping_factor{};            // h_d
  T dashpot{};                   // D, of a whole face [N s/m]
  FrictionLawT<T> friction;
  bool tilts = false;  // axes = "free"

  static bool serves(const ClearanceDescription& description, JointType type) {
    return type == JointType::prismatic && description.guide == GuideShape::rectangular;
  }
  static PlayWords words() { return {"slider", "guide"}; }

  template <typename M>
  void penetrations(const PlayMotion<M>& motion, ContactStates<M>& contact) const {
    for (ContactState<M>& c : contact) c = {M(-1.0), M(0.0), M(0.0)};
    each_contact([&](int across, int side, int end) {
      const Edge<M> on = edge(motion, across, side, end);
      contact[static_cast<int>(place_of(across, side, end))] = {on.depth + on.swing, on.rate(motion, T(1.0)), M(0.0)};
    });
  }

  // M: the scalar of the motion, T itself or one that carries derivatives besides. Out: PlayWrench<M>, or PlayLoad<M>.
  template <typename M, typename Friction, typename Out>
  void wrench(const PlayMotion<M>& m, const ImpactSpeeds<T>& impact_speed, const Friction& traction, Out& out) const {
    forget_contacts(out);
    out.force.setConstant(M(0.0));
    out.moment.setConstant(M(0.0));
    each_contact([&](int across, int side, int end) {
      const Edge<M> on = edge(m, across, side, end);
      const int place = static_cast<int>(place_of(across, side, end));
      const M penetration = on.depth + on.swing, rate = on.rate(m, T(1.0));
      keep_contact(out, place_of(across, side, end), {penetration, rate, M(0.0)});
      if (!any(penetration > T(0.0))) return;
      const T share = tilts ? T(0.5) : T(1.0);
      const EdgeForce<M> pressed = edge_contact(T(share * stiffness[across]), on.depth, on.swing);
      const M closing = on.rate(m, pressed.moment_arm);
      const M whole =
          pressed.force * (T(1.0) + damping_factor * closing / impact_speed[place]) + T(share * dashpot) * closing;
      const M F = select(penetration > T(0.0), positive_part(whole), M(0.0));
      keep_contact(out, place_of(across, side, end), {penetration, rate, F});
      const T s(side), reach = T(end) * half_length;
      const M along = half[across == 0 ? 1 : 0] * pressed.moment_arm * on.lean;  // where along the edge [m]
      const M zero(0.0);
      if (across == 0) {
        const Vec3T<M> push(-s * F, zero, zero);
        out.force += push;
        out.moment += m.e.cross(push) + moment_of_couple(M(-s * reach * F), zero, m) + (-s * F * along) * roll_axis(m);
        const Vec3T<M> Q(M(s * (half[0] + gap[0])), m.e.y() + reach, m.e.z() + along);
        const Vec3T<M> v = m.e_dot + m.w.cross(Vec3T<M>(Q - m.e));
        const auto [fy, fz] = traction(place, F, M(v.y()), M(v.z()));
        add(Q, Vec3T<M>(zero, fy, fz), out);
      } else {
        const Vec3T<M> push(zero, zero, -s * F);
        out.force += push;
        out.moment += m.e.cross(push) + moment_of_couple(zero, M(-s * reach * F), m) + (s * F * along) * roll_axis(m);
        const Vec3T<M> Q(m.e.x() + along, m.e.y() + reach, M(s * (half[1] + gap[1])));
        const Vec3T<M> v = m.e_dot + m.w.cross(Vec3T<M>(Q - m.e));
        const auto [fx, fy] = traction(place, F, M(v.x()), M(v.y()));
        add(Q, Vec3T<M>(fx, fy, zero), out);
      }
    });
  }

  // A direction in which no contact is closed has a gap that nothing crosses.
  void keep_only(const std::array<bool, kContactPlaces>& touching) {
    std::array<bool, 2> some = {false, false};
    each_contact([&](int across, int side, int end) {
      some[across] = some[across] || touching[static_cast<int>(place_of(across, side, end))];
    });
    for (int across : {0, 1})
      if (!some[across]) gap[across] = T(kOutOfReach);
  }
  std::array<T*, 14> numbers() {
    return {&gap[0],
            &gap[1],
            &half[0],
            &half[1],
            &half_length,
            &stiffness[0],
            &stiffness[1],
            &damping_factor,
            &dashpot,
            &friction.coefficient,
            &friction.static_speed,
            &friction.dynamic_speed,
            &friction.stiction,
            &friction.stribeck_speed};
  }
  template <typename U>
  void take_shape_of(const SliderInGuideT<U>& other) {
    tilts = other.tilts;
    friction.kind = other.friction.kind;
  }
  void complete() {}

  // across: 0 the width, 1 the height; side: of the guide, -1 or 1; end: of the slider, 0 where it keeps parallel.
  static ContactPlace place_of(int across, int side, int end) {
    const int first = static_cast<int>(end == 0    ? ContactPlace::width_minus
                                       : end == -1 ? ContactPlace::width_minus_rear
                                                   : ContactPlace::width_minus_front);
    return static_cast<ContactPlace>(first + 2 * across + (side > 0 ? 1 : 0));
  }
  template <typename Do>
  void each_contact(const Do& act) const {
    for (const int across : {0, 1})
      for (const int side : {-1, 1}) {
        if (!tilts) {
          act(across, side, 0);
          continue;
        }
        act(across, side, -1);
        act(across, side, 1);
      }
  }

 protected:
  // One contact: d0, A, and to which end of the edge it leans (a smooth sign of phi).
  template <typename M>
  struct Edge {
    int across;
    bool turns;
    T side, reach, width;  // s, k L, half the edge's length
    M depth, swing, lean;

    // How fast the slider nears the face at the share `arm` of the edge, on the side that is deepest [m/s].
    template <typename Arm>
    M rate(const PlayMotion<M>& m, const Arm& arm) const {
      const int axis = across == 0 ? 0 : 2;
      if (!turns) return side * m.e_dot[axis];
      const M turn = m.w.dot(roll_axis(m)), sideways = turn * (width * arm * lean);
      const M toward = m.e_dot[axis] + reach * m.slope_rate[across];
      return side * (across == 0 ? M(toward + sideways) : M(toward - sideways));
    }
  };
  template <typename M>
  Edge<M> edge(const PlayMotion<M>& m, int across, int side, int end) const {
    const T s(side);
    Edge<M> on{across, tilts, s, T(T(end) * half_length), T(0.0), M(0.0), M(0.0), M(0.0)};
    const int axis = across == 0 ? 0 : 2;
    on.depth = s * m.e[axis] - gap[across];
    if (!tilts) return on;
    on.depth += s * on.reach * m.slope[across];
    on.width = half[across == 0 ? 1 : 0];
    const M size = length_from_square(M(m.roll * m.roll));
    on.swing = on.width * size;
    on.lean = (across == 0 ? s : T(-s)) * (m.roll / size);
    return on;
  }

 private:
  template <typename M>
  static void add(const Vec3T<M>& point, const Vec3T<M>& force, PlayLoad<M>& out) {
    out.force += force;
    out.moment += point.cross(force);
  }
};

struct SliderInGuide : SliderInGuideT<double> {
  SliderInGuide() = default;
  SliderInGuide(const ClearanceDescription& description, JointType joint, const ClearanceParameters& parameters);

  // As play_kind.hpp asks.
  std::vector<ContactPlace> places() const;
  static constexpr std::array kInputs = {MotionInputs::parallel, MotionInputs::rolling};
  MotionInputs inputs() const { return kInputs[tilts ? 1 : 0]; }
  double elastic_energy(const PlayMotion<double>& motion) const;
  // What the elastic contacts push the offsets by [N, N m].
  PlayOffsets elastic_force(const PlayMotion<double>& motion) const;
  SliderInGuide elastic_only() const;
  ContactTangent tangent(const PlayMotion<double>& motion) const;
  RestingPlay rest_under(const PlayOffsets& load, const JointCoordinates& joint, const RestingPlay& before) const;
  std::vector<GapPart> gap_parts(const RestingPlay& rest, const JointCoordinates& joint) const;
  std::vector<double> clearances() const { return {gap[0], gap[1]}; }
  PlayOffsets widths(double other) const;
  OffsetGroups pushed_together() const { return {{}, {0}, {2}, {3}, {4}, {5}}; }  // either pair of faces may be idle
  double lever() const { return half_length; }
  double size() const { return half[0] > half[1] ? half[0] : half[1]; }
  const NormalLaw& normal_law() const { return law; }
  double axial_stiffness() const { return 0.0; }
  PlayOffsets root_stiffness(double load) const;

  NormalLaw law;  // of the softer face: linear, h_d, D
};

}  // namespace boresight
