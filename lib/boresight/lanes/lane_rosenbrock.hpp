// One step of a Rosenbrock method for zddot = f(t, z, zdot), one sample a lane.
//
// The method's linear systems (1/(gamma h) - J) u = r, of size 2n, fold into n by n because z's rate is v itself: with
// sigma = 1/(gamma h), f_z and f_v the derivatives of f,
//   (sigma - f_v - f_z / sigma) u_v = r_v + f_z r_z / sigma,     u_z = (r_z + u_v) / sigma.
// Decomposed without pivots: sigma and the masses put the largest numbers on the diagonal; where that fails the error
// estimate sees it. Source of the method: rosenbrock_tables.hpp.
#pragma once

#include "boresight/lanes/lane_dynamics.hpp"
#include "boresight/lanes/lane_table.hpp"

namespace boresight {

template <typename T, typename Layout>
class LaneRosenbrock {
 public:
  static constexpr int N = Layout::kCount;

  LaneRosenbrock(const RosenbrockTable& table, int width) : table_(table), row_(static_cast<std::size_t>(width)) {}

  // From (z, v) over h; row: the scene at the start, change: its change over the step (both dynamics.at.width numbers).
  // new_z, new_v and the error of each (z, then v) come out.
  void step(LaneDynamics<T, Layout>& dynamics, const T* row, const T* change, const T& h, const T* z, const T* v,
            T* new_z, T* new_v, T* error) {
    const RosenbrockTable& of = table_.of;
    const T per_h = T(1.0) / h, sigma = per_h * T(1.0 / of.gamma), inverse = h * T(of.gamma);
    const int width = dynamics.at.width;
    LaneVector<T, N> slope, a_t, stage_z, stage_v, r_z, r_v;
    std::array<LaneVector<T, N>, LaneTable<Number>::kMostStages> u_z, u_v;
    for (int k = 0; k < width; ++k) row_[k] = change[k] * per_h;
    dynamics.linearise(row, row_.data(), z, v, slope.data(), a_z_.data(), a_v_.data(), a_t.data());
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) {
        lu_[i * N + j] = fused(-a_z_[i * N + j], inverse, -a_v_[i * N + j]);
        if (i == j) lu_[i * N + j] += sigma;
      }
    decompose();
    const T* rate = v;
    for (int i = 0; i < of.stages; ++i) {
      if (table_.moves[i]) {
        table_.place(i, N, z, u_z, stage_z.data());
        table_.place(i, N, v, u_v, stage_v.data());
        rate = stage_v.data();
        const T share(of.alpha[i]);
        if (of.alpha[i] != of.alpha[i - 1])
          for (int k = 0; k < width; ++k) row_[k] = fused(share, change[k], row[k]);
        dynamics.acceleration(row_.data(), stage_z.data(), stage_v.data(), slope.data());
      }
      const T time_part = T(of.d[i]) * h;
      for (int k = 0; k < N; ++k) {
        T by_z(0.0), by_v(0.0);
        for (int j = 0; j < i; ++j) {
          by_z = fused(T(table_.c[i][j]), u_z[j][k], by_z);
          by_v = fused(T(table_.c[i][j]), u_v[j][k], by_v);
        }
        r_z[k] = fused(per_h, by_z, rate[k]);
        r_v[k] = fused(time_part, a_t[k], fused(per_h, by_v, slope[k]));
      }
      solve(inverse, r_z, r_v, u_z[i], u_v[i]);
    }
    table_.finish(N, z, u_z, new_z, error);
    table_.finish(N, v, u_v, new_v, error + N);
  }

  // What an error of the rates does to the offsets, in the system that the last step saw: x in (s - f_v - f_z / w) x = error.
  // A free coordinate carries it on for as long as the scene changes, 1/s; friction's slope stops it; a contact's spring turns
  // it around after 1/w. s: per coordinate [1/s]; returns w, the square root of the largest of -f_z's diagonal, no less than s.
  T offsets_of_rate_errors(const T* s, T* error) {
    T stiffest = s[0] * s[0];
    for (int i = 0; i < N; ++i) stiffest = larger(stiffest, -a_z_[i * N + i]);
    stiffest = sqrt(stiffest);
    const T inverse = T(1.0) / stiffest;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j) {
        lu_[i * N + j] = fused(-a_z_[i * N + j], inverse, -a_v_[i * N + j]);
        if (i == j) lu_[i * N + j] += s[i];
      }
    decompose();
    substitute(error);
    return stiffest;
  }

 private:
  using Number = typename T::Number;

  // lu_: a matrix into its factors.
  void decompose() {
    for (int k = 0; k < N; ++k) {
      lu_[k * N + k] = T(1.0) / lu_[k * N + k];  // the pivot's inverse in its place
      for (int i = k + 1; i < N; ++i) {
        const T factor = lu_[i * N + k] * lu_[k * N + k];
        lu_[i * N + k] = factor;
        for (int j = k + 1; j < N; ++j) lu_[i * N + j] = fused(-factor, lu_[k * N + j], lu_[i * N + j]);
      }
    }
  }

  void substitute(T* x) const {
    for (int i = 1; i < N; ++i)
      for (int j = 0; j < i; ++j) x[i] = fused(-lu_[i * N + j], x[j], x[i]);
    for (int i = N - 1; i >= 0; --i) {
      for (int j = i + 1; j < N; ++j) x[i] = fused(-lu_[i * N + j], x[j], x[i]);
      x[i] = x[i] * lu_[i * N + i];
    }
  }

  void solve(const T& inverse, const LaneVector<T, N>& r_z, const LaneVector<T, N>& r_v, LaneVector<T, N>& u_z,
             LaneVector<T, N>& u_v) const {
    LaneVector<T, N> x;
    for (int i = 0; i < N; ++i) {
      x[i] = r_v[i];
      for (int j = 0; j < N; ++j) x[i] = fused(a_z_[i * N + j], r_z[j] * inverse, x[i]);
    }
    substitute(x.data());
    for (int i = 0; i < N; ++i) {
      u_v[i] = x[i];
      u_z[i] = (r_z[i] + x[i]) * inverse;
    }
  }

  const LaneTable<Number> table_;
  std::vector<T> row_;
  LaneMatrix<T, N> a_z_, a_v_, lu_;
};

}  // namespace boresight
