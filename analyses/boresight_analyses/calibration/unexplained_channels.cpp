#include "boresight_analyses/calibration/unexplained_channels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace boresight {
namespace {

// How far the values of a channel go from the middle of their run, by the median, which outliers do not reach.
struct Sizes {
  double read = 0.0, foretold = 0.0, left = 0.0;
};

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void append_sizes(const std::vector<double>& values, std::vector<double>& sizes) {
  const double middle = median_of(values);
  for (const double v : values) sizes.push_back(std::abs(v - middle));
}

Sizes sizes_of(const CalibrationProblem& problem, const Inference& inference, int channel) {
  std::vector<double> read, foretold, left;
  for (int run = 0; run < static_cast<int>(problem.runs.size()); ++run) {
    std::vector<double> measured, model, residual;
    for (const ResidualSeries& r : inference.residuals) {
      if (r.run != run || r.channel != channel) continue;
      measured.insert(measured.end(), r.measured.begin(), r.measured.end());
      model.insert(model.end(), r.model.begin(), r.model.end());
      for (std::size_t i = 0; i < r.measured.size(); ++i) residual.push_back(r.measured[i] - r.model[i]);
    }
    append_sizes(measured, read);
    append_sizes(model, foretold);
    append_sizes(residual, left);
  }
  return {median_of(read), median_of(foretold), median_of(left)};
}

}  // namespace

std::vector<UnexplainedChannel> unexplained_channels(const CalibrationProblem& problem, const Inference& inference) {
  // Of the largest readings of the unit: what is left below it is rounding.
  constexpr double kRoundingOfReadings = 1e-6;
  // Readings that hold noise beside so much of the model's motion are larger than the noise by a fifth.
  constexpr double kForetells = 0.7;
  // A channel that the model explains is not so many times as noisy as another one with the same unit.
  constexpr double kFarNoisier = 10.0, kExplained = 0.9;
  std::vector<Sizes> sizes;
  for (std::size_t c = 0; c < problem.channels.size(); ++c)
    sizes.push_back(sizes_of(problem, inference, static_cast<int>(c)));
  const auto name = [&](std::size_t c) { return channel_names()[static_cast<std::size_t>(problem.channels[c])]; };
  std::vector<UnexplainedChannel> found;
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    const Sizes& own = sizes[c];
    double largest = 0.0;
    std::size_t quietest = c;
    for (std::size_t other = 0; other < sizes.size(); ++other) {
      if (std::string(name(other).si_unit) != name(c).si_unit) continue;
      largest = std::max({largest, sizes[other].read, sizes[other].foretold});
      if (sizes[other].left > 0.0 && sizes[other].left < sizes[quietest].left) quietest = other;
    }
    if (!(own.left > kRoundingOfReadings * largest)) continue;
    char text[320] = "";
    if (own.left >= own.read && own.foretold >= kForetells * own.left)
      std::snprintf(text, sizeof text,
                    "%s: the model moves as much as the fit leaves of these readings, and explains nothing of them. "
                    "Look for a sensor that stands still, another axis or sign, or another unit than the header says",
                    name(c).name);
    else if (own.left > kFarNoisier * sizes[quietest].left &&
             1.0 - std::pow(own.left / std::max(own.read, own.left), 2) < kExplained)
      std::snprintf(text, sizeof text,
                    "%s: the model explains hardly anything of these readings; the fit leaves %.2g times as much of "
                    "them as of %s. Look for another unit than the header says, another axis, or a faulty sensor",
                    name(c).name, own.left / sizes[quietest].left, name(quietest).name);
    else
      continue;
    found.push_back({problem.channels[c], text});
  }
  return found;
}

}  // namespace boresight
