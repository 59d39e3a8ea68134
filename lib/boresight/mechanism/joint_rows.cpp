#include "boresight/mechanism/joint_rows.hpp"

#include <cmath>
#include <numbers>

#include "boresight/mechanism/offset_choice.hpp"

namespace boresight {
namespace {

const BodyMotion kGroundMotion;

const BodyMotion& motion_of(const std::vector<BodyMotion>& bodies, int body) {
  return body == kGround ? kGroundMotion : bodies[body];
}

// m of the header, by which the relative angular velocity becomes the rate of the twist, and its own rate.
struct TwistAxis {
  Vec3 m, m_dot;
};
TwistAxis axis_of_twist(const Vec3& yA, const Vec3& yB, const Vec3& wA, const Vec3& wB) {
  const double s = 1.0 + yA.dot(yB);
  const Vec3 m = (yA + yB) / s;
  const Vec3 yA_dot = wA.cross(yA), yB_dot = wB.cross(yB);
  return {m, (yA_dot + yB_dot - m * (yA_dot.dot(yB) + yA.dot(yB_dot))) / s};
}

// Turn of a direction v about the normal of e and f, the gradient by its angular velocity relative to theirs, and that gradient's own rate.
struct DirectionTurn {
  double angle;
  Vec3 gradient, gradient_rate;
};
DirectionTurn turn_of_direction(const Vec3& v, const Vec3& w_of_v, const Vec3& e, const Vec3& f, const Vec3& w_of_ef) {
  const Vec3 v_dot = w_of_v.cross(v), e_dot = w_of_ef.cross(e), f_dot = w_of_ef.cross(f);
  const double ve = v.dot(e), vf = v.dot(f), square = ve * ve + vf * vf;
  const double ve_dot = v_dot.dot(e) + v.dot(e_dot), vf_dot = v_dot.dot(f) + v.dot(f_dot);
  const Vec3 p = e * vf - f * ve, p_dot = e_dot * vf + e * vf_dot - f_dot * ve - f * ve_dot;
  const Vec3 gradient = v.cross(p) / square;
  return {std::atan2(ve, vf), gradient,
          (v_dot.cross(p) + v.cross(p_dot) - gradient * (2.0 * (ve * ve_dot + vf * vf_dot))) / square};
}

double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

bool has_points(JointType t) {
  return t == JointType::revolute || t == JointType::universal || t == JointType::spherical || t == JointType::fixed;
}

}  // namespace

JointConstraint::JointConstraint(const Mechanism& mechanism, int joint, ClearanceRows clearance_rows, bool with_drive)
    : joint_(joint) {
  const JointDescription& description = mechanism.description().joints[joint];
  const JointGeometry& geometry = mechanism.geometry(joint);
  const int clearance = mechanism.clearance_of(joint);
  const bool sleeve_is_second =
      clearance >= 0 && mechanism.description().clearances[clearance].journal == description.first;
  reference_ = sleeve_is_second ? geometry.second : geometry.first;
  other_ = sleeve_is_second ? geometry.first : geometry.second;
  second_axis_ = geometry.second_axis;
  drive_sign_ = sleeve_is_second ? -1.0 : 1.0;

  const bool loose = clearance >= 0 && clearance_rows != ClearanceRows::closed;
  const bool tilts = loose && mechanism.description().clearances[clearance].axes == JournalAxes::free;
  const bool want_released = clearance_rows == ClearanceRows::released;
  std::vector<bool> yields;
  if (clearance_rows == ClearanceRows::held && loose && mechanism.offset_choice())
    yields = mechanism.offset_choice()->dependent_rows(OffsetLayout(mechanism), clearance);
  std::size_t released_rows = 0;
  const auto add = [&](bool released, Row row) {
    const bool yielding = released && released_rows < yields.size() && yields[released_rows];
    if (released) ++released_rows;
    if (clearance_rows == ClearanceRows::held ? !yielding : released == want_released) rows_.push_back(row);
  };

  const JointType type = description.type;
  if (clearance_rows == ClearanceRows::free) {
    add_free_rows(type);
    // Turns are zero at home, where the second axis lies as drawn.
    const Mat3 A =
        reference_.body == kGround ? Mat3(Mat3::Identity()) : mechanism.description().bodies[reference_.body].axes;
    const Vec3 second = (A * reference_.R).transpose() * description.second_axis;
    for (Row& row : rows_)
      if (row.kind == Kind::turn && row.a == 0) row.home = std::atan2(second.x(), second.z());
    return;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const bool along = axis == 1;
    const bool held = has_points(type) || (slides_along_axis(type) && !along) || (type == JointType::planar && along);
    if (held) add(loose, {Kind::distance, axis});
  }
  if (keeps_axis(type)) {
    add(tilts, {Kind::angle, 0, 1});
    add(tilts, {Kind::angle, 2, 1});
  }
  if (type == JointType::universal) add(false, {Kind::angle, 1, 3, description.axis.dot(description.second_axis)});
  // The roll that a rectangular guide leaves is a twist, of which moments are known however far the slider tilts.
  if (clearance >= 0 && rolls(mechanism.description().clearances[clearance], type))
    add(loose, {Kind::twist});
  else if (type == JointType::prismatic && tilts)
    add(false,
        {Kind::twist});  // however a round guide's key lies about its axis, a slider that tilts keeps the same turn
  else if (type == JointType::prismatic || type == JointType::fixed)
    add(false, {Kind::angle, 2, 0});
  if (with_drive && description.driven && !want_released) {
    drive_row_ = static_cast<int>(rows_.size());
    rows_.push_back(type == JointType::revolute ? Row{Kind::twist} : Row{Kind::distance, 1});
  }
}

void JointConstraint::add_free_rows(JointType type) {
  for (int axis = 0; axis < 3; ++axis) {
    const bool along = axis == 1;
    if ((slides_along_axis(type) && along) || (type == JointType::planar && !along))
      rows_.push_back({Kind::distance, axis});
  }
  if (type == JointType::universal) {
    rows_.push_back({Kind::turn, 0});
    rows_.push_back({Kind::turn, 1});
    return;
  }
  if (type == JointType::spherical) {
    rows_.push_back({Kind::angle, 0, 1});
    rows_.push_back({Kind::angle, 2, 1});
  }
  if (type != JointType::prismatic && type != JointType::fixed) rows_.push_back({Kind::twist});
}

void JointConstraint::evaluate(const std::vector<BodyMotion>& bodies, const TimeValue& law, JointRows& rows) const {
  const BodyMotion& A = motion_of(bodies, reference_.body);
  const BodyMotion& B = motion_of(bodies, other_.body);
  const Vec3 rA = A.R * reference_.p, rB = B.R * other_.p;
  const Mat3 XA = A.R * reference_.R, XB = B.R * other_.R;
  const Vec3 d = B.p + rB - A.p - rA;
  const Vec3 A_turn = A.w.cross(rA), B_turn = B.w.cross(rB);
  const Vec3 d_dot = B.v + B_turn - A.v - A_turn;
  // Bias of the points' relative acceleration: the centripetal parts.
  const Vec3 d_bias = B.w.cross(B_turn) - A.w.cross(A_turn);
  const Vec3 w_rel = B.w - A.w;

  for (int i = 0; i < count(); ++i) {
    const Row& row = rows_[i];
    double bias = 0.0;
    switch (row.kind) {
      case Kind::distance: {
        const Vec3 a = XA.col(row.a);
        const Vec3 a_dot = A.w.cross(a);
        rows.reference.row(i) << -a.transpose(), a.cross(rA + d).transpose();
        rows.other.row(i) << a.transpose(), rB.cross(a).transpose();
        rows.value[i] = a.dot(d);
        rows.rate[i] = a.dot(d_dot) + a_dot.dot(d);
        bias = a.dot(d_bias) + 2.0 * a_dot.dot(d_dot) + A.w.cross(a_dot).dot(d);
        break;
      }
      case Kind::angle: {
        const Vec3 a = XA.col(row.a);
        const Vec3 b = row.b == 3 ? Vec3(B.R * second_axis_) : Vec3(XB.col(row.b));
        const Vec3 c = a.cross(b);
        rows.reference.row(i) << Vec3::Zero().transpose(), c.transpose();
        rows.other.row(i) << Vec3::Zero().transpose(), -c.transpose();
        rows.value[i] = a.dot(b) - row.home;
        rows.rate[i] = -w_rel.dot(c);
        bias = -w_rel.dot(A.w.cross(a).cross(b) + a.cross(B.w.cross(b)));
        break;
      }
      case Kind::twist: {
        const auto [m, m_dot] = axis_of_twist(XA.col(1), XB.col(1), A.w, B.w);
        rows.reference.row(i) << Vec3::Zero().transpose(), -m.transpose();
        rows.other.row(i) << Vec3::Zero().transpose(), m.transpose();
        rows.value[i] = twist_about_y(XA.transpose() * XB);
        rows.rate[i] = w_rel.dot(m);
        bias = w_rel.dot(m_dot);
        break;
      }
      case Kind::turn: {
        const Vec3 s = B.R * second_axis_;
        if (row.a == 0) {
          const DirectionTurn turn = turn_of_direction(s, B.w, XA.col(0), XA.col(2), A.w);
          rows.reference.row(i) << Vec3::Zero().transpose(), -turn.gradient.transpose();
          rows.other.row(i) << Vec3::Zero().transpose(), turn.gradient.transpose();
          rows.value[i] = wrapped(turn.angle - row.home);
          rows.rate[i] = w_rel.dot(turn.gradient);
          bias = w_rel.dot(turn.gradient_rate);
        } else {
          // The first axis as the second body sees it: that body turns the other way.
          const Vec3 f = (XB.col(1) - s * s.dot(XB.col(1))).normalized();
          const DirectionTurn turn = turn_of_direction(XA.col(1), A.w, s.cross(f), f, B.w);
          rows.reference.row(i) << Vec3::Zero().transpose(), -turn.gradient.transpose();
          rows.other.row(i) << Vec3::Zero().transpose(), turn.gradient.transpose();
          rows.value[i] = -turn.angle;
          rows.rate[i] = w_rel.dot(turn.gradient);
          bias = w_rel.dot(turn.gradient_rate);
        }
        break;
      }
    }
    rows.gamma[i] = -bias;
    if (i == drive_row_) {
      // Of a turn that has gone on for thousands of turns, what is left of the last one: the difference keeps its digits.
      const bool turns = row.kind == Kind::twist;
      rows.value[i] -= drive_sign_ * (turns ? wrapped(law.value) : law.value);
      if (turns) rows.value[i] = wrapped(rows.value[i]);
      rows.rate[i] -= drive_sign_ * law.rate;
      rows.gamma[i] += drive_sign_ * law.acceleration;
    }
  }
}

double twist_about_y(const Mat3& R) { return std::atan2(R(0, 2) - R(2, 0), R(0, 0) + R(2, 2)); }

Eigen::Vector2d direction_of_twist(const Mat3& R) {
  return Eigen::Vector2d(R(0, 0) + R(2, 2), R(0, 2) - R(2, 0)).normalized();
}

Eigen::Vector2d twist_of_insert(const Mechanism& mechanism, int clearance, const std::vector<BodyMotion>& bodies) {
  const MechanismDescription& m = mechanism.description();
  const ClearanceDescription& d = m.clearances[static_cast<std::size_t>(clearance)];
  const JointGeometry& g = mechanism.geometry(d.joint);
  const bool insert_first = d.journal == m.joints[static_cast<std::size_t>(d.joint)].first;
  const JointFrame &seat = insert_first ? g.second : g.first, &insert = insert_first ? g.first : g.second;
  return direction_of_twist((motion_of(bodies, seat.body).R * seat.R).transpose() *
                            (motion_of(bodies, insert.body).R * insert.R));
}

TimeValue joint_coordinate(const Mechanism& mechanism, int joint, const std::vector<BodyMotion>& bodies,
                           const std::vector<BodyAcceleration>* acceleration) {
  const JointGeometry& g = mechanism.geometry(joint);
  const BodyMotion& A = motion_of(bodies, g.first.body);
  const BodyMotion& B = motion_of(bodies, g.second.body);
  const Mat3 XA = A.R * g.first.R, XB = B.R * g.second.R;
  const auto acceleration_of = [&](int body) -> Vec6 {
    return acceleration && body != kGround ? (*acceleration)[body] : Vec6(Vec6::Zero());
  };
  const Vec6 aA = acceleration_of(g.first.body), aB = acceleration_of(g.second.body);
  TimeValue result;
  if (mechanism.description().joints[joint].type == JointType::prismatic) {
    const Vec3 rA = A.R * g.first.p, rB = B.R * g.second.p, a = XA.col(1);
    const Vec3 d = B.p + rB - A.p - rA;
    const Vec3 d_dot = B.v + B.w.cross(rB) - A.v - A.w.cross(rA);
    const Vec3 d_ddot = aB.head<3>() + aB.tail<3>().cross(rB) + B.w.cross(B.w.cross(rB)) - aA.head<3>() -
                        aA.tail<3>().cross(rA) - A.w.cross(A.w.cross(rA));
    const Vec3 a_dot = A.w.cross(a), a_ddot = aA.tail<3>().cross(a) + A.w.cross(a_dot);
    result.value = a.dot(d);
    result.rate = a.dot(d_dot) + a_dot.dot(d);
    result.acceleration = a.dot(d_ddot) + 2.0 * a_dot.dot(d_dot) + a_ddot.dot(d);
  } else {
    const Vec3 w_rel = B.w - A.w;
    const auto [m, m_dot] = axis_of_twist(XA.col(1), XB.col(1), A.w, B.w);
    result.value = twist_about_y(XA.transpose() * XB);
    result.rate = w_rel.dot(m);
    result.acceleration = (aB - aA).tail<3>().dot(m) + w_rel.dot(m_dot);
  }
  return result;
}

}  // namespace boresight
