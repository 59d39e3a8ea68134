#include "boresight_analyses/budget/course_filter.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>

namespace boresight {

CourseFilter::CourseFilter(const TransferFunction& function, double step) {
  // With time in steps the coefficients are of one size.
  std::vector<double> b = function.numerator(), a = function.denominator();
  const auto n = static_cast<Eigen::Index>(a.size()) - 1;
  b.resize(a.size(), 0.0);
  for (Eigen::Index k = 0; k <= n; ++k) {
    const double scale = std::pow(step, static_cast<double>(n - k)) / function.denominator().back();
    a[static_cast<std::size_t>(k)] *= scale;
    b[static_cast<std::size_t>(k)] *= scale;
  }
  direct_ = b.back();
  output_ = Eigen::RowVectorXd::Zero(n);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(n + 2, n + 2);
  for (Eigen::Index k = 0; k < n; ++k) {
    if (k + 1 < n) whole(k, k + 1) = 1.0;
    whole(n - 1, k) = -a[static_cast<std::size_t>(k)];
    output_[k] = b[static_cast<std::size_t>(k)] - direct_ * a[static_cast<std::size_t>(k)];
  }
  if (n > 0) whole(n - 1, n) = 1.0;
  whole(n, n + 1) = 1.0;
  const Eigen::MatrixXd over = whole.exp();
  from_state_ = over.topLeftCorner(n, n);
  from_value_ = over.block(0, n, n, 1);
  from_change_ = over.block(0, n + 1, n, 1);
  settled_ = Eigen::VectorXd::Zero(n);
  if (n > 0) settled_[0] = 1.0 / a.front();
}

std::vector<double> CourseFilter::through(const std::vector<double>& course) const {
  std::vector<double> out;
  if (course.empty()) return out;
  out.reserve(course.size());
  Eigen::VectorXd state = settled_ * course.front();
  for (std::size_t k = 0; k < course.size(); ++k) {
    out.push_back(output_.dot(state) + direct_ * course[k]);
    if (k + 1 < course.size())
      state = (from_state_ * state + from_value_ * course[k] + from_change_ * (course[k + 1] - course[k])).eval();
  }
  return out;
}

double CourseFilter::settling_time(const TransferFunction& function) {
  double slowest = std::numeric_limits<double>::infinity();
  for (const std::complex<double>& pole : function.poles()) slowest = std::min(slowest, std::abs(pole.real()));
  const double decades = 6.0 * std::log(10.0);
  return std::isinf(slowest) ? 0.0 : decades / slowest;
}

}  // namespace boresight
