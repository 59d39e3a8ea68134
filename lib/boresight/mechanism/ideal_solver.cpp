#include "boresight/mechanism/ideal_solver.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/rank_analysis.hpp"
#include "boresight/mechanism/strained_joints.hpp"

namespace boresight {
namespace {

Vec3 unit(int axis) { return Vec3::Unit(axis); }

// Newton's limits. Convergence is quadratic, so a guess that needs more steps than this lies outside the basin that the
// continuation is meant to stay in, and a shorter step is taken instead.
constexpr int kNewtonSteps = 10;
constexpr double kConverged = 1e-12;  // of the characteristic length, or rad
constexpr double kExact = 1e-15;
constexpr double kLargestCorrection = 0.3;  // [characteristic length or rad]: beyond it the branch could change
constexpr double kAnyCorrection = std::numeric_limits<double>::infinity();

// Why joints do not close at home, by those that stay open.
std::string left_open(const Mechanism& mechanism, const ConstraintSystem& system) {
  const double length = mechanism.characteristic_length();
  std::vector<double> open(static_cast<std::size_t>(mechanism.joints()), 0.0);
  for (int k = 0; k < static_cast<int>(system.joints().size()); ++k)
    for (int i = 0; i < system.joints()[k].count(); ++i) {
      double& joint = open[static_cast<std::size_t>(system.joints()[k].joint())];
      joint = std::max(joint, std::abs(system.rows(k).value[i]) / (system.joints()[k].is_distance(i) ? length : 1.0));
    }
  const std::string joints = strained_joints(mechanism, open);
  return mechanism.built()
             ? "the built mechanism's " + joints + " not close: its errors cannot be taken up without straining"
             : "the " + joints + " not close at home: the drawing's points and axes disagree";
}

}  // namespace

PrescribedPose prescribed_pose(const MechanismDescription& mechanism, double t) {
  const PoseMotionDescription& motion = *mechanism.motion.pose;
  PrescribedPose pose;
  for (int k = 0; k < 3; ++k) {
    const TimeValue x = motion.position[k]->at(t);
    pose.p[k] = x.value;
    pose.v[k] = x.rate;
    pose.a[k] = x.acceleration;
  }
  // R = R1 R2 R3 with elementary turns about fixed letters; each turn's axis is carried along by the turns before it, so
  // w = sum of rate_k e_k and alpha = sum of acceleration_k e_k + rate_k (w of the turns before) x e_k.
  Mat3 R = Mat3::Identity();
  for (int k = 0; k < 3; ++k) {
    const TimeValue turn = motion.angle[k]->at(t);
    const Vec3 e = R * unit(motion.sequence[k]);
    pose.alpha += turn.acceleration * e + turn.rate * pose.w.cross(e);
    pose.w += turn.rate * e;
    R = R * Eigen::AngleAxisd(turn.value, unit(motion.sequence[k])).toRotationMatrix();
  }
  pose.R = R * mechanism.bodies[motion.body].axes;
  return pose;
}

std::vector<Mat6> kinematic_weight(const Mechanism& mechanism) {
  Vec6 w = Vec6::Ones();
  w.head<3>() *= mechanism.characteristic_length() * mechanism.characteristic_length();
  return std::vector<Mat6>(mechanism.bodies(), Mat6(w.asDiagonal()));
}

IdealSolver::IdealSolver(const Mechanism& mechanism)
    : mechanism_(mechanism),
      system_(mechanism,
              {.clearance = mechanism.built() ? ClearanceRows::held : ClearanceRows::closed,
               .drives = !mechanism.description().motion.pose,
               .prescribed_body =
                   mechanism.description().motion.pose ? mechanism.description().motion.pose->body : kGround}),
      weight_(kinematic_weight(mechanism)),
      laws_(mechanism.joints()),
      blocks_(system_.block_vector()),
      motion_(system_.body_vector()),
      // An open chain that its drives move closes in one way.
      largest_correction_(open_chain() && !mechanism.description().motion.pose ? kAnyCorrection : kLargestCorrection) {}

bool IdealSolver::open_chain() const { return mechanism_.joints() == mechanism_.bodies(); }

void IdealSolver::laws_at(double t, double scale) {
  for (const auto& [joint, law] : mechanism_.description().motion.drives) {
    laws_[joint] = law->at(t);
    laws_[joint].value *= scale;
  }
  if (!mechanism_.description().motion.pose) return;
  PrescribedPose pose = prescribed_pose(mechanism_.description(), t);
  if (scale < 1.0) {
    const BodyDescription& home = mechanism_.description().bodies[mechanism_.description().motion.pose->body];
    pose.p = home.center_of_mass + scale * (pose.p - home.center_of_mass);
    pose.R = Quat(home.axes).slerp(scale, Quat(pose.R)).toRotationMatrix();
  }
  system_.pose() = pose;
}

// Where rows turn out to depend on each other they are told to; false where that is not why there are no factors.
bool IdealSolver::factor() {
  if (system_.factor(weight_)) return true;
  if (system_.redundant()) return false;
  if (constraint_rank(mechanism_, system_) == system_.row_count()) return false;
  system_.set_redundant(true);
  return system_.factor(weight_);
}

bool IdealSolver::newton(IdealState& state) {
  const double length = mechanism_.characteristic_length();
  // A drawing far from the world's origin keeps fewer digits of its lengths.
  double farthest = 0.0;
  for (const BodyMotion& body : state.bodies) farthest = std::max(farthest, body.p.lpNorm<Eigen::Infinity>());
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * farthest / length;
  const double exact = std::max(kExact, 0.25 * rounding), converged = std::max(kConverged, rounding);
  double previous = 1e300, corrected = 0.0;
  for (int step = 0; step < kNewtonSteps; ++step) {
    system_.evaluate(state.bodies, laws_);
    const double violation = system_.violation(length);
    if (!std::isfinite(violation)) return false;
    // Converged; one more step is still worth its cost while it gains digits.
    if (violation < exact || (violation < converged && violation > 0.3 * previous)) return true;
    if (!factor()) return false;
    for (int k = 0; k < system_.blocks(); ++k) blocks_[k] = -system_.rows(k).value;
    system_.least_motion(blocks_, motion_);
    for (int b = 0; b < mechanism_.bodies(); ++b) {
      corrected = std::max({corrected, motion_[b].head<3>().norm() / length, motion_[b].tail<3>().norm()});
      displace(state.bodies[b], motion_[b]);
    }
    if (!(corrected < largest_correction_)) return false;
    previous = violation;
  }
  return previous < converged;
}

bool IdealSolver::differentiate(IdealState& state) {
  const int bodies = mechanism_.bodies();
  // Velocities: J u = law's rate, which is minus the rate the rows have with all bodies at rest.
  for (BodyMotion& b : state.bodies) b.v = b.w = Vec3::Zero();
  system_.evaluate(state.bodies, laws_);
  if (!factor()) return false;
  for (int k = 0; k < system_.blocks(); ++k) blocks_[k] = -system_.rows(k).rate;
  system_.least_motion(blocks_, motion_);
  for (int b = 0; b < bodies; ++b) {
    state.bodies[b].v = motion_[b].head<3>();
    state.bodies[b].w = motion_[b].tail<3>();
  }
  // One refinement: J W J^T squares the condition number, the residual of J u brings the digits back.
  system_.evaluate(state.bodies, laws_);
  for (int k = 0; k < system_.blocks(); ++k) blocks_[k] = -system_.rows(k).rate;
  system_.least_motion(blocks_, motion_);
  for (int b = 0; b < bodies; ++b) {
    state.bodies[b].v += motion_[b].head<3>();
    state.bodies[b].w += motion_[b].tail<3>();
  }
  system_.evaluate(state.bodies, laws_);
  std::vector<Vec6>& acceleration = state.acceleration;
  for (int k = 0; k < system_.blocks(); ++k) blocks_[k] = system_.rows(k).gamma;
  system_.least_motion(blocks_, acceleration);
  std::vector<Vec6> residual = system_.block_vector();
  system_.multiply(acceleration, residual);
  for (int k = 0; k < system_.blocks(); ++k) residual[k] = system_.rows(k).gamma - residual[k];
  system_.least_motion(residual, motion_);
  for (int b = 0; b < bodies; ++b) acceleration[b] += motion_[b];
  return true;
}

// From home, in steps that go on along the same branch.
bool IdealSolver::reach_start(IdealState& state) {
  double done = 0.0, step = 1.0;
  while (done < 1.0) {
    IdealState trial = state;
    const double next = std::min(1.0, done + step);
    laws_at(0.0, next);
    if (newton(trial)) {
      state = trial;
      done = next;
      step = std::min(1.0, 2.0 * step);
    } else if ((step *= 0.5) < 1e-4) {
      return false;
    }
  }
  return true;
}

void IdealSolver::start(IdealState& state) {
  const MechanismDescription& m = mechanism_.description();
  state.t = 0.0;
  state.bodies.assign(m.bodies.size(), BodyMotion{});
  state.acceleration.assign(m.bodies.size(), Vec6::Zero());
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    state.bodies[b].p = m.bodies[b].center_of_mass;
    state.bodies[b].R = m.bodies[b].axes;
  }
  laws_at(0.0, 0.0);
  system_.evaluate(state.bodies, laws_);
  // Every sample of a study starts so: what motion is left, for many times the work, is asked where one is.
  const int rank = constraint_rank(mechanism_, system_), columns = 6 * system_.bodies();
  if (rank < columns) {
    const VecX free = analyse_rank(mechanism_, system_).least_resisted;
    throw ComputationError("at home, with the prescribed motion held, " + std::to_string(columns - rank) +
                           " freedom(s) remain: \"" + m.bodies[mechanism_.boresight_body()].name + "\" " +
                           describe_motion(mechanism_, free, mechanism_.boresight_body()) +
                           "; drive them, or describe the motion by [initial] rates");
  }
  system_.set_redundant(rank < system_.row_count());

  if (!newton(state)) throw ComputationError(left_open(mechanism_, system_));
  const IdealState home = state;
  if (!reach_start(state)) {
    // Few axes may reach a pose, and none of those on the straight way there.
    state = home;
    const double limit = std::exchange(largest_correction_, kAnyCorrection);
    const bool reached = open_chain() && reach_start(state);
    largest_correction_ = limit;
    if (!reached) throw ComputationError("the starting pose cannot be reached from home");
  }
  if (!differentiate(state)) throw ComputationError("the starting pose is singular");
}

bool IdealSolver::solve(double t, IdealState& state) {
  IdealState trial = state;
  const double dt = t - state.t;
  for (int b = 0; b < mechanism_.bodies(); ++b) {
    const BodyMotion& now = state.bodies[b];
    Vec6 step;
    step << now.v, now.w;
    step = dt * step + 0.5 * dt * dt * state.acceleration[b];
    displace(trial.bodies[b], step);
  }
  laws_at(t, 1.0);
  if (!newton(trial) || !differentiate(trial)) return false;
  trial.t = t;
  state = std::move(trial);
  return true;
}

}  // namespace boresight
