// A step that reads one row of the scene at its end: for layouts known when compiling, whose rows are short.
#pragma once

#include "boresight/lanes/lane_clock.hpp"
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
      : longest_(settings.longest_step),
        play(*first.scene->layout, first.joints),
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

  // Lanes that stand at the start of their motion.
  void open(const Mask& lanes, const Scenes& scenes, const LaneClock<T>& clock) {
    scene_rows(scenes.data(), clock.times(), width_, new_row_.data());
    for (int k = 0; k < used(); ++k) row_[k] = select(lanes, new_row_[k], row_[k]);
  }
  T index_at_start(const T* z) const { return index_value(N, &new_row_[gain_], z); }

  void step(const Mask&, const Scenes& scenes, const LaneClock<T>& clock, const T& h, const T* z, const T* v, T* new_z,
            T* new_v, T* error) {
    scene_rows(scenes.data(), clock.next(), width_, new_row_.data());
    for (int k = 0; k < used(); ++k) change_[k] = new_row_[k] - row_[k];
    method_.step(play, row_.data(), change_.data(), h, z, v, new_z, new_v, error);
  }
  // Gaps where the last step, or open(), ended.
  void contacts(const T* z, const T* v, std::array<ContactState<T>, kContactPlaces>* out) const {
    play.contacts(new_row_.data(), z, v, out);
  }
  void index_over_step(const T&, const T* middle_z, const T* end_z, T& middle, T& end) {
    end = index_value(N, &new_row_[gain_], end_z);
    for (int k = gain_; k < gain_ + 3 * N; ++k) change_[k] = row_[k] + T(0.5) * change_[k];
    middle = index_value(N, &change_[gain_], middle_z);
  }
  void accept(const Mask& accepted) {
    for (int k = 0; k < used(); ++k) row_[k] = select(accepted, new_row_[k], row_[k]);
  }

  // While a contact begins and ends, an error of a rate lives on in the flight that follows. One that has lasted for tens of its
  // own periods only vibrates: there a rate's error counts by the offset that it leads to. The index sees offsets; what the
  // vibration is worth when the contact ends later on is what kSettledShare stands for.
  // slowest: rates' tolerances over offsets' [1/s]; lasting: how long something has touched [s].
  void weigh_rates_of_settled_contacts(const Mask& touching, const T& lasting, const T* slowest, T* error) {
    for (int k = 0; k < N; ++k) settled_[k] = error[N + k];
    const T stiffest = method_.offsets_of_rate_errors(slowest, settled_.data());
    const Mask settled = touching & (lasting * stiffest > T(kSettledAngle));
    for (int k = 0; k < N; ++k)
      error[N + k] = select(settled, T(1.0 / kSettledShare) * settled_[k] * slowest[k], error[N + k]);
  }

 private:
  // Measured over the default scene's nine combinations of clearance and load and eight tolerances around kLaneTolerance: steps
  // fall by a fifth and no maximum leaves 1 %; from an angle of 60 or a share of 1 on some do (two peaks of nearly one height).
  static constexpr double kSettledAngle = 200.0, kSettledShare = 1.0 / 3.0;

  int used() const { return play.at.width + 3 * N; }  // of a row's columns

  double longest_;

 public:
  LaneDynamics<T, Layout> play;

 private:
  int width_, gain_;
  LaneRosenbrock<T, Layout> method_;
  std::vector<T> row_, new_row_, change_;
  Numbers settled_;
};

}  // namespace boresight
