#include "boresight_analyses/stability/predictability.hpp"

#include <algorithm>
#include <cmath>

namespace boresight {
namespace {

double relative(double a, double b) { return b != 0.0 ? std::abs(a / b - 1.0) : 0.0; }

}  // namespace

std::vector<Separation> separations(const Mechanism& mechanism, const FollowedMotion& followed,
                                    const std::vector<double>& starts) {
  const Parameters parameters = mechanism.parameters();
  RunOptions options = followed.options(followed.step);
  options.sample_spacing = followed.until / 2000.0;
  const RunResult first = followed.rung->run(parameters, options);
  double clearance = 0.0;
  for (const ClearanceParameters& c : parameters.clearance) clearance = std::max(clearance, c.*carrying_gap(c));

  std::vector<Separation> result;
  for (double start : starts) {
    Parameters other = parameters;
    for (ClearanceParameters& c : other.clearance) c.*carrying_gap(c) *= 1.0 + start;
    const RunResult second = followed.rung->run(other, options);
    Separation s{.start = start, .time = {}, .distance = {}, .horizon = -1.0};
    const std::size_t samples = std::min(first.time.size(), second.time.size());
    for (std::size_t k = 0; k < samples; ++k) {
      const double apart = (first.boresight.samples[k].pose.p - second.boresight.samples[k].pose.p).norm() / clearance;
      s.time.push_back(first.time[k]);
      s.distance.push_back(apart);
      if (s.horizon < 0.0 && apart > kApart) s.horizon = first.time[k];
    }
    s.max_difference = relative(second.index.position_error.max, first.index.position_error.max);
    s.rms_difference = relative(second.index.position_error.rms, first.index.position_error.rms);
    result.push_back(std::move(s));
  }
  return result;
}

}  // namespace boresight
