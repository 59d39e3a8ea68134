// A step that reads one row of the scene at its end: for layouts known when compiling, whose rows are short.
#pragma once

#include "boresight/lanes/lane_clock.hpp"
#include "boresight/lanes/lane_courses.hpp"
#include "boresight/lanes/lane_rosenbrock.hpp"
#include "boresight/lanes/lane_rows.hpp"
#include "boresight/lanes/lane_statistics.hpp"

namespace boresight {

template <typename T, typename Layout>
class LaneRowStep {
 public:
  static constexpr int N = Layout::kCount;
  using Numbers = LaneVector<T, N>;
  using Pairs = LaneVector<T, 2 * N>;
  using Mask = typename T::Mask;
  using Scenes = std::array<const LaneScene*, T::kWidth>;

  LaneRowStep(const LaneJob& first, const LaneSettings& settings)
      : play(*first.scene->layout, first.joints),
        longest_(settings.longest_step),
        width_(first.scene->width),
        gain_(first.scene->gain),
        method_(*settings.method, width_),
        row_(static_cast<std::size_t>(width_)),
        new_row_(row_),
        change_(row_) {}

  static constexpr int count() { return N; }
  static constexpr Numbers numbers() { return {}; }
  static constexpr Pairs pairs() { return {}; }
  double longest() const { return longest_; }

  // What a lane's sample adds to r.
  void set_loads(int lane, const LaneCourses& loads, double) { loads_.set(lane, loads); }
  // Lanes that stand at the start of their motion.
  void open(const Mask& lanes, const Scenes& scenes, const LaneClock<T>& clock) {
    read(scenes, clock.times());
    for (int k = 0; k < used(); ++k) row_[k] = select(lanes, new_row_[k], row_[k]);
  }
  // Where the last step, or open(), ended.
  T index_here(const T* z, const T* standing) const { return index_value(N, &new_row_[gain_], z, standing); }

  void step(const Mask&, const Scenes& scenes, const LaneClock<T>& clock, const T& h, const T* z, const T* v, T* new_z,
            T* new_v, T* error) {
    read(scenes, clock.next());
    for (int k = 0; k < used(); ++k) change_[k] = new_row_[k] - row_[k];
    method_.step(play, row_.data(), change_.data(), h, z, v, new_z, new_v, error);
  }
  // Gaps where the last step, or open(), ended.
  void contacts(const T* z, const T* v, std::array<ContactState<T>, kContactPlaces>* out) const {
    play.contacts(new_row_.data(), z, v, out);
  }
  void index_over_step(const T&, const IndexPlace<T>& at_middle, const IndexPlace<T>& at_end, T& middle, T& end) {
    end = index_value(N, &new_row_[gain_], at_end.z, at_end.standing);
    for (int k = gain_; k < gain_ + 3 * N; ++k) change_[k] = row_[k] + T(0.5) * change_[k];
    middle = index_value(N, &change_[gain_], at_middle.z, at_middle.standing);
  }
  void accept(const Mask& accepted) {
    for (int k = 0; k < used(); ++k) row_[k] = select(accepted, new_row_[k], row_[k]);
  }

  static constexpr bool weighs_rates() { return true; }
  T offsets_of_rate_errors(const T* slowest, T* error) { return method_.offsets_of_rate_errors(slowest, error); }

  LaneDynamics<T, Layout> play;

 private:
  void read(const Scenes& scenes, const double* t) {
    scene_rows(scenes.data(), t, width_, new_row_.data());
    if (!loads_.any()) return;
    T change[N];
    loads_.at(t, change);
    for (int k = 0; k < N; ++k) new_row_[static_cast<std::size_t>(play.at.Ar + k)] += change[k];
  }
  int used() const { return play.at.width + 3 * N; }  // of a row's columns

  double longest_;
  int width_, gain_;
  LaneRosenbrock<T, Layout> method_;
  LaneOwnCourses<T> loads_{N};
  std::vector<T> row_, new_row_, change_;
};

}  // namespace boresight
