// A step within a window of the scene: for mechanisms of any number of joints, whose rows are long.
#pragma once

#include "boresight/lanes/lane_clock.hpp"
#include "boresight/lanes/lane_mass_rosenbrock.hpp"
#include "boresight/lanes/lane_statistics.hpp"

namespace boresight {

template <typename T>
class LaneWindowStep {
 public:
  static constexpr int W = T::kWidth;
  using Numbers = std::vector<T>;
  using Pairs = std::vector<T>;
  using Mask = typename T::Mask;
  using Scenes = std::array<const LaneScene*, W>;

  LaneWindowStep(const LaneJob& first, const LaneSettings& settings)
      : play(*first.scene->layout, first.joints),
        n_(first.scene->layout->n),
        gain_(first.scene->gain),
        window_(*first.scene->layout, gain_, settings.longest_held_step),
        method_(*settings.method, *first.scene->layout) {}

  int count() const { return n_; }
  Numbers numbers() const { return Numbers(static_cast<std::size_t>(n_), T(0.0)); }
  Pairs pairs() const { return Pairs(static_cast<std::size_t>(2 * n_), T(0.0)); }
  double longest() const { return window_.length(); }

  // What a lane's sample adds to r, and its longest step [s].
  void set_loads(int lane, const LaneCourses& loads, double longest) { window_.set_loads(lane, loads, longest); }
  void open(const Mask& lanes, const Scenes& scenes, const LaneClock<T>& clock) {
    for (int l = 0; l < W; ++l)
      if (lanes.lane(l)) window_.open(l, *scenes[l], clock.now(l));
    start_ = end_ = window_.since(clock.times());
    window_.hold_at(start_);
  }
  // Where the last step, or open(), ended.
  T index_here(const T* z, const T* standing) { return index_value(n_, window_.gain_at(end_) + gain_, z, standing); }

  void step(const Mask& running, const Scenes& scenes, const LaneClock<T>& clock, const T& h, const T* z, const T* v,
            T* new_z, T* new_v, T* error) {
    for (int l = 0; l < W; ++l)
      if (running.lane(l) && !window_.reaches(l, clock.next()[l])) window_.open(l, *scenes[l], clock.now(l));
    start_ = window_.since(clock.times());
    end_ = start_ + h;
    window_.hold_at(fused(T(0.5), h, start_));
    method_.step(play, window_, start_, h, z, v, new_z, new_v, error);
  }
  void contacts(const T* z, const T* v, std::array<ContactState<T>, kContactPlaces>* out) {
    play.contacts(window_.motion_at(end_), z, v, out);
  }
  void index_over_step(const T& h, const IndexPlace<T>& at_middle, const IndexPlace<T>& at_end, T& middle, T& end) {
    end = index_value(n_, window_.gain_at(end_) + gain_, at_end.z, at_end.standing);
    const T* gain = window_.gain_at(fused(T(0.5), h, start_)) + gain_;
    middle = index_value(n_, gain, at_middle.z, at_middle.standing);
  }
  void accept(const Mask&) {}
  // Where several joints have play some contact begins all the time, and none is settled: not asked then.
  bool weighs_rates() const { return play.at.joints.size() == 1; }
  T offsets_of_rate_errors(const T* slowest, T* error) {
    return method_.offsets_of_rate_errors(play, window_.motion_at(start_), slowest, error);
  }

  LaneForces<T> play;

 private:
  int n_, gain_;
  LaneWindow<T> window_;
  LaneMassRosenbrock<T> method_;
  T start_{0.0}, end_{0.0};  // of the last step, from the window's start [s]
};

}  // namespace boresight
