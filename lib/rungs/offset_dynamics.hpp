// The right-hand side of the perturbation rung: xiddot = A (r + f_contact) - A C xidot, one template for every scalar.
//
// T is the scalar of the offsets and of the numbers that a sample varies; the scene's functions of time are plain doubles,
// shared by all samples. State: xi (n), then xidot (n).
#pragma once

#include <array>
#include <vector>

#include "boresight/contact/journal_in_sleeve.hpp"
#include "boresight/rungs/clearance_scene.hpp"

namespace boresight {

// Where the parts of one row of SceneTables::dynamics lie.
struct SceneRow {
  explicit SceneRow(int clearances)
      : n(3 * clearances), A(0), Ar(n * n), AC(Ar + n), joints(AC + n * n), per_joint(4 + 4 * n) {}
  int spin(int c) const { return joints + c * per_joint; }
  int slide(int c) const { return spin(c) + 3; }
  int spin_gain(int c) const { return spin(c) + 4; }        // 3 x n
  int slide_gain(int c) const { return spin(c) + 4 + 3 * n; }  // 1 x n
  int n, A, Ar, AC, joints, per_joint;
};

// How the journal of clearance c moves, from the offsets and the scene at that time.
template <typename T>
JournalMotion<T> journal_motion(const SceneRow& at, const double* scene, bool slides, int c, const T* xi, const T* rate) {
  JournalMotion<T> m;
  for (int i = 0; i < 3; ++i) {
    m.e[i] = xi[3 * c + i];
    m.e_dot[i] = rate[3 * c + i];
    T spin(scene[at.spin(c) + i]);
    const double* gain = scene + at.spin_gain(c) + i * at.n;
    for (int j = 0; j < at.n; ++j) spin += T(gain[j]) * rate[j];
    m.w[i] = spin;
  }
  if (slides) {
    T slide(scene[at.slide(c)]);
    for (int j = 0; j < at.n; ++j) slide += T(scene[at.slide_gain(c) + j]) * rate[j];
    m.e_dot[1] = slide;
  }
  return m;
}

// Adds a joint's wrench to the generalised force (n numbers).
template <typename T>
void add_generalised_force(const SceneRow& at, const double* scene, bool slides, int c, const JournalWrench<T>& wrench,
                           T* force) {
  force[3 * c] += wrench.force[0];
  if (!slides) force[3 * c + 1] += wrench.force[1];
  force[3 * c + 2] += wrench.force[2];
  for (int j = 0; j < at.n; ++j) {
    const double* gain = scene + at.spin_gain(c) + j;
    force[j] += T(gain[0]) * wrench.moment[0] + T(gain[at.n]) * wrench.moment[1] + T(gain[2 * at.n]) * wrench.moment[2];
    if (slides) force[j] += T(scene[at.slide_gain(c) + j]) * wrench.force[1];
  }
}

// xiddot from the generalised contact force.
template <typename T>
void offset_acceleration(const SceneRow& at, const double* scene, const T* rate, const T* force, T* acceleration) {
  for (int i = 0; i < at.n; ++i) {
    T sum(scene[at.Ar + i]);
    const double *A = scene + at.A + i * at.n, *AC = scene + at.AC + i * at.n;
    for (int j = 0; j < at.n; ++j) sum += T(A[j]) * force[j] - T(AC[j]) * rate[j];
    acceleration[i] = sum;
  }
}

}  // namespace boresight
