// What samples take that are computed side by side, divided among them as they end: preparing a group of them equally, and following their
// motions by the steps that each of them tried. All that was spent on a group comes to be some sample's, once.
//
//   SharedTime time(clock());
//   time.begin(8, clock(), attempts);                // prepared: eight motions begin
//   outcome.cpu_seconds = time.end(own, attempts, clock());
#pragma once

#include <algorithm>
#include <cstddef>

namespace boresight {

class SharedTime {
 public:
  // now: of any clock of seconds; of attempts: steps tried so far, of all samples together.
  explicit SharedTime(double now) : paid_to_(now) {}

  // What was spent since the group before is what so many samples took to prepare.
  void begin(std::size_t samples, double now, double attempts) {
    for_each_ = unpaid(now) / static_cast<double>(std::max<std::size_t>(1, samples));
    paid_to_ = now;
    paid_attempts_ = attempts;
  }
  // The share of a sample that tried so many steps of its own: of what is not paid for yet, its part of the steps that are not.
  double end(double own, double attempts, double now) {
    const double open = std::max(attempts - paid_attempts_, own);
    const double share = open > 0.0 ? unpaid(now) * own / open : 0.0;
    paid_to_ += share;
    paid_attempts_ += own;
    return for_each_ + share;
  }
  double unpaid(double now) const { return now - paid_to_; }

 private:
  double paid_to_;  // the clock's time, were all that is paid for spent first
  double paid_attempts_ = 0.0, for_each_ = 0.0;
};

}  // namespace boresight
