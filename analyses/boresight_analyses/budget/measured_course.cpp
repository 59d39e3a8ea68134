#include "boresight_analyses/budget/measured_course.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "boresight/io/content_hash.hpp"
#include "boresight_analyses/budget/between_samples.hpp"
#include "boresight_analyses/budget/course_filter.hpp"

namespace boresight {
namespace {

constexpr std::size_t kStretches = 101;  // that stand for all places in a record

double middle_of(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

const char* to_string(MeasuredCourse::Ends ends) {
  static const char* const names[] = {"refused", "held", "zero", "repeated"};
  return names[static_cast<int>(ends)];
}

const char* to_string(MeasuredCourse::Begin begin) {
  return begin == MeasuredCourse::Begin::anywhere ? "anywhere" : "with the motion";
}

MeasuredCourse::MeasuredCourse(Record record, std::optional<TransferFunction> through, double spacing,
                               std::size_t samples, double start)
    : record_(std::move(record)), through_(std::move(through)), spacing_(spacing), start_(start), samples_(samples) {
  const double duration = spacing * static_cast<double>(samples - 1), first = record_.time.front(),
               last = record_.time.back();
  if (record_.ends == Ends::refused) {
    constexpr double kRounding = 1e-9;
    const double slack = kRounding * (start + duration);
    const bool covers = record_.begin == Begin::anywhere ? length() >= duration - slack
                                                         : first <= start + slack && last >= start + duration - slack;
    if (!covers) throw std::invalid_argument("the record is too short");
  }
  const std::size_t count = record_.begin == Begin::anywhere ? kStretches : 1;
  for (std::size_t k = 0; k < count; ++k)
    stretches_.push_back(history((static_cast<double>(k) + 0.5) / static_cast<double>(count)));
}

double MeasuredCourse::share_between_samples() const {
  const auto whole = static_cast<std::size_t>(length() / spacing_) + 1;
  return boresight::share_between_samples(
      [this](double t) {
        std::array<double, 3> value = {};
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (!record_.value[axis].empty()) value[axis] = at(record_.value[axis], t);
        return value;
      },
      record_.time.front(), spacing_, whole);
}

double MeasuredCourse::at(const std::vector<double>& values, double t) const {
  const std::vector<double>& time = record_.time;
  if (record_.ends == Ends::repeated)
    t = time.front() + (t - time.front()) - length() * std::floor((t - time.front()) / length());
  if (t <= time.front() || t >= time.back()) {
    constexpr double kRounding = 1e-9;
    const bool beyond = t < time.front() - kRounding * length() || t > time.back() + kRounding * length();
    if (beyond && record_.ends == Ends::zero) return 0.0;
    return t <= time.front() ? values.front() : values.back();
  }
  const auto above = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), t) - time.begin());
  const double share = (t - time[above - 1]) / (time[above] - time[above - 1]);
  return values[above - 1] + share * (values[above] - values[above - 1]);
}

std::vector<Vec3> MeasuredCourse::history(double place) const {
  const double duration = spacing_ * static_cast<double>(samples_ - 1);
  double begin = start_;
  if (record_.begin == Begin::anywhere)
    begin =
        record_.time.front() + place * (record_.ends == Ends::repeated ? length() : std::max(0.0, length() - duration));
  // Through a filter in steps no longer than those of the record, from where its transient has died away, or the record begins.
  std::size_t steps = 1, before = 0;
  if (through_) {
    std::vector<double> apart;
    for (std::size_t k = 1; k < record_.time.size(); ++k) apart.push_back(record_.time[k] - record_.time[k - 1]);
    constexpr double kMostSteps = 64.0;
    steps = static_cast<std::size_t>(std::clamp(std::ceil(spacing_ / middle_of(apart)), 1.0, kMostSteps));
    double run_in = CourseFilter::settling_time(*through_);
    if (record_.ends != Ends::repeated) run_in = std::clamp(begin - record_.time.front(), 0.0, run_in);
    constexpr double kMostBefore = 1e6;
    before = static_cast<std::size_t>(std::min(kMostBefore, std::floor(run_in / spacing_)));
  }
  std::vector<Vec3> out(samples_, Vec3::Zero());
  const double step = spacing_ / static_cast<double>(steps);
  for (int axis = 0; axis < 3; ++axis) {
    if (!acts_on(axis)) continue;
    const std::vector<double>& values = record_.value[static_cast<std::size_t>(axis)];
    if (!through_) {
      for (std::size_t k = 0; k < samples_; ++k) out[k][axis] = at(values, begin + spacing_ * static_cast<double>(k));
      continue;
    }
    std::vector<double> course;
    const std::size_t all = steps * (before + samples_ - 1) + 1;
    course.reserve(all);
    for (std::size_t k = 0; k < all; ++k)
      course.push_back(at(values, begin - spacing_ * static_cast<double>(before) + step * static_cast<double>(k)));
    const std::vector<double> seen = CourseFilter(*through_, step).through(course);
    for (std::size_t k = 0; k < samples_; ++k) out[k][axis] = seen[steps * (before + k)];
  }
  return out;
}

double MeasuredCourse::jump() const {
  double largest = 0.0;
  if (record_.ends != Ends::repeated) return largest;
  for (const std::vector<double>& values : record_.value) {
    if (values.empty()) continue;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    if (*high > *low) largest = std::max(largest, std::abs(values.back() - values.front()) / (*high - *low));
  }
  return largest;
}

std::string MeasuredCourse::text() const {
  ContentHash hash;
  const auto add = [&](const std::vector<double>& values) {
    std::string all;
    for (const double v : values) {
      char number[32];
      std::snprintf(number, sizeof number, "%.17g ", v);
      all += number;
    }
    hash.add(all + "\n");
  };
  add(record_.time);
  for (const std::vector<double>& values : record_.value) add(values);
  return std::string("measured ") + hash.hexadecimal() + " " + to_string(record_.ends) + " " +
         to_string(record_.begin) + (through_ ? " " + through_->text() : "");
}

}  // namespace boresight
