// Which share of a motion's displacement is missed.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "boresight/pointing/indices.hpp"

namespace boresight {

// Of one kind of displacement over the instants: the largest and the mean square of what the rung has, and of what it misses or of
// what a group of coordinates contributes.
class MissedShare {
 public:
  void add(double size, double part) {
    size_ = std::max(size_, size);
    part_ = std::max(part_, part);
    sum_ += size;
    part_sum_ += part;
    square_ += size * size;
    part_square_ += part * part;
    ++instants_;
  }
  double size() const { return size_; }
  // Of the root mean squares.
  double mean_value(double least) const {
    const double square = std::max(square_, instants_ * least * least);
    if (square > 0.0) return std::sqrt(part_square_ / square);
    return part_square_ > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
  }
  // The same, of a root mean square that is more than the displacements' own.
  double mean_value(double least, double rms) const {
    const double of = std::max(rms, least);
    return instants_ > 0 ? ratio(std::sqrt(part_square_ / instants_), of) : 0.0;
  }
  // The largest of the ratios of maxima, root mean squares and means; what is smaller than `least` is held against that. The instants are those of
  // large deviations, and a mean over them is more than the motion's own, by index: what is missed all along counts against that.
  double value(double least, const Statistics& index) const {
    const double size = std::max(size_, least);
    if (!(size > 0.0)) return 0.0;
    const double n = instants_, rms = std::max(std::min(std::sqrt(square_ / n), index.rms), least),
                 mean = std::max(std::min(sum_ / n, index.mean), least);
    const double by_rms = std::sqrt(part_square_ / n), by_mean = part_sum_ / n;
    return std::max({part_ / size, ratio(by_rms, rms), ratio(by_mean, mean)});
  }
  // Where something else displaces as well, and the index is of all: the share of that.
  double share_of(double least, const Statistics& index) const {
    if (instants_ == 0) return 0.0;
    const double n = instants_;
    return std::max({ratio(part_, std::max(index.max, least)),
                     ratio(std::sqrt(part_square_ / n), std::max(index.rms, least)),
                     ratio(part_sum_ / n, std::max(index.mean, least))});
  }

 private:
  static double ratio(double part, double of) {
    return of > 0.0 ? part / of : part > 0.0 ? std::numeric_limits<double>::infinity() : 0.0;
  }

  double size_ = 0.0, part_ = 0.0, sum_ = 0.0, part_sum_ = 0.0, square_ = 0.0, part_square_ = 0.0;
  int instants_ = 0;
};

}  // namespace boresight
