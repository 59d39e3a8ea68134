#include "boresight_analyses/budget/error_course.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace boresight {
namespace {

// What the table needs of a factor or an offset; `fixed`: where nothing scatters it.
struct Spread {
  double mean, sd;
  std::array<double, 2> ends;

  Spread(const DistributionPtr& distribution, double fixed) : mean(fixed), sd(0.0), ends{fixed, fixed} {
    if (!distribution) return;
    const Distribution& d = *distribution;
    mean = d.mean();
    sd = d.sd();
    constexpr double kDeviations = 3.0;  // worst case of a distribution without ends
    ends = {std::isfinite(d.lowest()) ? d.lowest() : mean - kDeviations * sd,
            std::isfinite(d.highest()) ? d.highest() : mean + kDeviations * sd};
  }
};

Moments in_time(const std::vector<Vec3>& a, const std::vector<Vec3>& b, int axis, double factor, double value) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const double e = factor * a[k][axis] + value * b[k][axis];
    sum += e;
    squares += e * e;
  }
  const auto n = static_cast<double>(a.size());
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)))};
}

}  // namespace

std::vector<Vec3> course_of(const ErrorCourse& error, double factor, double value) {
  std::vector<Vec3> out(error.by_value.size(), Vec3::Zero());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = factor * error.by_course[k] + value * error.by_value[k];
  return out;
}

Moments moments(const ErrorCourse& error, int axis, ErrorIndex index, Interpretation interpretation,
                const Windows& windows, double spacing) {
  if (error.by_value.empty()) return {};
  const std::vector<Vec3> a = index_values(index, {spacing, error.by_course}, windows),
                          b = index_values(index, {spacing, error.by_value}, windows);
  const Spread factor(error.factor, 1.0), value(error.value, 0.0);
  if (interpretation == Interpretation::temporal) {
    Moments worst;
    for (const double f : factor.ends)
      for (const double v : value.ends) {
        const Moments m = in_time(a, b, axis, f, v);
        if (std::hypot(m.mean, m.sd) > std::hypot(worst.mean, worst.sd)) worst = m;
      }
    return worst;
  }
  double sum = 0.0, squares = 0.0, largest = -1.0;
  Moments at_largest;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const Moments now{factor.mean * a[k][axis] + value.mean * b[k][axis],
                      std::hypot(factor.sd * a[k][axis], value.sd * b[k][axis])};
    const double square = now.mean * now.mean + now.sd * now.sd;
    sum += now.mean;
    squares += square;
    if (square > largest) largest = square, at_largest = now;
  }
  if (interpretation == Interpretation::ensemble) return at_largest;
  const double mean = sum / static_cast<double>(a.size());
  return {mean, std::sqrt(std::max(0.0, squares / static_cast<double>(a.size()) - mean * mean))};
}

Mat3 covariance_of(const ErrorCourse& error, ErrorIndex index, Interpretation interpretation, const Windows& windows,
                   double spacing) {
  if (error.by_value.empty()) return Mat3::Zero();
  const std::vector<Vec3> a = index_values(index, {spacing, error.by_course}, windows),
                          b = index_values(index, {spacing, error.by_value}, windows);
  const Spread factor(error.factor, 1.0), value(error.value, 0.0);
  const auto with = [&](double f, double v) {
    std::vector<Vec3> out;
    for (std::size_t k = 0; k < a.size(); ++k) out.emplace_back(f * a[k] + v * b[k]);
    return sums_of(out);
  };
  std::vector<MemberSums> members;
  if (interpretation == Interpretation::temporal)
    for (const double f : factor.ends)
      for (const double v : value.ends) members.push_back(with(f, v));
  else  // two values of each, a deviation to both sides of its mean, have the same moments
    for (const double f : {factor.mean - factor.sd, factor.mean + factor.sd})
      for (const double v : {value.mean - value.sd, value.mean + value.sd}) members.push_back(with(f, v));
  return covariance_of(members, interpretation);
}

}  // namespace boresight
