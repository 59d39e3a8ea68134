// What a calibration keeps of what takes it long (fits, looks around, multibody's readings, what the model may be wrong by), each under a key made of all that
// decides it: a start that goes on takes the way of the one before it, and finds what that one computed.
#pragma once

#include <vector>

#include "boresight_analyses/calibration/calibration_fit.hpp"
#include "boresight_analyses/runs/kept_results.hpp"
#include "boresight_analyses/runs/row_checksum.hpp"

namespace boresight {

inline void fields(Numbers& n, Globals& g) { n(g.u, g.time_offset, g.lag, g.bias, g.drift); }
inline void fields(Numbers& n, FitResult& f) {
  n(f.globals, f.windows, f.states, f.start_cost, f.cost, f.iterations, f.evaluations, f.converged, f.interrupted,
    f.reason);
}

class CalibrationKey {
 public:
  // what: the kind of result. Of the problem all that changes during a calibration.
  CalibrationKey(const std::string& what, const CalibrationProblem& problem);

  template <typename... Values>
  CalibrationKey& add(const Values&... values) {
    (sum_.add_all(Numbers::of(values)), ...);
    return *this;
  }
  std::uint64_t value() const { return sum_.value(); }

 private:
  struct Sum {
    Checksum checksum;
    void add_all(const std::vector<double>& numbers) {
      checksum.add(static_cast<std::uint64_t>(numbers.size()));
      for (const double number : numbers) checksum.add(number);
    }
    std::uint64_t value() const { return static_cast<std::uint64_t>(checksum.value()); }
  };
  Sum sum_;
};

}  // namespace boresight
