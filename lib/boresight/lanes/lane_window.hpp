// The scene's numbers for every lane over a short window of the lane's own time, for mechanisms whose rows are long.
//
// A row grows with the square of the coordinates, and a step of many joints is short: to read rows of four cubics for every step
// would cost several times what the step itself does. So a lane reads the rows at both ends of a window, and takes straight lines
// between them: what is left out is an eighth of the window squared times the second derivative. Within a step
//   at every stage's own time   what drives the motion (r, ideal spins and slides) and what places it (ties of offsets, gains of slides, the
//                               index's gain),
//   at the step's middle        the matrices that multiply it (M, C, K, the gains of spins): of second order in the step.
#pragma once

#include <vector>

#include "boresight/lanes/lane_batch.hpp"
#include "boresight/lanes/lane_courses.hpp"
#include "boresight/lanes/lane_numbers.hpp"

namespace boresight {

template <typename T>
class LaneWindow {
 public:
  static constexpr int W = T::kWidth;
  using Real = typename T::Number;

  // gain: first column of the index's gain; length: of a window [s].
  LaneWindow(const SceneLayout& at, int gain, double length)
      : length_(length),
        first_of_load_(at.Ar),
        loads_(at.n),
        row_(static_cast<std::size_t>(gain + 3 * at.n), T(0.0)),
        first_(row_.size()),
        last_(row_.size()) {
    const auto line = [this](int first, int count) {
      if (count > 0) lines_.push_back({first, first + count});
    };
    line(at.Ar, at.n);
    for (const SceneLayout::Joint& joint : at.joints) {
      line(joint.spin, joint.spins);
      if (joint.slides) line(joint.slide, 2 + at.n);  // and how coordinates move them
      if (joint.has_dependent) line(joint.dependent, 2 * joint.offsets * at.n);
    }
    motion_lines_ = lines_.size();
    line(gain, 3 * at.n);
    int last = 0;
    for (const Line& moving : lines_) {
      if (moving.first > last) still_.push_back({last, moving.first});
      last = moving.last;
    }
    from_ = rate_ = row_;
    start_.fill(0.0);
    length_of_.fill(length);
  }

  double length() const { return length_; }
  // What a lane's sample adds to r; longest: of its windows [s].
  void set_loads(int lane, const LaneCourses& loads, double longest) {
    loads_.set(lane, loads);
    length_of_[lane] = std::min(length_, longest);
  }
  // Whether a lane's window goes on to t.
  bool reaches(int lane, double t) const { return t <= start_[lane] + length_of_[lane]; }

  void open(int lane, const LaneScene& scene, double t) {
    start_[lane] = t;
    const double end = std::min(t + length_of_[lane], scene.duration), length = end - t;
    read(scene, t, first_.data());
    read(scene, end, last_.data());
    loads_.add(lane, t, &first_[first_of_load_]);
    loads_.add(lane, end, &last_[first_of_load_]);
    const Real per_second = static_cast<Real>(length > 0.0 ? 1.0 / length : 0.0);
    for (std::size_t k = 0; k < row_.size(); ++k) {
      from_[k].set(lane, first_[k]);
      rate_[k].set(lane, (last_[k] - first_[k]) * per_second);
    }
  }

  // Seconds from each lane's start of its window to t.
  T since(const double* t) const {
    T seconds;
    for (int l = 0; l < W; ++l) seconds.set(l, t[l] - start_[l]);
    return seconds;
  }

  // Before a step: the matrices where its middle is.
  void hold_at(const T& since) {
    for (const Line& range : still_) fill(range, since);
  }
  // The row with the numbers of the motion, or of the index's gain, at a time.
  const T* motion_at(const T& since) {
    for (std::size_t i = 0; i < motion_lines_; ++i) fill(lines_[i], since);
    return row_.data();
  }
  const T* gain_at(const T& since) {
    fill(lines_.back(), since);
    return row_.data();
  }
  // Rates of what is taken at its own time, in its columns [1/s].
  const T* rates() const { return rate_.data(); }

 private:
  struct Line {
    int first, last;  // columns
  };

  void fill(const Line& range, const T& since) {
    for (int k = range.first; k < range.last; ++k) row_[k] = fused(rate_[k], since, from_[k]);
  }

  void read(const LaneScene& scene, double t, Real* out) const {
    const double x = t * scene.per_spacing;
    const int k = std::clamp(static_cast<int>(x), 0, scene.cells - 1);
    const Real s = static_cast<Real>(x - k);
    const int width = scene.width;
    const Real *c0 = scene.coefficients<Real>() + static_cast<std::size_t>(k) * 4 * width, *c1 = c0 + width,
               *c2 = c1 + width, *c3 = c2 + width;
    const int count = static_cast<int>(row_.size());
    for (int j = 0; j < count; ++j) out[j] = c0[j] + s * (c1[j] + s * (c2[j] + s * c3[j]));
  }

  double length_;
  std::size_t first_of_load_;
  LaneOwnCourses<T> loads_;
  std::vector<T> row_, from_, rate_;
  std::vector<Real> first_, last_;  // of the lane that opens a window
  std::vector<Line> lines_, still_;
  std::size_t motion_lines_ = 0;
  std::array<double, W> start_, length_of_;
};

}  // namespace boresight
