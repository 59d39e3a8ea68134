// Fixed steps through a motion, which meet both its samples and its end.
#pragma once

#include <algorithm>
#include <cmath>

namespace boresight {

// Steps of at most `wanted` [s] through `duration` [s]: of one length; or, where whole steps make a sample spacing [s] (0: no samples) that
// does not divide the duration, of the wanted length but for the last one.
class EvenSteps {
 public:
  EvenSteps(double duration, double wanted, double spacing)
      : count_(std::max(1L, static_cast<long>(std::ceil(duration / wanted - 1e-9)))),
        h_(duration / static_cast<double>(count_)),
        last_(h_) {
    const double samples = spacing / wanted;
    if (wanted < duration && samples > 0.5 && std::abs(samples - std::round(samples)) < 1e-9 * samples &&
        wanted - h_ > 1e-9 * h_)
      h_ = wanted, last_ = duration - static_cast<double>(count_ - 1) * h_;
  }

  long count() const { return count_; }
  double h() const { return h_; }
  // Of step i; start(count()) is the end.
  double start(long i) const { return static_cast<double>(i) * h_ - (i == count_ ? h_ - last_ : 0.0); }
  double length(long i) const { return i + 1 < count_ ? h_ : last_; }

 private:
  long count_;
  double h_, last_;
};

}  // namespace boresight
