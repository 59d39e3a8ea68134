#include "boresight/rungs/clearance_scene.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/force_elements.hpp"

namespace boresight {
namespace {

// Spacing of the knots: the cubics' error, (w h)^4 / 384 for motions of w = 30 rad/s, stays below 1e-7.
constexpr double kSpacing = 2e-3;
// Half the step of the difference that gives Tdot: truncation (w h)^2 / 6 and rounding 1e-13 / h meet near 1e-9.
constexpr double kRateStep = 1e-5;

const BodyMotion kGroundMotion;

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

bool is_revolute(const Mechanism& mechanism, int clearance) {
  return mechanism.description().joints[mechanism.description().clearances[clearance].joint].type == JointType::revolute;
}

}  // namespace

// T at one time: unit offset rate in each released row, every other row held.
void ClearanceScene::solve_gain(double t, const IdealMotion& ideal, ConstraintSystem& system,
                                const std::vector<Mat6>& weight, MatX& T) const {
  IdealState state;
  ideal.state(t, state);
  std::vector<TimeValue> laws(mechanism_.joints());
  ideal.drive_laws(t, laws);
  system.evaluate(state.bodies, laws);
  if (!system.factor(weight))
    throw ComputationError("the perturbation of the ideal motion does not exist at t = " + std::to_string(t) +
                           " s: the pose is singular or some joints hold each other; use the multibody rung");
  std::vector<Vec6> b = system.block_vector(), u = system.body_vector(), residual = system.block_vector(), du = u;
  T.setZero(6 * mechanism_.bodies(), n_);
  for (int k = 0; k < system.blocks(); ++k) {
    const int clearance = mechanism_.clearance_of(system.joints()[k].joint());
    if (clearance < 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == 1 && !is_revolute(mechanism_, clearance)) continue;
      const int row = is_revolute(mechanism_, clearance) ? axis : axis / 2;  // distance rows come first: x (y) z
      for (Vec6& x : b) x.setZero();
      b[k][row] = 1.0;
      system.least_motion(b, u);
      // One refinement: J W J^T squares the condition number.
      system.multiply(u, residual);
      for (Vec6& x : residual) x = -x;
      residual[k][row] += 1.0;
      system.least_motion(residual, du);
      for (int body = 0; body < mechanism_.bodies(); ++body)
        T.block<6, 1>(6 * body, 3 * clearance + axis) = u[body] + du[body];
    }
  }
}

ClearanceScene::ClearanceScene(const Mechanism& mechanism, const IdealMotion& ideal)
    : mechanism_(mechanism), n_(3 * mechanism.clearances()) {
  const int cells = std::max(8, static_cast<int>(std::ceil(mechanism.duration() / kSpacing)));
  spacing_ = mechanism.duration() / cells;
  ConstraintSystem system(mechanism, {.clearance = ClearanceRows::closed, .drives = true});
  if (system.row_count() != 6 * mechanism.bodies())
    throw ComputationError("the perturbation rung needs as many joint rows and drives as freedoms; this mechanism has " +
                           std::to_string(system.row_count()) + " rows for " + std::to_string(6 * mechanism.bodies()) +
                           "; use the multibody rung");
  const std::vector<Mat6> weight = kinematic_weight(mechanism);
  const MechanismDescription& m = mechanism.description();
  MatX before, after;
  for (int k = 0; k <= cells; ++k) {
    const double t = k * spacing_;
    state_.emplace_back();
    ideal.state(t, state_.back());
    T_.emplace_back();
    solve_gain(t, ideal, system, weight, T_.back());
    // At the ends the difference is taken inside the motion: shifted by its own half step.
    const double middle = std::clamp(t, kRateStep, mechanism.duration() - kRateStep);
    solve_gain(middle - kRateStep, ideal, system, weight, before);
    solve_gain(middle + kRateStep, ideal, system, weight, after);
    T_rate_.push_back((after - before) / (2.0 * kRateStep));
    const MatX& T = T_.back();
    pose_gain_.push_back(T.middleRows<6>(6 * mechanism.boresight_body()));

    std::vector<double>& row = joint_.emplace_back();
    for (int c = 0; c < mechanism.clearances(); ++c) {
      const ClearanceDescription& d = m.clearances[c];
      const JointGeometry& g = mechanism.geometry(d.joint);
      const bool journal_first = d.journal == m.joints[d.joint].first;
      const JointFrame &sleeve = journal_first ? g.second : g.first, &journal = journal_first ? g.first : g.second;
      const auto motion = [&](int body) -> const BodyMotion& {
        return body == kGround ? kGroundMotion : state_.back().bodies[body];
      };
      const auto gain = [&](int body) -> MatX { return body == kGround ? MatX(MatX::Zero(6, n_)) : MatX(T.middleRows<6>(6 * body)); };
      const BodyMotion &S = motion(sleeve.body), &J = motion(journal.body);
      const MatX TS = gain(sleeve.body), TJ = gain(journal.body);
      const Mat3 R_WS = S.R * sleeve.R;
      const Vec3 rS = S.R * sleeve.p, rJ = J.R * journal.p, distance = J.p + rJ - S.p - rS;
      const Vec3 spin = R_WS.transpose() * (J.w - S.w);
      const MatX spin_gain = R_WS.transpose() * (TJ.bottomRows<3>() - TS.bottomRows<3>());
      // Rate of the journal's centre along the sleeve's axis; it slides only on a cylindrical joint.
      double slide = 0.0;
      Eigen::RowVectorXd slide_gain = Eigen::RowVectorXd::Zero(n_);
      if (!is_revolute(mechanism, c)) {
        const Vec3 y = R_WS.col(1);
        slide = y.dot(J.v + J.w.cross(rJ) - S.v - S.w.cross(rS + distance));
        slide_gain = y.transpose() * (TJ.topRows<3>() - cross_matrix(rJ) * TJ.bottomRows<3>() - TS.topRows<3>() +
                                      cross_matrix(rS + distance) * TS.bottomRows<3>());
      }
      row.insert(row.end(), {spin.x(), spin.y(), spin.z(), slide});
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < n_; ++j) row.push_back(spin_gain(i, j));
      for (int j = 0; j < n_; ++j) row.push_back(slide_gain[j]);
    }
  }

  for (int b = 0; b < mechanism.bodies(); ++b) {
    Element mass{.body = b, .mass = 1.0};
    Element inertia{.body = b, .inertia = m.bodies[b].inertia};
    fill(mass);
    fill(inertia);
    body_mass_.push_back(std::move(mass));
    body_inertia_.push_back(std::move(inertia));
  }
  if (m.payload) {
    const BodyDescription& carrier = m.bodies[m.payload->body];
    Element payload{.body = m.payload->body,
                    .c = carrier.axes.transpose() * (m.payload->center_of_mass - carrier.center_of_mass),
                    .mass = 1.0,
                    .inertia = m.payload->gyration.array().square().matrix().asDiagonal()};
    fill(payload);
    payload_ = std::move(payload);
  }
}

void ClearanceScene::fill(Element& e) const {
  for (std::size_t k = 0; k < state_.size(); ++k) {
    const BodyMotion& body = state_[k].bodies[e.body];
    const BodyAcceleration& a = state_[k].acceleration[e.body];
    const Vec3 c = body.R * e.c, c_rate = body.w.cross(c), w = body.w, alpha = a.tail<3>();
    const auto T_v = T_[k].middleRows<3>(6 * e.body), T_w = T_[k].middleRows<3>(6 * e.body + 3);
    const auto Td_v = T_rate_[k].middleRows<3>(6 * e.body), Td_w = T_rate_[k].middleRows<3>(6 * e.body + 3);
    const Mat3 I = body.R * e.inertia * body.R.transpose();
    const MatX T_c = T_v - cross_matrix(c) * T_w;  // of the mass' own centre
    const MatX Td_c = Td_v - cross_matrix(c_rate) * T_w - cross_matrix(c) * Td_w;
    const Vec3 a_c = a.head<3>() + alpha.cross(c) + w.cross(c_rate);
    const MatX turning = 2.0 * I * Td_w - I * cross_matrix(w) * T_w - cross_matrix(I * w) * T_w + cross_matrix(w) * I * T_w;
    e.M.push_back(e.mass * T_c.transpose() * T_c + T_w.transpose() * I * T_w);
    e.C.push_back(2.0 * e.mass * T_c.transpose() * Td_c + T_w.transpose() * turning);
    e.r.push_back(-e.mass * T_c.transpose() * a_c - T_w.transpose() * (I * alpha + w.cross(I * w)));
    e.r_gravity.push_back(e.mass * T_c.transpose());
  }
}

void ClearanceScene::add(const Element& e, double units, const Vec3& gravity, int k, MatX& M, MatX& C, VecX& r) const {
  M += units * e.M[k];
  C += units * e.C[k];
  r += units * (e.r[k] + e.r_gravity[k] * gravity);
}

void ClearanceScene::assemble(const Parameters& parameters, int k, MatX& M, MatX& C, VecX& r) const {
  M.setZero(n_, n_);
  C.setZero(n_, n_);
  r.setZero(n_);
  for (int b = 0; b < mechanism_.bodies(); ++b) {
    add(body_mass_[b], parameters.body_mass[b], parameters.gravity, k, M, C, r);
    add(body_inertia_[b], 1.0, parameters.gravity, k, M, C, r);
  }
  if (payload_) add(*payload_, parameters.payload_mass, parameters.gravity, k, M, C, r);
  if (!mechanism_.description().springs.empty() || !mechanism_.description().loads.empty()) {
    ForceElements forces(mechanism_, parameters, false);
    std::vector<Vec6> wrench(mechanism_.bodies(), Vec6::Zero());
    forces.apply(state_[k].t, state_[k].bodies, {}, wrench);
    for (int b = 0; b < mechanism_.bodies(); ++b) r += T_[k].middleRows<6>(6 * b).transpose() * wrench[b];
  }
  // The axial offset of a cylindrical joint is no offset at all: unit mass, no force, so that it stays at zero.
  for (int c = 0; c < mechanism_.clearances(); ++c)
    if (!is_revolute(mechanism_, c)) M(3 * c + 1, 3 * c + 1) = 1.0;
}

SceneTables ClearanceScene::tables(const Parameters& parameters) const {
  SceneTables tables;
  tables.clearances = mechanism_.clearances();
  std::vector<double> dynamics, pose;
  MatX M, C;
  VecX r;
  const auto append = [](std::vector<double>& to, const auto& matrix) {
    for (int i = 0; i < matrix.rows(); ++i)
      for (int j = 0; j < matrix.cols(); ++j) to.push_back(matrix(i, j));
  };
  for (int k = 0; k < knots(); ++k) {
    assemble(parameters, k, M, C, r);
    const Eigen::LLT<MatX> cholesky(M);
    if (cholesky.info() != Eigen::Success)
      throw ComputationError("the reduced mass is not positive at t = " + std::to_string(state_[k].t) + " s");
    append(dynamics, MatX(cholesky.solve(MatX::Identity(n_, n_))));
    append(dynamics, VecX(cholesky.solve(r)));
    append(dynamics, MatX(cholesky.solve(C)));
    dynamics.insert(dynamics.end(), joint_[k].begin(), joint_[k].end());
    append(pose, pose_gain_[k]);
  }
  tables.dynamics = TimeTable(spacing_, static_cast<int>(dynamics.size()) / knots(), dynamics);
  tables.pose = TimeTable(spacing_, 6 * n_, pose);
  return tables;
}

}  // namespace boresight
