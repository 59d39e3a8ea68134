// One step of a Rosenbrock method for M zddot = g(t, z, zdot), one sample a lane.
//
// As lane_rosenbrock.hpp, multiplied by M, which is held still over a step (lane_window.hpp): with g_z and g_v the
// derivatives of g,
//   (sigma M - g_v - g_z / sigma) u_v = M r_v + g_z r_z / sigma,     u_z = (r_z + u_v) / sigma.
// So no mass is inverted, and the derivatives of the contacts, which see few coordinates each, are multiplied by nothing dense.
// Hairer and Wanner (1996), section IV.7, "implicit differential equations".
#pragma once

#include <algorithm>

#include "boresight/lanes/lane_block_solver.hpp"
#include "boresight/lanes/lane_forces.hpp"
#include "boresight/lanes/lane_table.hpp"

namespace boresight {

template <typename T>
class LaneMassRosenbrock {
 public:
  LaneMassRosenbrock(const RosenbrockTable& table, const SceneLayout& layout)
      : table_(table), n_(layout.n), solver_(layout.n) {
    for (const SceneLayout::Joint& joint : layout.joints) ties_move_ = ties_move_ || joint.has_dependent;
    const auto n = static_cast<std::size_t>(n_);
    for (auto* numbers : {&g_, &g_t_, &stage_z_, &stage_v_, &r_z_, &by_v_, &scaled_, &sigma_})
      numbers->assign(n, T(0.0));
    for (int i = 0; i < table.stages; ++i) {
      u_z_[i].assign(n, T(0.0));
      u_v_[i].assign(n, T(0.0));
    }
  }

  // From (z, v) over h; since: seconds from the start of each lane's window. new_z, new_v and the error of each (z, then v)
  // come out.
  void step(LaneForces<T>& forces, LaneWindow<T>& window, const T& since, const T& h, const T* z, const T* v, T* new_z,
            T* new_v, T* error) {
    const int n = n_;
    const RosenbrockTable& of = table_.of;
    const T per_h = T(1.0) / h, inverse = h * T(of.gamma);
    const T* row = window.motion_at(since);
    forces.linearise(row, window.rates(), z, v, g_.data(), g_t_.data());
    std::fill(sigma_.begin(), sigma_.end(), per_h * T(1.0 / of.gamma));
    forces.system(row, sigma_.data(), inverse, solver_.matrix());
    solver_.decompose();
    const T* rate = v;
    for (int i = 0; i < of.stages; ++i) {
      if (table_.moves[i]) {
        table_.place(i, n, z, u_z_, stage_z_.data());
        table_.place(i, n, v, u_v_, stage_v_.data());
        rate = stage_v_.data();
        row = window.motion_at(fused(T(of.alpha[i]), h, since));
        forces.force(row, stage_z_.data(), stage_v_.data(), g_.data());
      }
      for (int k = 0; k < n; ++k) {
        T by_z(0.0), by_v(0.0);
        for (int j = 0; j < i; ++j) {
          by_z = fused(T(table_.c[i][j]), u_z_[j][k], by_z);
          by_v = fused(T(table_.c[i][j]), u_v_[j][k], by_v);
        }
        r_z_[k] = fused(per_h, by_z, rate[k]);
        by_v_[k] = per_h * by_v;
        scaled_[k] = r_z_[k] * inverse;
      }
      T *u_z = u_z_[i].data(), *u_v = u_v_[i].data();
      if (i > 0)
        forces.mass_times(row, by_v_.data(), u_v);
      else
        for (int k = 0; k < n; ++k) u_v[k] = T(0.0);
      const T time_part = T(of.d[i]) * h;
      for (int k = 0; k < n; ++k) u_v[k] += fused(time_part, g_t_[k], g_[k]);
      if (ties_move_) row = window.motion_at(since);  // where the derivatives were taken
      forces.add_stiffness_times(row, scaled_.data(), u_v);
      solver_.substitute(u_v);
      for (int k = 0; k < n; ++k) u_z[k] = (r_z_[k] + u_v[k]) * inverse;
    }
    table_.finish(n, z, u_z_, new_z, error);
    table_.finish(n, v, u_v_, new_v, error + n);
  }

  // As LaneRosenbrock's: what an error of the rates does to the offsets, x in (M s - g_v - g_z / w) x = M error, at the derivatives of
  // the last step. w: the stiffest of -g_z's diagonal over M's, no less than s.
  T offsets_of_rate_errors(LaneForces<T>& forces, const T* row, const T* s, T* error) {
    const int n = n_;
    T stiffest = s[0] * s[0];
    std::fill(scaled_.begin(), scaled_.end(), T(0.0));
    for (int i = 0; i < n; ++i) {
      scaled_[i] = T(1.0);
      std::fill(by_v_.begin(), by_v_.end(), T(0.0));
      forces.add_stiffness_times(row, scaled_.data(), by_v_.data());
      scaled_[i] = T(0.0);
      stiffest = larger(stiffest, -by_v_[i] / row[forces.at.inverse_mass(i, i)]);
    }
    stiffest = sqrt(stiffest);
    forces.system(row, s, T(1.0) / stiffest, solver_.matrix());
    solver_.decompose();
    forces.mass_times(row, error, by_v_.data());
    solver_.substitute(by_v_.data());
    std::copy(by_v_.begin(), by_v_.end(), error);
    return stiffest;
  }

 private:
  using Number = typename T::Number;

  const LaneTable<Number> table_;
  int n_;
  bool ties_move_ = false;  // whether derivatives depend on lines of the window
  std::vector<T> g_, g_t_, stage_z_, stage_v_, r_z_, by_v_, scaled_, sigma_;
  std::array<std::vector<T>, LaneTable<Number>::kMostStages> u_z_, u_v_;
  LaneBlockSolver<T> solver_;
};

}  // namespace boresight
