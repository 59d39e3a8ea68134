// Joint coordinates over a spanning tree, the fast formulation of the multibody rung.
//
// Of the joints only the freedoms remain: coordinates and speeds u of the tree's joints, of which the driven ones are known
// functions of time and drop out. The cut joints close the loops by multipliers. (Default scene: 16 joint coordinates, 6 of
// them driven, 7 rows; the paper's formulation has 78 coordinates and 75 rows.) With G the rows' Jacobian,
//
//   H udot + G^T lambda = tau,  G udot = gamma'
//   =>  (G H^-1 G^T) lambda = G H^-1 tau - gamma',  udot = H^-1 (tau - G^T lambda)
//
// where gamma' holds the rows' own gamma, less what the bodies' bias accelerations make of it, and Baumgarte's terms if these
// are wanted. Parts, each with its equations:
//   SpanningTree        which joints carry, which ones close loops
//   TreeKinematics      bodies from coordinates
//   JointSpaceInertia   H and tau from bodies
//   LoopClosure         G, gamma' and lambda
//
// Stabilisation is projection unless told otherwise: settle() closes the loops again along the shortest way in the norm of H
// (Eich 1993, SIAM J. Numer. Anal. 30). The loops open by 5e-13 m at most in a step of the default scene (RK4, 1e-4 s), so
// one pass with the factors of the step's last derivative() closes them to rounding, at half the cost of a derivative().
//
// State: positions, then speeds, as in TreeKinematics.
// Source: Featherstone (2008), Rigid Body Dynamics Algorithms, chapters 6 and 8.

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/formulations/baumgarte_stabilisation.hpp"
#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/singular_pose.hpp"
#include "boresight/formulations/tree_inertia.hpp"
#include "boresight/formulations/tree_loops.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/offset_layout.hpp"

namespace boresight {
namespace {

// Newton's steps towards closed loops use the factors at hand where these are of nearly the same pose: they then remove all
// but about this share of the opening [characteristic lengths or rad, of the positions and of the opening alike].
constexpr double kNearPose = 1e-3;
// The step that finds the loops open by less than this [alike] is the last: it leaves them closed to rounding, and in their
// rates no more than this times the speeds.
constexpr double kClosed = 1e-12;
constexpr int kNewtonSteps = 8;

constexpr double kNever = std::numeric_limits<double>::quiet_NaN();  // equal to no time

class TreeFormulation final : public Formulation {
 public:
  TreeFormulation(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion* drives,
                  const TreeFormulationOptions& options)
      : Formulation(mechanism, parameters, options.with_clearance),
        mechanism_(mechanism),
        drives_(drives),
        options_(options),
        tree_(mechanism, options.with_clearance),
        kinematics_(tree_),
        inertia_(tree_, mechanism.mass_properties(parameters), parameters.gravity),
        loops_(mechanism, tree_, mechanism.mass_properties(parameters), options.with_clearance),
        laws_(mechanism.joints()),
        applied_(mechanism.bodies(), Vec6::Zero()),
        acceleration_(mechanism.bodies(), Vec6::Zero()),
        demanded_(loops_.block_vector()),
        motion_(VecX::Zero(tree_.speeds())),
        placed_at_(nowhere()),
        factored_at_(nowhere()) {
    if (options_.stabilisation == Stabilisation::baumgarte) baumgarte_ = {options_.alpha, options_.beta};
  }

  int state_size() const override { return kinematics_.state_size(); }
  bool is_speed(int k) const override { return k >= tree_.positions(); }
  bool is_length(int k) const override {
    for (const TreeJoint& joint : tree_.joints()) {
      const long slides = std::count(joint.slides.begin(), joint.slides.end(), true);
      const int position = k - joint.first_position, speed = k - tree_.positions() - joint.first_speed;
      if (position >= 0 && position < joint.positions) return position < slides;
      if (speed >= 0 && speed < joint.speeds) return speed < slides;
    }
    return false;
  }
  bool positions_follow_speeds() const override { return tree_.positions() == tree_.speeds(); }

  void start(const IdealState& ideal, VecX& y) override {
    kinematics_.read(ideal.bodies, y);
    placed_time_ = kNever;
    factored_at_ = nowhere();
    // The tree's own rows are independent of each other: what the whole mechanism's lack in rank its loops lack.
    loops_.set_redundant(loops_.blocks() > 0 && rows_are_redundant(mechanism_, drives_, clearance_rows(), ideal));
  }

  void place_bodies(const std::vector<BodyMotion>& bodies, VecX& y) override {
    kinematics_.read(bodies, y);
    placed_time_ = kNever;
  }

  void close_joints(double t, VecX& y) override {
    if (loops_.blocks() > 0) project(t, y);
  }

  const std::vector<BodyMotion>& bodies(double t, const VecX& y) override {
    place(t, y);
    return kinematics_.bodies();
  }

  void derivative(double t, const VecX& y, const std::vector<ContactMemory>& memory, VecX& dy) override {
    place(t, y);
    for (Vec6& wrench : applied_) wrench.setZero();
    forces_.apply(t, kinematics_.bodies(), memory, applied_);
    loops_.evaluate(kinematics_.bodies(), laws_);
    factor(t, y);

    for (int k = 0; k < loops_.blocks(); ++k) {
      const JointRows& rows = loops_.block(k).rows();
      demanded_[k] = baumgarte_.gamma_of(rows.gamma - loops_.block(k).bias(kinematics_), rows);
    }
    motion_ = inertia_.force();
    inertia_.cholesky().solve_transposed(motion_.data());
    loops_.constrain(demanded_, motion_);  // which leaves the multipliers in demanded_
    opening_power_ = 0.0;
    for (int k = 0; k < loops_.blocks(); ++k) opening_power_ -= demanded_[k].dot(loops_.block(k).rows().rate);
    inertia_.cholesky().solve(motion_.data());

    kinematics_.position_rates(y, dy);
    dy.tail(tree_.speeds()) = motion_;
    kinematics_.accelerations(motion_, acceleration_);
  }

  void stabilise(double t, VecX& y) override {
    kinematics_.normalise(y);
    if (!y.allFinite()) return;  // the motion has blown up, and the caller sees it
    if (options_.stabilisation == Stabilisation::projection && loops_.blocks() > 0) project(t, y);
  }

  const std::vector<BodyAcceleration>& acceleration() const override { return acceleration_; }
  double violation() const override { return loops_.violation(); }

  MatX offset_compliance() override;

  double energy(double t, const VecX& y) override {
    place(t, y);
    return forces_.elastic_energy(kinematics_.bodies()) + inertia_.energy(kinematics_.bodies());
  }

 private:
  VecX nowhere() const { return VecX::Constant(state_size(), kNever); }

  // Bodies at (t, y), unless they already are there: the rung asks for them several times a step.
  void place(double t, const VecX& y) {
    if (t == placed_time_ && y == placed_at_) return;
    if (drives_) drives_->drive_laws(t, laws_);
    kinematics_.evaluate(y, laws_);
    placed_time_ = t;
    placed_at_ = y;
  }

  // Needs place() and the loops' evaluate() at (t, y), and the applied wrenches if the force is to be used.
  void factor(double t, const VecX& y) {
    inertia_.evaluate(kinematics_, applied_);
    if (!loops_.factor(kinematics_, inertia_.cholesky())) {
      if (!y.allFinite())
        throw ComputationError("the motion grew without bound before t = " + std::to_string(t) + " s");
      throw_singular(t, kinematics_.bodies());
    }
    factored_at_ = y;
  }

  bool factored_near(const VecX& y) const {
    const double length = mechanism_.characteristic_length();
    for (const TreeJoint& joint : tree_.joints()) {
      const int slides = joint.slide_positions(), first = joint.first_position;
      for (int k = first; k < first + joint.positions; ++k) {
        const double apart = std::abs(y[k] - factored_at_[k]);
        if (!(apart < (k < first + slides ? kNearPose * length : kNearPose))) return false;
      }
    }
    return true;
  }

  void project(double t, VecX& y) {
    for (int step = 0; step < kNewtonSteps; ++step) {
      place(t, y);
      loops_.evaluate(kinematics_.bodies(), laws_);
      const double opening = loops_.violation(mechanism_.characteristic_length());
      if (opening > kNearPose || !factored_near(y)) factor(t, y);
      correct(false, y);
      correct(true, y);
      if (opening < kClosed) return;
    }
  }

  // The least motion, in the norm of H, that makes the rows' values (or rates) zero.
  void correct(bool speeds, VecX& y) {
    for (int k = 0; k < loops_.blocks(); ++k)
      demanded_[k] = speeds ? -loops_.block(k).rows().rate : -loops_.block(k).rows().value;
    motion_.setZero();
    loops_.constrain(demanded_, motion_);
    inertia_.cholesky().solve(motion_.data());
    if (speeds)
      y.tail(tree_.speeds()) += motion_;
    else
      kinematics_.displace(motion_, y);
  }

  ClearanceRows clearance_rows() const { return options_.with_clearance ? ClearanceRows::open : ClearanceRows::closed; }

  [[noreturn]] void throw_singular(double t, const std::vector<BodyMotion>& bodies) const {
    ConstraintSystem rows(mechanism_, {.clearance = clearance_rows()});
    rows.evaluate(bodies, laws_);
    throw SingularPose(mechanism_, rows, t);
  }

  const Mechanism& mechanism_;
  const IdealMotion* drives_;
  TreeFormulationOptions options_;
  BaumgarteStabilisation baumgarte_;
  SpanningTree tree_;
  TreeKinematics kinematics_;
  JointSpaceInertia inertia_;
  LoopClosure loops_;
  std::vector<TimeValue> laws_;
  std::vector<Vec6> applied_;
  std::vector<BodyAcceleration> acceleration_;
  std::vector<Vec6> demanded_;
  VecX motion_;
  double placed_time_ = kNever;
  VecX placed_at_, factored_at_;  // states that kinematics_ and the factors belong to
};

MatX TreeFormulation::offset_compliance() {
  // Released rows of the joints with clearance in joint coordinates: R. The answer is R (what L^-1 makes of it) R^T.
  const OffsetLayout layout(mechanism_);
  const int offsets = forces_.clearances() == 0 ? 0 : layout.size(), n = tree_.speeds();
  MatX R = MatX::Zero(offsets, n);
  std::vector<Vec6> columns(n);
  for (int c = 0; c < forces_.clearances(); ++c) {
    LoopRows released(mechanism_, tree_, mechanism_.description().clearances[c].joint, ClearanceRows::released, false);
    released.evaluate(kinematics_.bodies(), laws_);
    for (Vec6& column : columns) column.setZero();
    released.jacobian(kinematics_, columns);
    const OffsetLayout::Joint& joint = layout.joint(c);
    for (int i = 0; i < joint.count(); ++i)
      if (joint.released(i))
        for (int k = 0; k < n; ++k) R(joint.first + i, k) = columns[k][joint.released_row(i)];
  }
  MatX compliance(offsets, offsets);
  for (int i = 0; i < offsets; ++i) {
    motion_ = R.row(i).transpose();
    inertia_.cholesky().solve_transposed(motion_.data());
    for (Vec6& d : demanded_) d.setZero();
    loops_.constrain(demanded_, motion_);
    inertia_.cholesky().solve(motion_.data());
    compliance.col(i) = R * motion_;
  }
  return compliance;
}

}  // namespace

std::unique_ptr<Formulation> make_tree_formulation(const Mechanism& mechanism, const Parameters& parameters,
                                                   const IdealMotion* drives, const TreeFormulationOptions& options) {
  return std::make_unique<TreeFormulation>(mechanism, parameters, drives, options);
}

}  // namespace boresight
