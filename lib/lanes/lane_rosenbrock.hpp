// One step of a Rosenbrock method for zddot = f(t, z, zdot), one sample a lane.
//
// The method's linear systems (1/(gamma h) - J) u = r, of size 2n, fold into n by n because z's rate is v itself: with
// sigma = 1/(gamma h), f_z and f_v the derivatives of f,
//   (sigma - f_v - f_z / sigma) u_v = r_v + f_z r_z / sigma,     u_z = (r_z + u_v) / sigma.
// Decomposed without pivots: sigma and the masses put the largest numbers on the diagonal; where that fails the error
// estimate sees it. Source of the method: rosenbrock_tables.hpp.
#pragma once

#include "boresight/lanes/lane_dynamics.hpp"

namespace boresight {

template <typename T, int N>
class LaneRosenbrock {
 public:
  static constexpr int kMostStages = 6;

  LaneRosenbrock(const RosenbrockTable& table, const LaneDynamics<T, N>& dynamics, int width)
      : table_(table), n_(dynamics.count()), row_(static_cast<std::size_t>(width)) {
    for (int i = 0; i < table.stages; ++i) {
      moves_[i] = i > 0 && (table.alpha[i] != table.alpha[i - 1]);
      for (int j = 0; j < i; ++j) {
        a_[i][j] = RosenbrockTable::entry(table.a, i, j);
        c_[i][j] = RosenbrockTable::entry(table.c, i, j);
        moves_[i] = moves_[i] || a_[i][j] != (j < i - 1 ? a_[i - 1][j] : 0.0);
      }
    }
    for (auto* numbers : {&stage_z_, &stage_v_, &slope_, &r_z_, &r_v_, &a_t_}) shape(*numbers, count());
    for (auto& u : u_z_) shape(u, count());
    for (auto& u : u_v_) shape(u, count());
    for (auto* numbers : {&a_z_, &a_v_, &lu_}) shape(*numbers, count() * count());
  }

  // From (z, v) over h; row: the scene at the start, change: its change over the step (both dynamics.at.width numbers).
  // new_z, new_v and the error of each (z, then v) come out.
  void step(LaneDynamics<T, N>& dynamics, const T* row, const T* change, const T& h, const T* z, const T* v, T* new_z,
            T* new_v, T* error) {
    const int n = count();
    const T per_h = T(1.0) / h, sigma = per_h * T(1.0 / table_.gamma), inverse = h * T(table_.gamma);
    const int width = dynamics.at.width;
    for (int k = 0; k < width; ++k) row_[k] = change[k] * per_h;
    dynamics.linearise(row, row_.data(), z, v, slope_.data(), a_z_.data(), a_v_.data(), a_t_.data());
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        lu_[i * n + j] = -a_v_[i * n + j] - a_z_[i * n + j] * inverse;
        if (i == j) lu_[i * n + j] += sigma;
      }
    decompose();
    const T* stage_v = v;
    for (int i = 0; i < table_.stages; ++i) {
      if (moves_[i]) {
        for (int k = 0; k < n; ++k) {
          stage_z_[k] = z[k];
          stage_v_[k] = v[k];
          for (int j = 0; j < i; ++j) {
            stage_z_[k] += T(a_[i][j]) * u_z_[j][k];
            stage_v_[k] += T(a_[i][j]) * u_v_[j][k];
          }
        }
        stage_v = stage_v_.data();
        const T share(table_.alpha[i]);
        if (table_.alpha[i] != table_.alpha[i - 1])
          for (int k = 0; k < width; ++k) row_[k] = row[k] + share * change[k];
        dynamics.acceleration(row_.data(), stage_z_.data(), stage_v_.data(), slope_.data());
      }
      const T time_part = T(table_.d[i]) * h;
      for (int k = 0; k < n; ++k) {
        T by_z(0.0), by_v(0.0);
        for (int j = 0; j < i; ++j) {
          by_z += T(c_[i][j]) * u_z_[j][k];
          by_v += T(c_[i][j]) * u_v_[j][k];
        }
        r_z_[k] = stage_v[k] + per_h * by_z;
        r_v_[k] = slope_[k] + per_h * by_v + time_part * a_t_[k];
      }
      solve(inverse, u_z_[i].data(), u_v_[i].data());
    }
    for (int k = 0; k < n; ++k) {
      new_z[k] = z[k];
      new_v[k] = v[k];
      error[k] = error[n + k] = T(0.0);
      for (int i = 0; i < table_.stages; ++i) {
        new_z[k] += T(table_.m[i]) * u_z_[i][k];
        new_v[k] += T(table_.m[i]) * u_v_[i][k];
        error[k] += T(table_.e[i]) * u_z_[i][k];
        error[n + k] += T(table_.e[i]) * u_v_[i][k];
      }
    }
  }

  // What an error of the rates does to the offsets, in the system that the last step saw: x in (s - f_v - f_z / w) x = error.
  // A free coordinate carries it on for as long as the scene changes, 1/s; friction's slope stops it; a contact's spring turns
  // it around after 1/w. s: per coordinate [1/s]; returns w, the square root of the largest of -f_z's diagonal, no less than s.
  T offsets_of_rate_errors(const T* s, T* error) {
    const int n = count();
    T stiffest = s[0] * s[0];
    for (int i = 0; i < n; ++i) stiffest = larger(stiffest, -a_z_[i * n + i]);
    stiffest = sqrt(stiffest);
    const T inverse = T(1.0) / stiffest;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        lu_[i * n + j] = -a_v_[i * n + j] - a_z_[i * n + j] * inverse;
        if (i == j) lu_[i * n + j] += s[i];
      }
    decompose();
    substitute(error);
    return stiffest;
  }

 private:
  int count() const { return N > 0 ? N : n_; }

  // lu_: a matrix into its factors.
  void decompose() {
    const int n = count();
    for (int k = 0; k < n; ++k) {
      lu_[k * n + k] = T(1.0) / lu_[k * n + k];  // the pivot's inverse in its place
      for (int i = k + 1; i < n; ++i) {
        const T factor = lu_[i * n + k] * lu_[k * n + k];
        lu_[i * n + k] = factor;
        for (int j = k + 1; j < n; ++j) lu_[i * n + j] -= factor * lu_[k * n + j];
      }
    }
  }

  void substitute(T* x) const {
    const int n = count();
    for (int i = 1; i < n; ++i)
      for (int j = 0; j < i; ++j) x[i] -= lu_[i * n + j] * x[j];
    for (int i = n - 1; i >= 0; --i) {
      for (int j = i + 1; j < n; ++j) x[i] -= lu_[i * n + j] * x[j];
      x[i] = x[i] * lu_[i * n + i];
    }
  }

  void solve(const T& inverse, T* u_z, T* u_v) const {
    const int n = count();
    for (int i = 0; i < n; ++i) {
      u_v[i] = r_v_[i];
      for (int j = 0; j < n; ++j) u_v[i] += a_z_[i * n + j] * (r_z_[j] * inverse);
    }
    substitute(u_v);
    for (int i = 0; i < n; ++i) u_z[i] = (r_z_[i] + u_v[i]) * inverse;
  }

  const RosenbrockTable& table_;
  int n_;
  double a_[kMostStages][kMostStages] = {}, c_[kMostStages][kMostStages] = {};
  bool moves_[kMostStages] = {};
  std::vector<T> row_;
  LaneNumbers<T, N> stage_z_, stage_v_, slope_, r_z_, r_v_, a_t_;
  std::array<LaneNumbers<T, N>, kMostStages> u_z_, u_v_;
  LaneNumbers<T, N * N> a_z_, a_v_, lu_;
};

}  // namespace boresight
