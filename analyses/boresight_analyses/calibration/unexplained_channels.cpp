#include "boresight_analyses/calibration/unexplained_channels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace boresight {
namespace {

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// What one channel reads and what the model foretells of it, each from the middle of its run on.
struct Beside {
  std::vector<double> read, foretold;

  double left(std::size_t i) const { return read[i] - foretold[i]; }
  // By the median, which outliers do not reach.
  template <typename Value>
  double size_of(const Value& value) const {
    std::vector<double> sizes;
    for (std::size_t i = 0; i < read.size(); ++i) sizes.push_back(std::abs(value(i)));
    return median_of(std::move(sizes));
  }
  double size_read() const {
    return size_of([&](std::size_t i) { return read[i]; });
  }
  double size_foretold() const {
    return size_of([&](std::size_t i) { return foretold[i]; });
  }
  double size_left() const {
    return size_of([&](std::size_t i) { return left(i); });
  }
};

void append_from_the_middle(const std::vector<double>& values, std::vector<double>& all) {
  const double middle = median_of(values);
  for (const double v : values) all.push_back(v - middle);
}

Beside beside_model(const CalibrationProblem& problem, const Inference& inference, int channel) {
  Beside all;
  for (int run = 0; run < static_cast<int>(problem.runs.size()); ++run) {
    std::vector<double> measured, model;
    for (const ResidualSeries& r : inference.residuals) {
      if (r.run != run || r.channel != channel) continue;
      measured.insert(measured.end(), r.measured.begin(), r.measured.end());
      model.insert(model.end(), r.model.begin(), r.model.end());
    }
    append_from_the_middle(measured, all.read);
    append_from_the_middle(model, all.foretold);
  }
  return all;
}

// How many times the model's motion the readings show, by least squares, and its standard error. Outliers are left out.
struct Gain {
  double value = 1.0, error = 0.0;
};
Gain gain_of(const Beside& all) {
  constexpr double kOutlying = 10.0;
  const double most = kOutlying * all.size_left();
  double mm = 0.0, my = 0.0, yy = 0.0, count = 0.0;
  for (std::size_t i = 0; i < all.read.size(); ++i) {
    if (std::abs(all.left(i)) > most) continue;
    mm += all.foretold[i] * all.foretold[i];
    my += all.foretold[i] * all.read[i];
    yy += all.read[i] * all.read[i];
    count += 1.0;
  }
  constexpr double kFewest = 5.0;
  if (!(mm > 0.0) || count < kFewest) return {};
  return {my / mm, std::sqrt(std::max(0.0, yy - my * my / mm) / (count - 2.0) / mm)};
}

}  // namespace

std::vector<UnexplainedChannel> unexplained_channels(const CalibrationProblem& problem, const Inference& inference) {
  // Of the largest readings of the unit: what is below it is rounding.
  constexpr double kRoundingOfReadings = 1e-6;
  // Readings that show less than half or more than twice the model's motion, by three standard errors, show another one.
  constexpr double kLeastGain = 0.5, kMostGain = 2.0, kErrors = 3.0;
  // A channel that the model explains is not so many times as noisy as another one with the same unit.
  constexpr double kFarNoisier = 10.0, kExplained = 0.9;
  std::vector<Beside> channels;
  for (std::size_t c = 0; c < problem.channels.size(); ++c)
    channels.push_back(beside_model(problem, inference, static_cast<int>(c)));
  const auto name = [&](std::size_t c) { return channel_names()[static_cast<std::size_t>(problem.channels[c])]; };
  std::vector<UnexplainedChannel> found;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const Beside& own = channels[c];
    const double left = own.size_left();
    double largest = 0.0, quietest = left;
    std::size_t quiet = c;
    for (std::size_t other = 0; other < channels.size(); ++other) {
      if (std::string(name(other).si_unit) != name(c).si_unit) continue;
      largest = std::max({largest, channels[other].size_read(), channels[other].size_foretold()});
      const double of_other = channels[other].size_left();
      if (of_other > 0.0 && of_other < quietest) {
        quietest = of_other;
        quiet = other;
      }
    }
    const double least = kRoundingOfReadings * largest, foretold = own.size_foretold();
    if (!(left > least)) continue;
    const Gain gain = gain_of(own);
    char text[320] = "";
    if (foretold > least &&
        (gain.value + kErrors * gain.error < kLeastGain || gain.value - kErrors * gain.error > kMostGain))
      std::snprintf(text, sizeof text,
                    "%s: these readings show %.2g times the motion that the model foretells. Look for a sensor that "
                    "stands still, another axis or sign, or another unit than the header says",
                    name(c).name, gain.value);
    else if (left > kFarNoisier * quietest && 1.0 - std::pow(left / std::max(own.size_read(), left), 2) < kExplained)
      std::snprintf(text, sizeof text,
                    "%s: the model explains hardly anything of these readings; the fit leaves %.2g times as much of "
                    "them as of %s. Look for another unit than the header says, another axis, or a faulty sensor",
                    name(c).name, left / quietest, name(quiet).name);
    else
      continue;
    found.push_back({problem.channels[c], text});
  }
  return found;
}

}  // namespace boresight
