// The reduced mass of a clearance scene at one instant, and what else its equations are made of: with T what the bodies do
// when the coordinates z of the deviation change (deviation_coordinates.hpp) and I the bodies' masses and inertias,
//
//   M = T^T I T,    C = T^T (2 I Tdot + gyroscopic T),    K of springs, gravity and the motion,    r = T^T (forces)
//
// and the rows of its tables, in which A = M^-1 has been multiplied through.
#include <Eigen/Cholesky>

#include "boresight/math/cross_matrix.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/scene/clearance_scene.hpp"
#include "boresight/scene/table_row.hpp"

namespace boresight {

void ClearanceScene::add_element(const RidingMass& e, const Knot& knot, double* out) const {
  const int n = layout_.n;
  const MatX &T = knot.T, &T_rate = knot.T_rate;
  const BodyMotion& body = knot.state.bodies[e.body];
  const Vec3 c = body.R * e.c, c_rate = body.w.cross(c), w = body.w;
  const auto T_w = T.middleRows<3>(6 * e.body + 3);
  const auto Td_v = T_rate.middleRows<3>(6 * e.body), Td_w = T_rate.middleRows<3>(6 * e.body + 3);
  const Mat3 I = body.R * e.inertia * body.R.transpose();
  using Gain = Eigen::Matrix<double, 3, Eigen::Dynamic>;
  const Gain T_c = gain_of_centre(e, body, T);
  const Gain Td_c = Td_v - cross_matrix(c_rate) * T_w - cross_matrix(c) * Td_w;
  const Mat3 gyroscopic = -I * cross_matrix(w) - cross_matrix(I * w) + cross_matrix(w) * I;
  const Gain turning = 2.0 * I * Td_w + gyroscopic * T_w;
  Eigen::Map<MatX>(out, n, n) += e.mass * T_c.transpose() * T_c + T_w.transpose() * I * T_w;
  Eigen::Map<MatX>(out + n * n, n, n) += 2.0 * e.mass * T_c.transpose() * Td_c + T_w.transpose() * turning;
  add_load(e, knot.state, T, out + 2 * n * n, out + 2 * n * n + n);
  if (!moving()) return;
  const auto Tdd_v = knot.T_second.middleRows<3>(6 * e.body), Tdd_w = knot.T_second.middleRows<3>(6 * e.body + 3);
  const Vec3 c_second = knot.state.acceleration[e.body].tail<3>().cross(c) + w.cross(c_rate);
  const Gain Tdd_c = Tdd_v - cross_matrix(c_second) * T_w - 2.0 * cross_matrix(c_rate) * Td_w - cross_matrix(c) * Tdd_w;
  Eigen::Map<MatX>(out + 2 * n * n + 4 * n, n, n) +=
      e.mass * T_c.transpose() * Tdd_c + T_w.transpose() * (I * Tdd_w + gyroscopic * Td_w);
}

MatX ClearanceScene::moving_stiffness(const Parameters& parameters, const Knot& knot) const {
  const int n = layout_.n;
  MatX K = MatX::Zero(n, n);
  if (n == 0) return K;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    K += units_of(g, mechanism_, parameters) *
         Eigen::Map<const MatX>(&knot.elements[g * element_size()] + 2 * n * n + 4 * n, n, n);
  return K;
}

void ClearanceScene::assemble(const Parameters& parameters, const Knot& knot, MatX& M, MatX& C, VecX& r) const {
  const int n = layout_.n;
  M.setZero(n, n);
  C.setZero(n, n);
  r.setZero(n);
  if (n == 0) return;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const double units = units_of(g, mechanism_, parameters);
    if (units == 0.0) continue;
    const double* e = &knot.elements[g * element_size()];
    M += units * Eigen::Map<const MatX>(e, n, n);
    C += units * Eigen::Map<const MatX>(e + n * n, n, n);
    r += units * (Eigen::Map<const VecX>(e + 2 * n * n, n) +
                  Eigen::Map<const MatX>(e + 2 * n * n + n, n, 3) * parameters.gravity);
  }
  for (std::size_t s = 0; s < knot.springs.size(); ++s) C += knot.springs[s].damping(parameters.spring[s]);
  add_load_of_forces(mechanism_, parameters, knot.state, knot.T, r);
}

void ClearanceScene::assemble(const Parameters& parameters, int knot, MatX& M, MatX& C, VecX& r) const {
  assemble(parameters, knots_[knot], M, C, r);
}

MatX ClearanceScene::spring_stiffness(const Parameters& parameters, const Knot& knot) const {
  MatX K = MatX::Zero(layout_.n, layout_.n);
  for (std::size_t s = 0; s < knot.springs.size(); ++s) K += knot.springs[s].stiffness(parameters.spring[s]);
  return K;
}

MatX ClearanceScene::changing_stiffness(const Parameters& parameters, const Knot& knot) const {
  MatX K = moving() ? moving_stiffness(parameters, knot) : MatX::Zero(layout_.n, layout_.n);
  for (std::size_t s = 0; s < knot.springs.size(); ++s) K += knot.springs[s].turning_damping(parameters.spring[s]);
  return K;
}

MatX ClearanceScene::stiffness_at_rest(const Parameters& parameters, const Knot& knot) const {
  if (stiff_by_differences()) {
    MatX M, C;
    VecX r;
    assemble(parameters, knot, M, C, r);
    return M * knot.stiffness - changing_stiffness(parameters, knot);
  }
  MatX K = MatX::Zero(layout_.n, layout_.n);
  for (std::size_t s = 0; s < knot.springs.size(); ++s) K += knot.springs[s].stiffness_at_rest(parameters.spring[s]);
  return K;
}

MatX ClearanceScene::stiffness_at_rest(const Parameters& parameters, int knot) const {
  return stiffness_at_rest(parameters, knots_[knot]);
}

void ClearanceScene::append_row(const Parameters& parameters, const Knot& knot, std::vector<double>& row, bool at_rest,
                                SceneForm form) const {
  const int n = layout_.n;
  MatX M, C;
  VecX r;
  assemble(parameters, knot, M, C, r);
  const Eigen::LLT<MatX> cholesky(M);
  if (cholesky.info() != Eigen::Success)
    throw ComputationError("the reduced mass is not positive at t = " + std::to_string(knot.state.t) + " s");
  const bool forces = form == SceneForm::forces;
  const MatX mass = forces ? M : MatX(cholesky.solve(MatX::Identity(n, n)));
  const auto divided = [&](const MatX& gain) { return forces ? gain : MatX(cholesky.solve(gain)); };
  for (int i = 0; i < n; ++i)
    for (int j = i; j < n; ++j) row.push_back(mass(i, j));
  append(row, forces ? r : VecX(cholesky.solve(r)));
  append(row, divided(C));
  if (stiff_by_differences()) {
    // Differences know what T'' takes, and what turns a damper.
    const MatX AK =
        at_rest ? MatX(knot.stiffness - cholesky.solve(changing_stiffness(parameters, knot))) : knot.stiffness;
    append(row, forces ? MatX(M * AK) : AK);
  } else if (layout_.stiff) {
    MatX K = at_rest ? stiffness_at_rest(parameters, knot) : spring_stiffness(parameters, knot);
    if (moving() && !at_rest) K += moving_stiffness(parameters, knot);
    append(row, divided(K));
  }
  row.insert(row.end(), knot.joints.begin(), knot.joints.end());
}

void SceneTables::at(double t, double* row) const {
  dynamics.at(t, row);
  if (reaction.width() > 0) {
    VecX r(layout.n);
    reaction.at(t, r.data());
    for (int i = 0; i < layout.n; ++i) {
      double& sum = row[layout.Ar + i] = 0.0;
      for (int j = 0; j < layout.n; ++j) sum += row[layout.inverse_mass(i, j)] * r[j];
    }
  }
  if (load_change.width() > 0) load_change.add(t, row + layout.Ar);
  for (std::size_t c = 0; c < shifts.size(); ++c)
    if (shifts[c].width() > 0) shifts[c].add(t, row + layout.joints[c].shift);
}

TimeTable ClearanceScene::reactions(const Parameters& parameters) const {
  std::vector<double> values;
  MatX M, C;
  VecX r;
  for (const Knot& knot : knots_) {
    assemble(parameters, knot, M, C, r);
    values.insert(values.end(), r.data(), r.data() + layout_.n);
  }
  return TimeTable(spacing_, layout_.n, values);
}

namespace {

// On many knots a table takes as long as the scene itself.
void tabling(std::size_t knot, std::size_t knots) {
  work_reached("tabling the opened mechanism's dynamics", static_cast<double>(knot) / static_cast<double>(knots));
}

}  // namespace

SceneTables ClearanceScene::tables(const Parameters& parameters, SceneForm form) const {
  std::vector<double> rows;
  rows.reserve(knots_.size() * layout_.width);
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    tabling(k, knots_.size());
    append_row(parameters, knots_[k], rows, false, form);
  }
  SceneTables made{.layout = layout_,
                   .dynamics = TimeTable(spacing_, layout_.width, rows),
                   .start = start_of(parameters, knots_.front())};
  if (form == SceneForm::accelerations && coordinates_.leftover() > 0) made.reaction = reactions(parameters);
  return made;
}

TimeTable ClearanceScene::pose_gain(int body) const {
  std::vector<double> values;
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    tabling(k, knots_.size());
    append(values, MatX(knots_[k].T.middleRows<6>(6 * body)));
  }
  return TimeTable(spacing_, 6 * layout_.n, values);
}

TimeTable ClearanceScene::pose_gain_rate(int body) const {
  std::vector<double> values;
  for (std::size_t k = 0; k < knots_.size(); ++k) {
    tabling(k, knots_.size());
    append(values, MatX(knots_[k].T_rate.middleRows<6>(6 * body)));
  }
  return TimeTable(spacing_, 6 * layout_.n, values);
}

}  // namespace boresight
