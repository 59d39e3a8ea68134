// Where the numbers of a clearance scene lie in one row of its table (one row per time).
#pragma once

#include <array>
#include <vector>

#include "boresight/play/play_motion.hpp"
#include "boresight/scene/deviation_coordinates.hpp"

namespace boresight {

// Where entry (i, j) of a symmetric matrix lies, of which the upper triangle is kept row by row.
constexpr int upper_triangle(int n, int i, int j) {
  return i <= j ? i * n - i * (i - 1) / 2 + j - i : upper_triangle(n, j, i);
}

// Which of a joint's slides an offset is that is none: y is the only one of a joint that slides along its axis, x and z are the first and
// the second of one that slides across it.
constexpr int slide_number(int offset) { return offset / 2; }

// What a row says of the coordinates: their accelerations, zddot = A (r + f) - A C zdot - A K z, or the forces on them,
// M zddot = r + f - C zdot - K z. Both lie alike: A and M, A r and r, ...
enum class SceneForm { accelerations, forces };

struct SceneLayout {
  struct Joint {
    bool tilts = false, rolls = false, twists = false;
    int slides = 0;  // directions in which it slides
    // Per offset (three, five where a journal tilts, six where a slider rolls): its coordinate, or DeviationCoordinates::kSlides, kDependent.
    int offsets = 3;
    std::array<int, kMostOffsets> source = {};
    int spins = 1;        // components of the relative spin kept: y, or x y z where the contacts see all of it
    int spin = 0;         // ideal spin
    int spin_gain = 0;    // spins x n: what coordinate rates add to it
    int spin_drift = 0;   // spins x n: what coordinates add to it (where gains move)
    int slide = 0;        // ideal displacement and its rate, slide by slide
    int slide_gain = 0;   // slides x n
    int slide_drift = 0;  // slides x n, as spin_drift
    int twist = 0;        // cosine and sine of the ideal twist (where it twists)
    int dependent = 0;    // B and then Bdot, offsets x n each (where an offset is dependent)
    int shift = 0;  // what standing errors leave of the offsets with all coordinates zero, and its rate (likewise)
    bool has_dependent = false;
    // Where redundant joints tie offsets together, which of them are coordinates is the drawing's choice. It does not matter only if what the
    // coordinates' gains change by as the mechanism moves is kept.
    bool gains_move = false;
  };

  SceneLayout() = default;
  SceneLayout(const OffsetLayout& offsets, const DeviationCoordinates& coordinates, bool with_stiffness)
      : n(coordinates.count()), stiff(with_stiffness) {
    A = 0;
    Ar = A + n * (n + 1) / 2;
    AC = Ar + n;
    AK = AC + n * n;
    width = AK + (stiff ? n * n : 0);
    joints_at = width;
    for (int c = 0; c < offsets.clearances(); ++c) {
      Joint j;
      j.tilts = offsets.joint(c).tilts;
      j.rolls = offsets.joint(c).rolls;
      j.twists = offsets.joint(c).twists;
      j.slides = offsets.joint(c).slides;
      j.offsets = offsets.joint(c).count();
      for (int k = 0; k < j.offsets; ++k) {
        j.source[k] = coordinates.source()[offsets.joint(c).first + k];
        j.has_dependent = j.has_dependent || j.source[k] == DeviationCoordinates::kDependent;
      }
      j.spins = offsets.joint(c).spins;
      j.gains_move = coordinates.has_dependent();
      const auto take = [this](int numbers) {
        const int at = width;
        width += numbers;
        return at;
      };
      j.spin = take(j.spins);
      j.spin_gain = take(j.spins * n);
      j.spin_drift = take(j.gains_move ? j.spins * n : 0);
      j.slide = take(2 * j.slides);
      j.slide_gain = take(j.slides * n);
      j.slide_drift = take(j.gains_move ? j.slides * n : 0);
      j.twist = take(j.twists ? 2 : 0);
      j.dependent = take(j.has_dependent ? 2 * j.offsets * n : 0);
      j.shift = take(j.has_dependent ? 2 * j.offsets : 0);
      joints.push_back(j);
    }
  }

  // Column of A(i, j).
  int inverse_mass(int i, int j) const { return A + upper_triangle(n, i, j); }
  // A as a matrix, from one row.
  void inverse_mass(const double* row, MatX& matrix) const {
    matrix.resize(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) matrix(i, j) = row[inverse_mass(i, j)];
  }

  int n = 0;                   // coordinates
  bool stiff = false;          // whether forces that grow with the coordinates themselves are kept
  bool tips = false;           // whether these take journals farther from where no load pushes them: tipping.hpp
  std::vector<int> tipped;     // clearances whose journals these are
  std::vector<int> undecided;  // clearances whose journals nothing holds along part of their play as motions start
  int A = 0, Ar = 0, AC = 0, AK = 0, joints_at = 0, width = 0;
  std::vector<Joint> joints;
};

}  // namespace boresight
