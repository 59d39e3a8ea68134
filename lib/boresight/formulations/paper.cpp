// The paper's equations of motion: absolute coordinates, Lagrange multipliers, Baumgarte's stabilisation (Sun et al.,
// section 3.3), with their block structure used.
//
//   [M  Phi^T] [vdot  ]   [Q     ]
//   [Phi  0  ] [lambda] = [gamma'],   gamma' = gamma - 2 alpha Phidot - beta^2 Phi                       (Eq. 41, 43)
//
// is solved as  (Phi M^-1 Phi^T) lambda = Phi M^-1 Q - gamma',  vdot = M^-1 (Q - Phi^T lambda).
// M is block-diagonal and Phi M^-1 Phi^T has one block per joint and per pair of joints that share a body (three of 78
// rows' blocks a leg), which ConstraintSystem factors without fill beyond the platform.
//
// State, 13 numbers a body: p_WB (3), quaternion R_WB (w x y z), v_WB (3), w_WB (3).
// The alternative to Baumgarte is projection: after each step positions and velocities return to the constraints along the
// shortest way in the norm of the masses (Eich 1993, SIAM J. Numer. Anal. 30), with alpha = beta = 0.

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "boresight/formulations/baumgarte_stabilisation.hpp"
#include "boresight/formulations/body_energy.hpp"
#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/singular_pose.hpp"
#include "boresight/math/cross_matrix.hpp"
#include "boresight/mechanism/constraint_system.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/offset_layout.hpp"

namespace boresight {
namespace {

constexpr int kPerBody = 13;

class PaperFormulation final : public Formulation {
 public:
  PaperFormulation(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion* drives,
                   const PaperFormulationOptions& options)
      : Formulation(mechanism, parameters, options.with_clearance),
        mechanism_(mechanism),
        drives_(drives),
        options_(options),
        mass_(mechanism.mass_properties(parameters)),
        gravity_(parameters.gravity),
        constraints_(mechanism, {.clearance = clearance_rows()}),
        laws_(mechanism.joints()),
        bodies_(mechanism.bodies()),
        inverse_mass_(mechanism.bodies(), Mat6::Zero()),
        force_(constraints_.body_vector()),
        reaction_(constraints_.body_vector()),
        acceleration_(constraints_.body_vector()),
        lambda_(constraints_.block_vector()) {
    for (const MassProperties& m : mass_) inverse_inertia_.push_back(m.inertia.inverse());
    if (options_.stabilisation == Stabilisation::baumgarte) baumgarte_ = {options_.alpha, options_.beta};
  }

  int state_size() const override { return kPerBody * mechanism_.bodies(); }
  bool is_speed(int k) const override { return k % kPerBody >= 7; }
  bool is_length(int k) const override { return k % kPerBody < 3 || (k % kPerBody >= 7 && k % kPerBody < 10); }
  bool positions_follow_speeds() const override { return false; }

  void start(const IdealState& ideal, VecX& y) override {
    place_bodies(ideal.bodies, y);
    unpack(y);
    constraints_.set_redundant(rows_are_redundant(mechanism_, drives_, clearance_rows(), ideal));
  }

  void place_bodies(const std::vector<BodyMotion>& bodies, VecX& y) override {
    y.resize(state_size());
    for (int b = 0; b < mechanism_.bodies(); ++b) {
      const BodyMotion& body = bodies[b];
      const Quat q(body.R);
      y.segment<kPerBody>(kPerBody * b) << body.p, q.w(), q.x(), q.y(), q.z(), body.v, body.w;
    }
  }

  void close_joints(double t, VecX& y) override { project(t, y, kMostPasses); }

  const std::vector<BodyMotion>& bodies(double, const VecX& y) override {
    unpack(y);
    return bodies_;
  }

  void derivative(double t, const VecX& y, const std::vector<ContactMemory>& memory, VecX& dy) override {
    unpack(y);
    evaluate_forces(t, memory);
    update_laws(t);
    constraints_.evaluate(bodies_, laws_);
    factor(t, y);

    for (int b = 0; b < mechanism_.bodies(); ++b) acceleration_[b].noalias() = inverse_mass_[b] * force_[b];
    constraints_.multiply(acceleration_, lambda_);
    for (int k = 0; k < constraints_.blocks(); ++k) {
      const JointRows& rows = constraints_.rows(k);
      lambda_[k] -= baumgarte_.gamma_of(rows.gamma, rows);
    }
    constraints_.solve(lambda_);
    opening_power_ = 0.0;
    for (int k = 0; k < constraints_.blocks(); ++k) opening_power_ -= lambda_[k].dot(constraints_.rows(k).rate);
    constraints_.multiply_transposed(lambda_, reaction_);
    for (int b = 0; b < mechanism_.bodies(); ++b) acceleration_[b].noalias() -= inverse_mass_[b] * reaction_[b];

    for (int b = 0; b < mechanism_.bodies(); ++b) {
      const BodyMotion& body = bodies_[b];
      const auto q = y.segment<4>(kPerBody * b + 3);
      auto rate = dy.segment<kPerBody>(kPerBody * b);
      rate.head<3>() = body.v;
      // qdot = (0, w) q / 2, w in world axes.
      rate[3] = -0.5 * body.w.dot(q.tail<3>());
      rate.segment<3>(4) = 0.5 * (q[0] * body.w + body.w.cross(q.tail<3>()));
      rate.tail<6>() = acceleration_[b];
    }
  }

  void stabilise(double t, VecX& y) override {
    for (int b = 0; b < mechanism_.bodies(); ++b) y.segment<4>(kPerBody * b + 3).normalize();
    if (options_.stabilisation == Stabilisation::projection) project(t, y);
  }

  const std::vector<BodyAcceleration>& acceleration() const override { return acceleration_; }
  double violation() const override { return constraints_.violation(); }

  MatX offset_compliance() override {
    const OffsetLayout layout(mechanism_);
    const int n = forces_.clearances() == 0 ? 0 : layout.size();
    if (!released_)
      released_ = std::make_unique<ConstraintSystem>(
          mechanism_, ConstraintSystem::Rows{.clearance = ClearanceRows::released, .drives = false});
    released_->evaluate(bodies_, laws_);
    MatX A = MatX::Zero(n, n);
    if (n == 0) return A;
    std::vector<Vec6> unit = released_->block_vector(), answer = released_->block_vector();
    std::vector<Vec6> motion = released_->body_vector(), reaction = released_->body_vector();
    std::vector<Vec6> lambda = constraints_.block_vector();
    std::vector<int> block(layout.clearances(), 0);
    for (int k = 0; k < released_->blocks(); ++k)
      if (const int c = mechanism_.clearance_of(released_->joints()[k].joint()); c >= 0) block[c] = k;
    const auto each_offset = [&](const auto& visit) {
      for (int c = 0; c < layout.clearances(); ++c) {
        const OffsetLayout::Joint& joint = layout.joint(c);
        for (int k = 0; k < joint.count(); ++k)
          if (joint.released(k)) visit(joint.first + k, block[c], joint.released_row(k));
      }
    };
    each_offset([&](int column, int at, int row) {
      for (Vec6& u : unit) u.setZero();
      unit[at][row] = 1.0;
      released_->multiply_transposed(unit, motion);
      for (int b = 0; b < mechanism_.bodies(); ++b) motion[b] = Vec6(inverse_mass_[b] * motion[b]);
      constraints_.multiply(motion, lambda);
      constraints_.solve(lambda);
      constraints_.multiply_transposed(lambda, reaction);
      for (int b = 0; b < mechanism_.bodies(); ++b) motion[b] -= inverse_mass_[b] * reaction[b];
      released_->multiply(motion, answer);
      each_offset([&](int i, int other, int other_row) { A(i, column) = answer[other][other_row]; });
    });
    return A;
  }

  double energy(double, const VecX& y) override {
    unpack(y);
    double sum = forces_.elastic_energy(bodies_);
    for (int b = 0; b < mechanism_.bodies(); ++b)
      sum += kinetic_energy(mass_[b], bodies_[b]) + potential_energy(mass_[b], bodies_[b], gravity_);
    return sum;
  }

 private:
  void unpack(const VecX& y) {
    for (int b = 0; b < mechanism_.bodies(); ++b) {
      const auto s = y.segment<kPerBody>(kPerBody * b);
      BodyMotion& body = bodies_[b];
      body.p = s.head<3>();
      body.R = Quat(s[3], s[4], s[5], s[6]).normalized().toRotationMatrix();
      body.v = s.segment<3>(7);
      body.w = s.tail<3>();
    }
  }

  ClearanceRows clearance_rows() const { return options_.with_clearance ? ClearanceRows::open : ClearanceRows::closed; }

  void factor(double t, const VecX& y) {
    if (constraints_.factor(inverse_mass_)) return;
    if (!y.allFinite()) throw ComputationError("the motion grew without bound before t = " + std::to_string(t) + " s");
    throw_singular(t);
  }

  void update_laws(double t) {
    if (drives_) drives_->drive_laws(t, laws_);
  }

  // M^-1 and Q of every body: gravity, the gyroscopic and centripetal terms, force elements. With c from the body's own
  // centre of mass (the reference point) to the combined one, I_c about the latter:
  //   m (vdot + wdot x c + w x (w x c)) = F,   I_c wdot + w x I_c w = moment about the combined centre.
  void evaluate_forces(double t, const std::vector<ContactMemory>& memory) {
    evaluate_inverse_mass();
    for (int b = 0; b < mechanism_.bodies(); ++b) {
      const BodyMotion& body = bodies_[b];
      const MassProperties& m = mass_[b];
      const Vec3 w_B = body.R.transpose() * body.w;
      force_[b].head<3>() = m.mass * gravity_;
      force_[b].tail<3>() = -(body.R * w_B.cross(m.inertia * w_B));
      if (m.c.squaredNorm() == 0.0) continue;
      const Vec3 c = body.R * m.c;
      const Vec3 centripetal = m.mass * body.w.cross(body.w.cross(c));
      force_[b].head<3>() -= centripetal;
      force_[b].tail<3>() += c.cross(Vec3(m.mass * gravity_ - centripetal));
    }
    forces_.apply(t, bodies_, memory, force_);
  }

  // Positions (two Newton steps: the second one only where the first was large), then velocities.
  // After a step two corrections do; bodies that were sent somewhere are farther off.
  static constexpr int kPasses = 3, kMostPasses = 20;
  void project(double t, VecX& y, int passes = kPasses) {
    update_laws(t);
    double before = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < passes; ++pass) {
      unpack(y);
      evaluate_inverse_mass();
      constraints_.evaluate(bodies_, laws_);
      factor(t, y);
      const double open = constraints_.violation(mechanism_.characteristic_length());
      if (pass == passes - 1 || open < 1e-14 || (pass >= kPasses && !(open < 0.5 * before))) break;
      before = open;
      for (int k = 0; k < constraints_.blocks(); ++k) lambda_[k] = -constraints_.rows(k).value;
      constraints_.least_motion(lambda_, reaction_);
      for (int b = 0; b < mechanism_.bodies(); ++b) {
        displace(bodies_[b], reaction_[b]);
        Quat q(bodies_[b].R);
        auto s = y.segment<kPerBody>(kPerBody * b);
        if (q.coeffs().dot(Eigen::Vector4d(s[4], s[5], s[6], s[3])) < 0.0) q.coeffs() *= -1.0;
        s.head<3>() = bodies_[b].p;
        s.segment<4>(3) << q.w(), q.x(), q.y(), q.z();
      }
    }
    for (int k = 0; k < constraints_.blocks(); ++k) lambda_[k] = -constraints_.rows(k).rate;
    constraints_.least_motion(lambda_, reaction_);
    for (int b = 0; b < mechanism_.bodies(); ++b) y.segment<6>(kPerBody * b + 7) += reaction_[b];
  }

  // v = v_c + c x w, so M^-1 = T diag(1/m, I_c^-1) T^T with T = [1 [c]; 0 1].
  void evaluate_inverse_mass() {
    for (int b = 0; b < mechanism_.bodies(); ++b) {
      const Mat3 inverse = bodies_[b].R * inverse_inertia_[b] * bodies_[b].R.transpose();
      Mat6& W = inverse_mass_[b];
      W.topLeftCorner<3, 3>() = Mat3::Identity() / mass_[b].mass;
      W.bottomRightCorner<3, 3>() = inverse;
      if (mass_[b].c.squaredNorm() == 0.0) continue;
      const Vec3 c = bodies_[b].R * mass_[b].c;
      const Mat3 cross = cross_matrix(c);
      W.topRightCorner<3, 3>() = cross * inverse;
      W.bottomLeftCorner<3, 3>() = W.topRightCorner<3, 3>().transpose();
      W.topLeftCorner<3, 3>() += cross * inverse * cross.transpose();
    }
  }

  [[noreturn]] void throw_singular(double t) const { throw SingularPose(mechanism_, constraints_, t); }

  const Mechanism& mechanism_;
  const IdealMotion* drives_;
  PaperFormulationOptions options_;
  BaumgarteStabilisation baumgarte_;
  std::vector<MassProperties> mass_;
  std::vector<Mat3> inverse_inertia_;
  Vec3 gravity_;
  ConstraintSystem constraints_;
  std::unique_ptr<ConstraintSystem> released_;
  std::vector<TimeValue> laws_;
  std::vector<BodyMotion> bodies_;
  std::vector<Mat6> inverse_mass_;
  std::vector<Vec6> force_, reaction_;
  std::vector<BodyAcceleration> acceleration_;
  std::vector<Vec6> lambda_;
};

}  // namespace

std::unique_ptr<Formulation> make_paper_formulation(const Mechanism& mechanism, const Parameters& parameters,
                                                    const IdealMotion* drives, const PaperFormulationOptions& options) {
  return std::make_unique<PaperFormulation>(mechanism, parameters, drives, options);
}

}  // namespace boresight
