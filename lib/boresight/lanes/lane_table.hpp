// A Rosenbrock method's numbers in the lanes' own precision, and which of its stages move.
#pragma once

#include "boresight/integrate/rosenbrock_tables.hpp"

namespace boresight {

template <typename Number>
struct LaneTable {
  static constexpr int kMostStages = 6;

  explicit LaneTable(const RosenbrockTable& table) : of(table) {
    for (int i = 0; i < table.stages; ++i) {
      m[i] = static_cast<Number>(table.m[i]);
      e[i] = static_cast<Number>(table.e[i]);
      moves[i] = i > 0 && (table.alpha[i] != table.alpha[i - 1]);
      for (int j = 0; j < i; ++j) {
        const double entry = RosenbrockTable::entry(table.a, i, j);
        moves[i] = moves[i] || entry != (j < i - 1 ? RosenbrockTable::entry(table.a, i - 1, j) : 0.0);
        a[i][j] = static_cast<Number>(entry);
        c[i][j] = static_cast<Number>(RosenbrockTable::entry(table.c, i, j));
      }
    }
  }

  // Where stage i is evaluated, from the increments of those before it.
  template <typename T, typename Increments>
  void place(int i, int n, const T* start, const Increments& u, T* stage) const {
    for (int k = 0; k < n; ++k) {
      stage[k] = start[k];
      for (int j = 0; j < i; ++j) stage[k] = fused(T(a[i][j]), u[j][k], stage[k]);
    }
  }

  // The step's end and its error, of z or of v.
  template <typename T, typename Increments>
  void finish(int n, const T* start, const Increments& u, T* end, T* error) const {
    for (int k = 0; k < n; ++k) {
      end[k] = start[k];
      error[k] = T(0.0);
      for (int i = 0; i < of.stages; ++i) {
        end[k] = fused(T(m[i]), u[i][k], end[k]);
        error[k] = fused(T(e[i]), u[i][k], error[k]);
      }
    }
  }

  const RosenbrockTable& of;
  Number a[kMostStages][kMostStages] = {}, c[kMostStages][kMostStages] = {};
  Number m[kMostStages] = {}, e[kMostStages] = {};
  bool moves[kMostStages] = {};  // whether a stage stands elsewhere than the one before
};

}  // namespace boresight
