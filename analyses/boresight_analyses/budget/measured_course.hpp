// An error, or a disturbance that becomes one through a transfer function, as it was measured: values at instants, straight between them.
//
// It goes with the motion, the same in all members; or a member begins anywhere in it, each at a place of its own, so that one long record serves
// an ensemble. What is beyond its ends is refused, held, zero, or the record once more from its beginning.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "boresight/math/types.hpp"
#include "boresight_analyses/budget/transfer_function.hpp"

namespace boresight {

class MeasuredCourse {
 public:
  enum class Ends { refused, held, zero, repeated };
  enum class Begin { with_the_motion, anywhere };
  struct Record {
    std::vector<double> time;                  // rising, two rows at least [s]
    std::array<std::vector<double>, 3> value;  // per axis as many as times; empty where it does not act
    Ends ends = Ends::refused;
    Begin begin = Begin::with_the_motion;
  };
  // The grid of the histories: `samples` instants `spacing` apart from `start` of the motion on [s]. Throws std::invalid_argument where the
  // record is too short for them and its ends are refused.
  MeasuredCourse(Record record, std::optional<TransferFunction> through, double spacing, std::size_t samples,
                 double start);

  // One history; place: of a member in a record that begins anywhere, in (0, 1).
  std::vector<Vec3> history(double place) const;
  // Histories that stand for all of them: the one, or of evenly spread places.
  const std::vector<std::vector<Vec3>>& stretches() const { return stretches_; }

  const Record& record() const { return record_; }
  bool acts_on(int axis) const { return !record_.value[static_cast<std::size_t>(axis)].empty(); }
  double length() const { return record_.time.back() - record_.time.front(); }
  // Where a record that is repeated begins again, the largest jump of an axis over that axis' range; 0 of others.
  double jump() const;
  // Of the record as it is, whatever it passes through: between_samples.hpp.
  double share_between_samples() const;
  // Numbers that equal records have alike, for a hash.
  std::string text() const;

 private:
  double at(const std::vector<double>& values, double t) const;

  Record record_;
  std::optional<TransferFunction> through_;
  double spacing_, start_;
  std::size_t samples_;
  std::vector<std::vector<Vec3>> stretches_;
};

const char* to_string(MeasuredCourse::Ends ends);
const char* to_string(MeasuredCourse::Begin begin);

}  // namespace boresight
