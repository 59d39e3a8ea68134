#include "boresight_analyses/budget/transfer_function.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace boresight {
namespace {

using Polynomial = std::vector<double>;

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial out(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) out[i + j] += a[i] * b[j];
  return out;
}

Polynomial sum(const Polynomial& a, const Polynomial& b) {
  Polynomial out(std::max(a.size(), b.size()), 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) out[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) out[i] += b[i];
  return out;
}

void trim(Polynomial& p) {
  while (p.size() > 1 && p.back() == 0.0) p.pop_back();
}

std::complex<double> value(const Polynomial& p, std::complex<double> s) {
  std::complex<double> out = 0.0;
  for (auto c = p.rbegin(); c != p.rend(); ++c) out = out * s + *c;
  return out;
}

std::size_t zeros_at_zero(const Polynomial& p) {
  return static_cast<std::size_t>(std::find_if(p.begin(), p.end(), [](double c) { return c != 0.0; }) - p.begin());
}

// Eigenvalues of the companion matrix, in units of a frequency that makes its first and last coefficient alike.
std::vector<std::complex<double>> roots(const Polynomial& p) {
  const std::size_t zeros = zeros_at_zero(p);
  const auto n = static_cast<Eigen::Index>(p.size() - 1 - std::min(zeros, p.size() - 1));
  std::vector<std::complex<double>> out(p.size() - 1 - static_cast<std::size_t>(n), 0.0);
  if (n == 0) return out;
  const double scale = std::pow(std::abs(p[zeros] / p.back()), 1.0 / static_cast<double>(n));
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.diagonal(-1).setOnes();
  for (Eigen::Index k = 0; k < n; ++k)
    companion(k, n - 1) =
        -p[zeros + static_cast<std::size_t>(k)] / p.back() * std::pow(scale, static_cast<double>(k - n));
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(companion, false);
  for (Eigen::Index k = 0; k < n; ++k) out.push_back(scale * solver.eigenvalues()[k]);
  return out;
}

}  // namespace

TransferFunction::TransferFunction(std::vector<double> numerator, std::vector<double> denominator)
    : numerator_(std::move(numerator)), denominator_(std::move(denominator)) {
  if (numerator_.empty() || denominator_.empty()) throw std::invalid_argument("no coefficients");
  trim(numerator_);
  trim(denominator_);
  if (denominator_.back() == 0.0) throw std::invalid_argument("a denominator of zeros");
  if (numerator_.size() > denominator_.size())
    throw std::invalid_argument("a numerator of a higher power than the denominator");
}

TransferFunction TransferFunction::first_order(double bandwidth) {
  return TransferFunction({1.0}, {1.0, 1.0 / (2.0 * M_PI * bandwidth)});
}

TransferFunction TransferFunction::second_order(double frequency, double damping) {
  const double w = 2.0 * M_PI * frequency;
  return TransferFunction({w * w}, {w * w, 2.0 * damping * w, 1.0});
}

TransferFunction TransferFunction::sensitivity(double frequency, double damping) {
  const double w = 2.0 * M_PI * frequency;
  return TransferFunction({0.0, 2.0 * damping * w, 1.0}, {w * w, 2.0 * damping * w, 1.0});
}

TransferFunction TransferFunction::closed_on_disturbance() const {
  return TransferFunction(denominator_, sum(numerator_, denominator_));
}

TransferFunction TransferFunction::closed_on_sensor() const {
  return TransferFunction(numerator_, sum(numerator_, denominator_));
}

TransferFunction TransferFunction::operator*(const TransferFunction& second) const {
  return TransferFunction(product(numerator_, second.numerator_), product(denominator_, second.denominator_));
}

std::complex<double> TransferFunction::at(double f) const {
  const std::complex<double> s(0.0, 2.0 * M_PI * f);
  return value(numerator_, s) / value(denominator_, s);
}

double TransferFunction::at_infinity() const {
  return numerator_.size() < denominator_.size() ? 0.0 : numerator_.back() / denominator_.back();
}

double TransferFunction::standing() const { return numerator_.front() / denominator_.front(); }

double TransferFunction::slope() const {
  const auto first = [](const Polynomial& p) { return p.size() > 1 ? p[1] : 0.0; };
  return (first(numerator_) - standing() * first(denominator_)) / denominator_.front();
}

int TransferFunction::order_at_zero() const {
  return static_cast<int>(zeros_at_zero(numerator_)) - static_cast<int>(zeros_at_zero(denominator_));
}

std::vector<std::complex<double>> TransferFunction::poles() const { return roots(denominator_); }

bool TransferFunction::is_stable() const {
  const std::vector<std::complex<double>> all = poles();
  return std::all_of(all.begin(), all.end(), [](const std::complex<double>& p) { return p.real() < 0.0; });
}

std::vector<double> TransferFunction::corners() const {
  std::vector<double> out;
  for (const Polynomial* p : {&numerator_, &denominator_})
    for (const std::complex<double>& root : roots(*p))
      if (std::abs(root) > 0.0) out.push_back(std::abs(root) / (2.0 * M_PI));
  return out;
}

std::string TransferFunction::text() const {
  std::string out = "H";
  for (const Polynomial* p : {&numerator_, &denominator_}) {
    out += " /";
    for (const double c : *p) {
      char number[32];
      std::snprintf(number, sizeof number, " %.17g", c);
      out += number;
    }
  }
  return out;
}

}  // namespace boresight
