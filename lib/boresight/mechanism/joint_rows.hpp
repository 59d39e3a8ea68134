// The constraint rows of one joint: value, Jacobian and the acceleration they demand, in velocities (v, w) of its bodies.
//
// With A the reference body (the sleeve of a clearance joint, else the joint's first body), B the other one, a an axis of
// the joint frame fixed in A, b one fixed in B, d = p_B - p_A the joint's points apart, all in world axes:
//   distance  g = a . d                     gdot = a . (v_B + w_B x r_B) - a . (v_A + w_A x r_A) + (w_A x a) . d
//   angle     g = a . b                     gdot = (w_A - w_B) . (a x b)
//   twist     g = turn of B about y_A       gdot = (w_B - w_A) . m,  m = (y_A + y_B) / (1 + y_A . y_B)
//   turn      g = atan2(v . e, v . f)       gdot = (w_v - w_e) . (v x (e (v . f) - f (v . e))) / ((v . e)^2 + (v . f)^2)
// Each with gddot = J vdot + bias. The twist is that of the swing-twist decomposition (the angle left when B's axis is
// swung onto A's by the shortest way), so it stays smooth when a journal tilts. The turn is that of an axis v of one body about the normal of e
// and f of the other: a universal joint's two turns, which no pose of it makes singular. Sources: Nikravesh (1988), Computer-Aided
// Analysis of Mechanical Systems, chapter 7, for the first two; the others derived here, held against differences in a test.
#pragma once

#include <vector>

#include "boresight/math/time_function.hpp"
#include "boresight/mechanism/body_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

// Rows of the same joint, at most six; rows from `count` on are zero.
struct JointRows {
  Mat6 reference = Mat6::Zero();  // d gdot / d(v_A, w_A), row by row
  Mat6 other = Mat6::Zero();      // d gdot / d(v_B, w_B)
  Vec6 value = Vec6::Zero();      // g minus its law [m] or [rad] or [-]
  Vec6 rate = Vec6::Zero();       // gdot minus its law
  Vec6 gamma = Vec6::Zero();      // J vdot must equal this (the paper's gamma, Eq. 40): law's acceleration minus bias
};

// Which rows of a clearance joint are written out.
enum class ClearanceRows {
  closed,  // as if the joint were ideal
  held,  // as closed, of a built mechanism less the offsets that follow from others: redundant joints' play takes up errors
  open,      // only those that clearance leaves in force
  released,  // only those that clearance releases, in the order x, y, z of the sleeve frame, then the two tilts (free axes), then the roll
  free       // what the joint leaves free even without clearance: its turns and slides, as rows that would hold them
};

// The fixed part: which rows a joint has.
class JointConstraint {
 public:
  // with_drive: the drive's row too, where the joint is driven.
  JointConstraint(const Mechanism& mechanism, int joint, ClearanceRows clearance, bool with_drive);

  int joint() const { return joint_; }
  int reference_body() const { return reference_.body; }
  int other_body() const { return other_.body; }
  int count() const { return static_cast<int>(rows_.size()); }
  bool has_drive() const { return drive_row_ >= 0; }
  int drive_row() const { return drive_row_; }
  double drive_sign() const { return drive_sign_; }  // -1 where its law counts the other way
  // Whether a row's value is a length [m] and not an angle or a slope.
  bool is_distance(int row) const { return rows_[row].kind == Kind::distance; }

  // law: of the drive, relative to home; ignored where there is none. bodies: all of the mechanism's.
  void evaluate(const std::vector<BodyMotion>& bodies, const TimeValue& law, JointRows& rows) const;

 private:
  enum class Kind { distance, angle, twist, turn };
  struct Row {
    Kind kind;
    int a = 0;  // axis of the reference frame: 0 x, 1 y, 2 z; of a turn: 0 about the first axis, 1 about the second
    int b = 0;  // axis of the other frame; 3 the universal joint's second axis
    double home = 0.0;  // value at home: a universal joint keeps the angle between its axes that the drawing shows
  };
  void add_free_rows(JointType type);

  int joint_;
  JointFrame reference_, other_;
  Vec3 second_axis_;
  std::vector<Row> rows_;
  int drive_row_ = -1;
  double drive_sign_ = 1.0;  // -1 where the reference body is the joint's second
};

// Turn of R about its y axis, from the rotation that takes components in B's joint frame to A's [rad].
double twist_about_y(const Mat3& R_AB);
// Its cosine and sine.
Eigen::Vector2d direction_of_twist(const Mat3& R_AB);
// The same of the insert of a joint with play, as its seat sees it.
Eigen::Vector2d twist_of_insert(const Mechanism& mechanism, int clearance, const std::vector<BodyMotion>& bodies);

// The joint's own coordinate and its derivatives, second body seen from first: the turn of a revolute about its axis
// [rad, in (-pi, pi]], the displacement of a prismatic along it [m]. acceleration: of all bodies, or null for none.
TimeValue joint_coordinate(const Mechanism& mechanism, int joint, const std::vector<BodyMotion>& bodies,
                           const std::vector<BodyAcceleration>* acceleration);

}  // namespace boresight
