#include "boresight/scene/spring_gains.hpp"

#include "boresight/math/cross_matrix.hpp"

namespace boresight {
namespace {

using Gain = Eigen::Matrix<double, 3, Eigen::Dynamic>;

// One end: where it is, how it moves, and both per coordinate.
struct End {
  Vec3 p, v, arm;
  Gain G, G_rate, turn;
};

End end_of(const MechanismDescription& m, int body, const Vec3& point, const IdealState& state, const MatX& T,
           const MatX& T_rate) {
  const Eigen::Index n = T.cols();
  if (body == kGround) return {point, Vec3::Zero(), Vec3::Zero(), Gain::Zero(3, n), Gain::Zero(3, n), Gain::Zero(3, n)};
  const BodyMotion& b = state.bodies[body];
  const Vec3 arm = b.R * (m.bodies[body].axes.transpose() * (point - m.bodies[body].center_of_mass));
  const Vec3 arm_rate = b.w.cross(arm);
  const auto T_w = T.middleRows<3>(6 * body + 3);
  return {b.p + arm,
          b.v + arm_rate,
          arm,
          T.middleRows<3>(6 * body) - cross_matrix(arm) * T_w,
          T_rate.middleRows<3>(6 * body) - cross_matrix(arm_rate) * T_w -
              cross_matrix(arm) * T_rate.middleRows<3>(6 * body + 3),
          T_w};
}

// Second derivative of u . (theta x (theta x r)) / 2 by z.
MatX turning(const End& end, const Vec3& u) {
  const Mat3 both = u * end.arm.transpose();
  return end.turn.transpose() * (0.5 * (both + both.transpose()) - u.dot(end.arm) * Mat3::Identity()) * end.turn;
}

}  // namespace

SpringGain spring_gain(const MechanismDescription& mechanism, const SpringDescription& spring, const IdealState& state,
                       const MatX& T, const MatX& T_rate) {
  const End first = end_of(mechanism, spring.first, spring.first_point, state, T, T_rate);
  const End second = end_of(mechanism, spring.second, spring.second_point, state, T, T_rate);
  const Vec3 d = second.p - first.p, v = second.v - first.v;
  const Gain G = second.G - first.G, G_rate = second.G_rate - first.G_rate;
  SpringGain gain;
  gain.length = d.norm();
  if (gain.length <= 0.0) {  // its ends coincide: no direction to pull in
    gain.g = gain.g_rate = VecX::Zero(T.cols());
    gain.W = MatX::Zero(T.cols(), T.cols());
    return gain;
  }
  const Vec3 u = d / gain.length;
  gain.speed = u.dot(v);
  const Vec3 u_rate = (v - gain.speed * u) / gain.length;
  gain.g = G.transpose() * u;
  gain.g_rate = G_rate.transpose() * u + G.transpose() * u_rate;
  gain.W = (G.transpose() * G - gain.g * gain.g.transpose()) / gain.length + turning(second, u) - turning(first, u);
  return gain;
}

MatX SpringGain::stiffness(const SpringParameters& p) const { return stiffness_at_rest(p) + turning_damping(p); }

MatX SpringGain::stiffness_at_rest(const SpringParameters& p) const {
  return p.pull(length, speed) * W + p.stiffness * g * g.transpose();
}

}  // namespace boresight
