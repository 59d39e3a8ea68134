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

template <typename T, typename Layout>
class LaneRosenbrock {
 public:
  static constexpr int N = Layout::kCount;
  static constexpr int kMostStages = 6;

  LaneRosenbrock(const RosenbrockTable& table, const LaneDynamics<T, Layout>& dynamics, int width)
      : table_(table), n_(dynamics.count()), row_(static_cast<std::size_t>(width)) {
    for (int i = 0; i < table.stages; ++i) {
      m_[i] = static_cast<typename T::Number>(table.m[i]);
      e_[i] = static_cast<typename T::Number>(table.e[i]);
      moves_[i] = i > 0 && (table.alpha[i] != table.alpha[i - 1]);
      for (int j = 0; j < i; ++j) {
        const double a = RosenbrockTable::entry(table.a, i, j);
        moves_[i] = moves_[i] || a != (j < i - 1 ? RosenbrockTable::entry(table.a, i - 1, j) : 0.0);
        a_[i][j] = static_cast<typename T::Number>(a);
        c_[i][j] = static_cast<typename T::Number>(RosenbrockTable::entry(table.c, i, j));
      }
    }
  }

  // From (z, v) over h; row: the scene at the start, change: its change over the step (both dynamics.at.width numbers).
  // new_z, new_v and the error of each (z, then v) come out.
  void step(LaneDynamics<T, Layout>& dynamics, const T* row, const T* change, const T& h, const T* z, const T* v,
            T* new_z, T* new_v, T* error) {
    const int n = count();
    const T per_h = T(1.0) / h, sigma = per_h * T(1.0 / table_.gamma), inverse = h * T(table_.gamma);
    const int width = dynamics.at.width;
    LaneVector<T, N> slope, a_t, stage_z, stage_v, r_z, r_v;
    std::array<LaneVector<T, N>, kMostStages> u_z, u_v;
    for (int k = 0; k < width; ++k) row_[k] = change[k] * per_h;
    dynamics.linearise(row, row_.data(), z, v, slope.data(), a_z_.data(), a_v_.data(), a_t.data());
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        lu_[i * n + j] = fused(-a_z_[i * n + j], inverse, -a_v_[i * n + j]);
        if (i == j) lu_[i * n + j] += sigma;
      }
    decompose();
    const T* rate = v;
    for (int i = 0; i < table_.stages; ++i) {
      if (moves_[i]) {
        for (int k = 0; k < n; ++k) {
          stage_z[k] = z[k];
          stage_v[k] = v[k];
          for (int j = 0; j < i; ++j) {
            stage_z[k] = fused(T(a_[i][j]), u_z[j][k], stage_z[k]);
            stage_v[k] = fused(T(a_[i][j]), u_v[j][k], stage_v[k]);
          }
        }
        rate = stage_v.data();
        const T share(table_.alpha[i]);
        if (table_.alpha[i] != table_.alpha[i - 1])
          for (int k = 0; k < width; ++k) row_[k] = fused(share, change[k], row[k]);
        dynamics.acceleration(row_.data(), stage_z.data(), stage_v.data(), slope.data());
      }
      const T time_part = T(table_.d[i]) * h;
      for (int k = 0; k < n; ++k) {
        T by_z(0.0), by_v(0.0);
        for (int j = 0; j < i; ++j) {
          by_z = fused(T(c_[i][j]), u_z[j][k], by_z);
          by_v = fused(T(c_[i][j]), u_v[j][k], by_v);
        }
        r_z[k] = fused(per_h, by_z, rate[k]);
        r_v[k] = fused(time_part, a_t[k], fused(per_h, by_v, slope[k]));
      }
      solve(inverse, r_z, r_v, u_z[i], u_v[i]);
    }
    for (int k = 0; k < n; ++k) {
      new_z[k] = z[k];
      new_v[k] = v[k];
      error[k] = error[n + k] = T(0.0);
      for (int i = 0; i < table_.stages; ++i) {
        new_z[k] = fused(T(m_[i]), u_z[i][k], new_z[k]);
        new_v[k] = fused(T(m_[i]), u_v[i][k], new_v[k]);
        error[k] = fused(T(e_[i]), u_z[i][k], error[k]);
        error[n + k] = fused(T(e_[i]), u_v[i][k], error[n + k]);
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
        lu_[i * n + j] = fused(-a_z_[i * n + j], inverse, -a_v_[i * n + j]);
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
        for (int j = k + 1; j < n; ++j) lu_[i * n + j] = fused(-factor, lu_[k * n + j], lu_[i * n + j]);
      }
    }
  }

  void substitute(T* x) const {
    const int n = count();
    for (int i = 1; i < n; ++i)
      for (int j = 0; j < i; ++j) x[i] = fused(-lu_[i * n + j], x[j], x[i]);
    for (int i = n - 1; i >= 0; --i) {
      for (int j = i + 1; j < n; ++j) x[i] = fused(-lu_[i * n + j], x[j], x[i]);
      x[i] = x[i] * lu_[i * n + i];
    }
  }

  void solve(const T& inverse, const LaneVector<T, N>& r_z, const LaneVector<T, N>& r_v, LaneVector<T, N>& u_z,
             LaneVector<T, N>& u_v) const {
    const int n = count();
    LaneVector<T, N> x;
    for (int i = 0; i < n; ++i) {
      x[i] = r_v[i];
      for (int j = 0; j < n; ++j) x[i] = fused(a_z_[i * n + j], r_z[j] * inverse, x[i]);
    }
    substitute(x.data());
    for (int i = 0; i < n; ++i) {
      u_v[i] = x[i];
      u_z[i] = (r_z[i] + x[i]) * inverse;
    }
  }

  const RosenbrockTable& table_;
  int n_;
  typename T::Number a_[kMostStages][kMostStages] = {},
                     c_[kMostStages][kMostStages] = {};  // in the lanes' own precision
  typename T::Number m_[kMostStages] = {}, e_[kMostStages] = {};
  bool moves_[kMostStages] = {};
  std::vector<T> row_;
  LaneMatrix<T, N> a_z_, a_v_, lu_;
};

}  // namespace boresight
