#include "boresight/formulations/tree_kinematics.hpp"

#include <cmath>

namespace boresight {
namespace {

using Turns = TreeJoint::Turns;

const BodyMotion kGroundMotion;
const BodyAcceleration kNoAcceleration = BodyAcceleration::Zero();

Mat3 rotation(const Vec3& axis, double angle) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

// X turned about its own y.
Mat3 turned_about_y(const Mat3& X, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 result;
  result << c * X.col(0) - s * X.col(2), X.col(1), s * X.col(0) + c * X.col(2);
  return result;
}

Quat ball(const VecX& y, int first) { return Quat(y[first], y[first + 1], y[first + 2], y[first + 3]); }

// Angle about `axis` that carries `from` to `to`, as seen along it.
double angle_between(const Vec3& axis, const Vec3& from, const Vec3& to) {
  return std::atan2(axis.dot(from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to));
}

constexpr int kAlong = 1;  // the slide of a prismatic joint

}  // namespace

TreeKinematics::TreeKinematics(const SpanningTree& tree)
    : tree_(tree),
      bodies_(tree.bodies()),
      bias_(tree.bodies(), BodyAcceleration::Zero()),
      axes_(tree.speeds()),
      reference_(tree.bodies(), Vec3::Zero()),
      sum_(tree.bodies()) {
  for (const TreeJoint& t : tree.joints()) R_JB_.push_back(t.to.R.transpose());
}

void TreeKinematics::evaluate(const VecX& y, const std::vector<TimeValue>& laws) {
  for (int k = 0; k < tree_.bodies(); ++k) {
    const TreeJoint& t = tree_.joints()[k];
    const bool grounded = t.parent == kGround;
    const BodyMotion& P = grounded ? kGroundMotion : bodies_[t.parent];
    const BodyAcceleration& P_bias = grounded ? kNoAcceleration : bias_[t.parent];
    const Vec3 P_alpha = P_bias.tail<3>();
    TimeValue law;
    if (t.driven) {
      law = laws[t.joint];
      law.value *= t.drive_sign, law.rate *= t.drive_sign, law.acceleration *= t.drive_sign;
    }
    const bool slide_driven = t.driven && t.turns == Turns::none;
    int position = t.first_position, speed = t.first_speed;

    // Slides: r reaches from the parent's centre of mass to the point that the turns then go about.
    const Mat3 X = P.R * t.from.R;
    Vec3 r = P.R * t.from.p;
    Vec3 slid = Vec3::Zero(), a = P_bias.head<3>();  // velocity along the slides; acceleration of the point
    for (int axis = 0; axis < 3; ++axis) {
      if (!t.slides[axis]) continue;
      const Vec3 along = X.col(axis);
      if (slide_driven && axis == kAlong) {
        r += law.value * along;
        slid += law.rate * along;
        a += law.acceleration * along;
      } else {
        axes_[speed].move = along;
        r += y[position++] * along;
        slid += y[tree_.positions() + speed++] * along;
      }
    }
    const Vec3 swept = P.w.cross(r);
    const Vec3 v = P.v + swept + slid;
    a += P_alpha.cross(r) + P.w.cross(swept + 2.0 * slid);
    const Vec3 point = P.p + r;
    reference_[t.body] = grounded ? point : reference_[t.parent];

    // Turns.
    BodyMotion& B = bodies_[t.body];
    B.w = P.w;
    Vec3 alpha = P_alpha;
    const Vec3 arm = point - reference_[t.body];
    const auto free_turn = [&](const Vec3& axis) {
      axes_[speed] = {axis, arm.cross(axis)};
      const Vec3 turning = y[tree_.positions() + speed++] * axis;
      alpha += B.w.cross(turning);
      B.w += turning;
    };
    switch (t.turns) {
      case Turns::none:
        B.R = X * R_JB_[k];
        break;
      case Turns::about_axis:
        if (t.driven) {
          const Vec3 axis = X.col(1);
          alpha += law.rate * P.w.cross(axis) + law.acceleration * axis;
          B.w += law.rate * axis;
          B.R = turned_about_y(X, law.value) * R_JB_[k];
        } else {
          free_turn(X.col(1));
          B.R = turned_about_y(X, y[position]) * R_JB_[k];
        }
        break;
      case Turns::about_two_axes: {
        free_turn(X * t.first_axis);
        const Mat3 between = X * rotation(t.first_axis, y[position]);
        free_turn(between * t.second_axis);
        B.R = between * rotation(t.second_axis, y[position + 1]) * R_JB_[k];
        break;
      }
      case Turns::ball: {
        // The three axes are fixed in the parent: one turn, not one after the other.
        Vec3 turning = Vec3::Zero();
        for (int axis = 0; axis < 3; ++axis) {
          axes_[speed] = {X.col(axis), arm.cross(X.col(axis))};
          turning += y[tree_.positions() + speed++] * X.col(axis);
        }
        alpha += P.w.cross(turning);
        B.w += turning;
        B.R = X * ball(y, position).normalized().toRotationMatrix() * R_JB_[k];
        break;
      }
    }

    // From the joint's point to the body's centre of mass.
    const Vec3 s = -(B.R * t.to.p);
    const Vec3 turn_speed = B.w.cross(s);
    B.p = point + s;
    B.v = v + turn_speed;
    bias_[t.body] << a + alpha.cross(s) + B.w.cross(turn_speed), alpha;
  }
}

void TreeKinematics::accelerations(const VecX& speed_rate, std::vector<BodyAcceleration>& out) const {
  for (const TreeJoint& t : tree_.joints()) {
    SpeedAxis sum = t.parent == kGround ? SpeedAxis{} : sum_[t.parent];
    for (int k = t.first_speed; k < t.first_speed + t.speeds; ++k) {
      sum.turn += speed_rate[k] * axes_[k].turn;
      sum.move += speed_rate[k] * axes_[k].move;
    }
    sum_[t.body] = sum;
    const Vec3 arm = bodies_[t.body].p - reference_[t.body];
    out[t.body].head<3>() = bias_[t.body].head<3>() + sum.move + sum.turn.cross(arm);
    out[t.body].tail<3>() = bias_[t.body].tail<3>() + sum.turn;
  }
}

void TreeKinematics::read(const std::vector<BodyMotion>& bodies, VecX& y) const {
  y.resize(state_size());
  for (const TreeJoint& t : tree_.joints()) {
    const BodyMotion& P = t.parent == kGround ? kGroundMotion : bodies[t.parent];
    const BodyMotion& B = bodies[t.body];
    const Mat3 X = P.R * t.from.R;
    const Mat3 R = X.transpose() * B.R * t.to.R;  // R_PB, joint frames
    const Vec3 rP = P.R * t.from.p, rB = B.R * t.to.p;
    const Vec3 d = B.p + rB - P.p - rP;
    const Vec3 d_dot = X.transpose() * (B.v + B.w.cross(rB) - P.v - P.w.cross(rP) - P.w.cross(d));
    const Vec3 w = X.transpose() * (B.w - P.w);
    int position = t.first_position, speed = tree_.positions() + t.first_speed;
    const bool slide_driven = t.driven && t.turns == Turns::none;
    for (int axis = 0; axis < 3; ++axis) {
      if (!t.slides[axis] || (slide_driven && axis == kAlong)) continue;
      y[position++] = X.col(axis).dot(d);
      y[speed++] = d_dot[axis];
    }
    switch (t.turns) {
      case Turns::none:
        break;
      case Turns::about_axis:
        if (t.driven) break;
        y[position] = std::atan2(R(0, 2) - R(2, 0), R(0, 0) + R(2, 2));
        y[speed] = w.y();
        break;
      case Turns::about_two_axes: {
        // R = R1 R2: R1 alone moves the second axis, R2 alone (backwards) the first.
        y[position] = angle_between(t.first_axis, t.second_axis, R * t.second_axis);
        y[position + 1] = -angle_between(t.second_axis, t.first_axis, R.transpose() * t.first_axis);
        // w = rate1 e + rate2 f, e and f not at right angles in general.
        const Vec3 e = t.first_axis, f = R * t.second_axis;
        const double ef = e.dot(f), sine2 = 1.0 - ef * ef;
        y[speed] = (w.dot(e) - ef * w.dot(f)) / sine2;
        y[speed + 1] = (w.dot(f) - ef * w.dot(e)) / sine2;
        break;
      }
      case Turns::ball: {
        const Quat q(R);
        y.segment<4>(position) << q.w(), q.x(), q.y(), q.z();
        y.segment<3>(speed) = w;
        break;
      }
    }
  }
}

void TreeKinematics::position_rates(const VecX& y, VecX& dy) const {
  for (const TreeJoint& t : tree_.joints()) {
    const int speed = tree_.positions() + t.first_speed;
    if (t.turns != Turns::ball) {
      for (int k = 0; k < t.speeds; ++k) dy[t.first_position + k] = y[speed + k];
      continue;
    }
    const int slides = t.speeds - 3;
    for (int k = 0; k < slides; ++k) dy[t.first_position + k] = y[speed + k];
    // qdot = (0, w) q / 2, w in the parent's joint axes.
    const Vec3 w = y.segment<3>(speed + slides);
    const auto q = y.segment<4>(t.first_position + slides);
    auto rate = dy.segment<4>(t.first_position + slides);
    rate[0] = -0.5 * w.dot(q.tail<3>());
    rate.tail<3>() = 0.5 * (q[0] * w + w.cross(q.tail<3>()));
  }
}

void TreeKinematics::displace(const VecX& step, VecX& y) const {
  for (const TreeJoint& t : tree_.joints()) {
    const int scalars = t.turns == Turns::ball ? t.speeds - 3 : t.speeds;
    for (int k = 0; k < scalars; ++k) y[t.first_position + k] += step[t.first_speed + k];
    if (t.turns != Turns::ball) continue;
    const Vec3 turn = step.segment<3>(t.first_speed + scalars);
    Quat q = ball(y, t.first_position + scalars);
    const double angle = turn.norm();
    if (angle > 0.0) q = Quat(Eigen::AngleAxisd(angle, turn / angle)) * q;
    y.segment<4>(t.first_position + scalars) << q.w(), q.x(), q.y(), q.z();
  }
}

void TreeKinematics::normalise(VecX& y) const {
  for (const TreeJoint& t : tree_.joints())
    if (t.turns == Turns::ball) y.segment<4>(t.first_position + t.positions - 4).normalize();
}

}  // namespace boresight
