#include "boresight/mechanism/kinematic_report.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "boresight/math/singular_values.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/motion_density.hpp"
#include "boresight/mechanism/rank_analysis.hpp"
#include "boresight/mechanism/unfollowed_motion.hpp"

namespace boresight {
namespace {

// Poses are looked at once in so many states of the ideal motion's table, where its fastest vibration turns by about half a radian;
// and so many at most.
constexpr int kKnotsBetweenPoses = 8, kMostPoses = 2001;

// Of so many poses those whose singular values are found in seconds, and 21 at least: the time of one grows by the cube of their number.
int affordable(int poses, Eigen::Index values) {
  constexpr double kMultiplications = 1e9;
  constexpr int kFewest = 21;
  return std::clamp(static_cast<int>(kMultiplications / std::pow(static_cast<double>(values), 3)),
                    std::min(kFewest, poses), poses);
}

double inverse_condition(const MatX& A) {
  if (A.size() == 0) return 0.0;
  const VecX s = singular_values(A);
  return s[0] > 0.0 ? s[s.size() - 1] / s[0] : 0.0;
}

// How the boresight body's velocity and angular velocity show in the drives: the rows of D in drive rates = D (v, w).
// Angle drives answer for orientation and displacement drives for position where a mechanism has enough of both.
void conditioning(const Mechanism& mechanism, ConstraintSystem& driven, ConditioningSample& sample) {
  const int drives = static_cast<int>(std::count_if(driven.joints().begin(), driven.joints().end(),
                                                    [](const JointConstraint& joint) { return joint.has_drive(); }));
  if (drives != 6) return;  // fewer drives than freedoms of the body: the two numbers have no meaning
  MatX twist(6, 0);
  std::vector<bool> is_angle;
  for (int k = 0; k < driven.blocks(); ++k) {
    if (!driven.joints()[k].has_drive()) continue;
    std::vector<Vec6> b = driven.block_vector();
    b[k][driven.joints()[k].count() - 1] = 1.0;  // the drive's row comes last
    std::vector<Vec6> u = driven.body_vector();
    driven.least_motion(b, u);
    twist.conservativeResize(6, twist.cols() + 1);
    twist.col(twist.cols() - 1) = u[mechanism.boresight_body()];
    is_angle.push_back(mechanism.description().joints[driven.joints()[k].joint()].type == JointType::revolute);
  }
  const Eigen::FullPivLU<MatX> lu(twist);
  if (!lu.isInvertible()) return;
  const MatX D = lu.inverse();
  MatX angles(0, 3), lengths(0, 3);
  for (int i = 0; i < 6; ++i) {
    MatX& into = is_angle[i] ? angles : lengths;
    into.conservativeResize(into.rows() + 1, 3);
    into.row(into.rows() - 1) = is_angle[i] ? D.row(i).tail<3>() : D.row(i).head<3>();
  }
  if (angles.rows() < 3) angles = D.rightCols<3>();
  if (lengths.rows() < 3) lengths = D.leftCols<3>();
  sample.orientation = inverse_condition(angles);
  sample.position = inverse_condition(lengths);
}

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

// Bearings of one shaft, guides of one slide, that are meant to share an axis and do not, as when a drawing's coordinates were
// rounded: no motion is left then, however small the difference is.
std::vector<std::string> misaligned_joints(const Mechanism& mechanism) {
  constexpr double kAligned = 1e-9, kMeant = 1e-2;
  const std::vector<JointDescription>& joints = mechanism.description().joints;
  const auto turns = [](JointType t) { return t == JointType::revolute || t == JointType::cylindrical; };
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < joints.size(); ++i)
    for (std::size_t k = i + 1; k < joints.size(); ++k) {
      const JointDescription &a = joints[i], &b = joints[k];
      const bool same_parts =
          (a.first == b.first && a.second == b.second) || (a.first == b.second && a.second == b.first);
      const bool slide = a.type == JointType::prismatic && b.type == JointType::prismatic;
      if (!same_parts || !(slide || (turns(a.type) && turns(b.type)))) continue;
      const double angle = a.axis.cross(b.axis).norm();
      const double apart = slide ? 0.0 : (b.point - a.point).cross(a.axis).norm();
      const double off = std::max(angle, apart / mechanism.characteristic_length());
      if (off < kAligned || off > kMeant) continue;
      sentences.push_back('"' + a.name + "\" and \"" + b.name +
                          "\" connect the same parts but do not share one axis: they are " + number(apart) + " m and " +
                          number(angle) +
                          " rad apart, which leaves no motion; give their points and axes to more digits");
    }
  return sentences;
}

// Bodies from which no chain of joints leads to the ground.
std::string loose_bodies(const MechanismDescription& m) {
  std::vector<bool> held(m.bodies.size(), false);
  const auto holds = [&](int body) { return body == kGround || held[static_cast<std::size_t>(body)]; };
  for (bool more = true; more;) {
    more = false;
    for (const JointDescription& j : m.joints)
      if (holds(j.first) != holds(j.second)) {
        held[static_cast<std::size_t>(holds(j.first) ? j.second : j.first)] = true;
        more = true;
      }
  }
  std::string names;
  for (std::size_t b = 0; b < m.bodies.size(); ++b)
    if (!held[b]) names += (names.empty() ? "\"" : "\", \"") + m.bodies[b].name;
  return names.empty() ? names : names + '"';
}

}  // namespace

KinematicReport analyse_kinematics(const Mechanism& mechanism, int samples) {
  const MechanismDescription& m = mechanism.description();
  KinematicReport report;
  report.bodies = mechanism.bodies();
  report.joints = mechanism.joints();

  // Joint rows alone, at home.
  std::vector<BodyMotion> home(m.bodies.size());
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    home[b].p = m.bodies[b].center_of_mass;
    home[b].R = m.bodies[b].axes;
  }
  std::vector<TimeValue> laws(mechanism.joints());
  ConstraintSystem joints(mechanism, {.clearance = ClearanceRows::closed, .drives = false});
  joints.evaluate(home, laws);
  if (joints.violation(mechanism.characteristic_length()) > 1e-6) {
    report.feasible = false;
    report.findings.push_back("the joints do not close at home: the drawing's points and axes disagree by " +
                              number(joints.violation()) + " m or rad");
  }
  RankAnalysis rank = analyse_rank(mechanism, joints, false);
  report.constraint_rows = rank.rows;
  report.rank = rank.rank;
  if (const std::string loose = loose_bodies(m); !loose.empty())
    report.findings.push_back("no chain of joints leads from " + loose + " to the ground: such a body flies freely");
  for (const JointDescription& j : m.joints) report.drives += j.driven;
  report.redundant_rows = rank.rows - rank.rank;
  report.mobility = rank.columns - rank.rank;
  // By rank, not by count: two drives of one freedom leave another one free.
  ConstraintSystem driven(mechanism, {.clearance = ClearanceRows::closed, .drives = true});
  driven.evaluate(home, laws);
  const int driven_rank = constraint_rank(mechanism, driven);
  report.free_freedoms = m.motion.pose ? 0 : rank.columns - driven_rank;
  if (report.drives > report.mobility && !m.motion.pose)
    for (std::string& sentence : misaligned_joints(mechanism)) {
      report.feasible = false;
      report.findings.push_back(std::move(sentence));
    }

  if (const int too_many = report.drives - (driven_rank - rank.rank); too_many > 0 && !m.motion.pose && report.feasible)
    report.findings.push_back(std::to_string(too_many) +
                              " drive(s) more than freedoms to drive: their laws must agree");

  // The ideal motion, sampled; with every drive's row in force, whatever prescribes the motion.
  const bool kinematic = m.motion.pose || report.free_freedoms == 0;
  if (!kinematic) {
    report.findings.push_back(std::to_string(report.free_freedoms) +
                              " freedom(s) are not driven: the ideal motion is the simulated one without clearance");
    return report;
  }
  const std::vector<Mat6> weight = kinematic_weight(mechanism);
  IdealSolver solver(mechanism);
  IdealState state;
  // What moves fast is looked at more often. A motion that ends before its time is followed pose by pose to where it does.
  std::optional<IdealMotion> ideal;
  try {
    solver.start(state);
    try {
      ideal = IdealMotion::kinematic(mechanism);
    } catch (const MotionTooDense&) {
      throw;
    } catch (const ComputationError&) {
    }
  } catch (const ComputationError& e) {
    report.feasible = false;
    report.findings.push_back(e.what());
    return report;
  }
  if (ideal) samples = std::clamp(ideal->knots() / kKnotsBetweenPoses, samples, std::max(samples, kMostPoses));
  samples = affordable(samples, 6 * mechanism.bodies());
  bool inside_singular = false;
  for (int k = 0; k < samples; ++k) {
    const double t = mechanism.duration() * k / (samples - 1);
    work_reached("checking poses along the motion", t / mechanism.duration());
    if (ideal) {
      ideal->state(t, state);
    } else if (k > 0) {
      // Substeps where Newton needs them.
      double step = t - state.t;
      while (state.t < t) {
        const double next = t - state.t <= step * 1.0000001 ? t : state.t + step;
        if (solver.solve(next, state)) continue;
        if ((step *= 0.5) < std::min(1e-6 * mechanism.duration(), 1e-6)) break;
      }
      if (state.t < t) {
        report.feasible = false;
        report.findings.push_back("the ideal motion cannot be followed beyond t = " + number(state.t) +
                                  " s: " + why_not_followed(mechanism, state.t, step));
        break;
      }
    }
    for (int j = 0; j < mechanism.joints(); ++j)
      if (m.joints[j].driven) laws[j] = joint_coordinate(mechanism, j, state.bodies, &state.acceleration);
    driven.evaluate(state.bodies, laws);
    joints.evaluate(state.bodies, laws);
    if (k == samples / 3) {
      // A pose away from home tells redundancy of the mechanism from a special home pose.
      rank = analyse_rank(mechanism, joints, false);
      report.rank = std::max(report.rank, rank.rank);
      report.redundant_rows = rank.rows - report.rank;
      report.mobility = rank.columns - report.rank;
    }
    const RankAnalysis r = analyse_rank(mechanism, driven, false);
    ConditioningSample sample{t, r.weakest, 0.0, 0.0};
    const bool singular = r.weakest < kSingular * r.largest;
    if (singular) {
      if (!inside_singular) report.lost.push_back(lost_motion(mechanism, driven, t, false));
    } else {
      driven.set_redundant(r.rank < r.rows);
      if (driven.factor(weight)) conditioning(mechanism, driven, sample);
    }
    inside_singular = singular;
    report.along.push_back(sample);
  }
  // And those that lie between.
  if (ideal)
    for (const LostMotion& between : ideal->lost()) {
      const auto near = [&](const LostMotion& other) {
        return std::abs(other.t - between.t) < mechanism.duration() / (samples - 1);
      };
      if (std::none_of(report.lost.begin(), report.lost.end(), near)) report.lost.push_back(between);
    }
  std::sort(report.lost.begin(), report.lost.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
  const bool jointed = std::any_of(m.joints.begin(), m.joints.end(),
                                   [](const JointDescription& j) { return j.type != JointType::fixed; });
  if (report.mobility == 0 && report.drives == 0 && jointed && !m.motion.pose)
    report.findings.push_back(
        "nothing can move: the joints together leave no freedom, and none is driven; if something should move, axes "
        "that are meant to be parallel or to meet may differ by a little");
  for (const LostMotion& lost : report.lost)
    report.findings.push_back("singular at t = " + number(lost.t) + " s: " + lost.description);
  if (report.redundant_rows > 0)
    report.findings.push_back(std::to_string(report.redundant_rows) +
                              " constraint row(s) are redundant: motion and clearance forces are unique, the ideal "
                              "reactions inside the redundant loops are not");
  return report;
}

void look_along(const Mechanism& mechanism, const IdealMotion& motion, KinematicReport& report, int samples) {
  ConstraintSystem system(mechanism, {.clearance = ClearanceRows::closed});
  const std::vector<TimeValue> laws(mechanism.joints());
  IdealState state;
  const auto values_at = [&](double t) {
    motion.state(t, state);
    system.evaluate(state.bodies, laws);
    return singular_values_of_loops(mechanism, system);
  };
  // What is free anywhere else is not lost: the last value that is not zero there tells.
  const VecX elsewhere = values_at(generic_instant(0.0, motion.duration()));
  const auto rank = (elsewhere.array() > kRankTolerance * (elsewhere.size() > 0 ? elsewhere[0] : 0.0)).count();
  if (rank == 0) return;
  samples = affordable(samples, elsewhere.size());
  const auto lock = [&](double t) {
    const VecX values = values_at(t);
    return values[rank - 1] / values[0];
  };
  const auto time = [&](int k) { return motion.duration() * k / (samples - 1); };
  std::vector<double> locks;
  for (int k = 0; k < samples; ++k) {
    work_reached("checking poses along the motion", static_cast<double>(k) / samples);
    const VecX values = values_at(time(k));
    report.along.push_back({time(k), values[rank - 1], 0.0, 0.0});
    locks.push_back(values[rank - 1] / values[0]);
  }
  double found_until = -1.0;
  for (int k = 0; k < samples; ++k) {
    const int before = std::max(k - 1, 0), after = std::min(k + 1, samples - 1);
    if (!may_be_zero_near(locks[k], locks[before], locks[after])) continue;
    const double t = locks[k] < kSingular ? time(k) : weakest_between(time(before), time(after), lock);
    if (t <= found_until || !(lock(t) < kSingular)) continue;
    report.passed.push_back(t);
    found_until = time(after);
  }
}

}  // namespace boresight
