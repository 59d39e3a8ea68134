#include "boresight_analyses/budget/error_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace boresight {
namespace {

constexpr double kRounding = 1e-9;  // of a duration
// Windows of RPE that begin within the length of one: a step counts for fifteen sixteenths of itself at least, whenever it comes. Fewer,
// down to two, of a history so long that its index would have more values than kMany.
constexpr std::size_t kPlaces = 16, kFewestPlaces = 2, kMany = 400'000;

std::size_t samples_in(double time, double spacing) {
  return static_cast<std::size_t>(std::max(0.0, std::round(time / spacing)));
}

std::size_t whole_samples_in(double time, double spacing) {
  return static_cast<std::size_t>(std::max(0.0, std::floor(time / spacing * (1.0 + kRounding))));
}

// Means over windows of `width` samples from running sums.
class WindowMeans {
 public:
  WindowMeans(const std::vector<Vec3>& values, std::size_t width) : width_(width) {
    sums_.reserve(values.size() + 1);
    sums_.emplace_back(Vec3::Zero());
    for (const Vec3& v : values) sums_.push_back(sums_.back() + v);
  }
  Vec3 from(std::size_t begin) const { return (sums_[begin + width_] - sums_[begin]) / static_cast<double>(width_); }

 private:
  std::size_t width_;
  std::vector<Vec3> sums_;
};

// What the values in a window change by from sample to sample, by the straight line that fits them best; that of more samples about it where
// it has so few that noise alone would make much of one.
Vec3 change_within(const std::vector<Vec3>& values, std::size_t begin, std::size_t width, std::size_t start,
                   std::size_t end) {
  constexpr std::size_t kFewest = 12;
  const std::size_t wide = std::min(std::max(width, kFewest), end - start), more = wide > width ? wide - width : 0;
  const std::size_t first = std::clamp(begin - std::min(begin, more / 2), start, end - wide);
  const double middle = 0.5 * (static_cast<double>(wide) - 1.0);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < wide; ++k) sum += (static_cast<double>(k) - middle) * values[first + k];
  const auto n = static_cast<double>(wide);
  return wide > 1 ? Vec3(sum / (n * (n * n - 1.0) / 12.0)) : Vec3::Zero();
}

}  // namespace

const char* to_string(ErrorIndex index) {
  static const char* const names[] = {"APE", "MPE", "RPE", "PDE", "PRE"};
  return names[static_cast<int>(index)];
}

const char* title_of(ErrorIndex index) {
  static const char* const titles[] = {"absolute performance error", "mean performance error",
                                       "relative performance error", "performance drift error",
                                       "performance reproducibility error"};
  return titles[static_cast<int>(index)];
}

std::string Windows::missing_for(ErrorIndex index, double duration) const {
  if (index == ErrorIndex::ape) return "";
  const double observed = observation_in(duration), slack = kRounding * duration;
  if (window <= 0.0) return "a window";
  if (window > observed + slack) return "a window no longer than an observation";
  if (index == ErrorIndex::pde) {
    if (separation <= 0.0) return "a separation";
    if (separation + window > observed + slack) return "separation and window that fit in one observation";
  }
  if (index == ErrorIndex::pre) {
    if (observation <= 0.0) return "an observation";
    if (revisit_after() < window - slack) return "a revisit of at least the window";
    if (std::max(revisit_after(), observation) + window > duration + slack) return "two observations in the motion";
    // The second window lies as much later in its observation as the revisit is more than whole ones, or an observation less than that.
    const double whole = std::floor(revisit_after() / observed * (1.0 + 1e-12)),
                 later = std::max(0.0, revisit_after() - whole * observed);
    if (!(whole > 0.0 && later + window <= observed + slack) && later < window - slack)
      return "a revisit after which both windows lie within one observation each, such as a whole number of "
             "observations";
  }
  return "";
}

std::vector<Vec3> index_values(ErrorIndex index, const PointingHistory& history, const Windows& windows) {
  // Half a sample is what a history may be shorter than the motion that the windows were chosen for.
  const std::string missing = windows.missing_for(index, history.duration() + (0.5 + kRounding) * history.spacing);
  if (!missing.empty()) throw std::invalid_argument(std::string(to_string(index)) + " needs " + missing);
  const std::vector<Vec3>& e = history.error;
  if (index == ErrorIndex::ape) return e;

  // Lengths in whole samples, rounded; or rounded down, with which fits what fits unrounded.
  const double second = index == ErrorIndex::pde   ? windows.separation
                        : index == ErrorIndex::pre ? windows.revisit_after()
                                                   : 0.0;
  std::size_t width = samples_in(windows.window, history.spacing), apart = samples_in(second, history.spacing),
              observed = samples_in(windows.observation_in(history.duration()), history.spacing);
  const std::size_t there = index == ErrorIndex::pre ? e.size() : std::min(observed, e.size());
  if (std::max(apart, index == ErrorIndex::pre ? observed : 0) + width > there) {
    width = whole_samples_in(windows.window, history.spacing);
    apart = whole_samples_in(second, history.spacing);
    observed = whole_samples_in(windows.observation_in(history.duration()), history.spacing);
  }
  width = std::max<std::size_t>(1, width);
  observed = std::min(e.size(), observed);
  const WindowMeans means(e, width);
  std::vector<Vec3> values;
  if (index == ErrorIndex::pre) {
    const auto whole = [&](std::size_t begin) { return begin / observed == (begin + width - 1) / observed; };
    for (std::size_t begin = 0; begin + apart + width <= e.size(); ++begin)
      if (whole(begin) && whole(begin + apart) && begin / observed != (begin + apart) / observed)
        values.push_back(means.from(begin + apart) - means.from(begin));
    return values;
  }
  const std::size_t places = std::clamp(kMany / std::max<std::size_t>(1, e.size()), kFewestPlaces, kPlaces);
  const std::size_t stride = index == ErrorIndex::rpe ? std::max<std::size_t>(1, width / places) : 1;
  // Samples stand in the middle of their parts of a window, of which its ends are as far away as this.
  const double beyond =
      std::clamp(0.5 * (windows.window / history.spacing - static_cast<double>(width) + 1.0), 0.0, 1.0);
  constexpr std::array<double, 4> kShifts = {1.0, -1.0, 1.0 / 3.0, -1.0 / 3.0};
  std::size_t place = 0;
  for (std::size_t start = 0; start < e.size(); start += observed) {
    const std::size_t end = std::min(start + observed, e.size());
    for (std::size_t begin = start; begin + apart + width <= end; begin += stride) {
      const Vec3 mean = means.from(begin);
      if (index == ErrorIndex::mpe) values.push_back(mean);
      if (index == ErrorIndex::pde) values.push_back(means.from(begin + apart) - mean);
      if (index != ErrorIndex::rpe) continue;
      const Vec3 shift = kShifts[place++ % kShifts.size()] * beyond * change_within(e, begin, width, start, end);
      for (std::size_t k = begin; k < begin + width; ++k) values.push_back(e[k] - mean + shift);
    }
  }
  return values;
}

}  // namespace boresight
