// Truncation and moments that hold for any continuous distribution.
#include <algorithm>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "boresight_analyses/random/distribution.hpp"

namespace boresight {
namespace {

// X given low <= X <= high: F_t(x) = (F(x) - F(low)) / (F(high) - F(low)). Counted from whichever tail is nearer, so
// that a cut far out in a tail keeps its digits.
class Truncated final : public Distribution {
 public:
  Truncated(DistributionPtr whole, double low, double high)
      : whole_(std::move(whole)),
        low_(std::max(low, whole_->lowest())),
        high_(std::min(high, whole_->highest())),
        below_(whole_->cdf(low_)),
        above_(whole_->survival(high_)),
        inside_(below_ > 0.5 ? whole_->survival(low_) - above_ : whole_->cdf(high_) - below_) {
    if (!(inside_ > 0.0)) throw std::domain_error("no probability within the bounds");
  }

  std::string text() const override {
    char bounds[80];
    std::snprintf(bounds, sizeof bounds, ", truncated to [%.17g, %.17g]", low_, high_);
    return whole_->text() + bounds;
  }
  double quantile(double u) const override { return at(u, 1.0 - u); }
  double upper_quantile(double v) const override { return at(1.0 - v, v); }
  double cdf(double x) const override {
    if (x <= low_) return 0.0;
    if (x >= high_) return 1.0;
    return from_above() ? 1.0 - (whole_->survival(x) - above_) / inside_ : (whole_->cdf(x) - below_) / inside_;
  }
  double survival(double x) const override {
    if (x <= low_) return 1.0;
    if (x >= high_) return 0.0;
    return whole_->cdf(x) > 0.5 ? (whole_->survival(x) - above_) / inside_ : 1.0 - (whole_->cdf(x) - below_) / inside_;
  }
  double density(double x) const override { return x < low_ || x > high_ ? 0.0 : whole_->density(x) / inside_; }
  double lowest() const override { return low_; }
  double highest() const override { return high_; }
  std::vector<double> kinks() const override {
    std::vector<double> inside;
    for (const double kink : whole_->kinks())
      if (kink > low_ && kink < high_) inside.push_back(kink);
    return inside;
  }

 private:
  std::shared_ptr<const Distribution> shared() const override { return std::make_shared<Truncated>(*this); }
  bool from_above() const { return below_ > 0.5; }
  double at(double u, double v) const {
    const double p = below_ + u * inside_;
    return std::clamp(p > 0.5 ? whole_->upper_quantile(above_ + v * inside_) : whole_->quantile(p), low_, high_);
  }

  DistributionPtr whole_;
  double low_, high_;
  double below_, above_, inside_;  // probabilities of the whole one
};

// Integral of g(quantile(u)) over u in (0, 1), split where the quantile function is not smooth.
template <typename Function>
double expectation(const Distribution& x, const Function& g) {
  std::vector<double> cuts = {0.0};
  for (const double kink : x.kinks()) cuts.push_back(x.cdf(kink));
  if (cuts.size() == 1) cuts.push_back(x.cdf(x.quantile(0.5)));  // both ends are then approached from their own side
  cuts.push_back(1.0);
  boost::math::quadrature::tanh_sinh<double> rule;
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double a = cuts[k], b = cuts[k + 1];
    if (!(b > a)) continue;
    const bool last = k + 2 == cuts.size();
    // The second argument is the distance to the nearer end, exact where the first one has rounded to it.
    sum += rule.integrate(
        [&](double u, double to_end) {
          return g(last && u > 0.5 * (a + b) ? x.upper_quantile(std::abs(to_end)) : x.quantile(u));
        },
        a, b);
  }
  return sum;
}

}  // namespace

double Distribution::mean() const {
  return expectation(*this, [](double x) { return x; });
}

double Distribution::sd() const {
  const double m = mean();
  return std::sqrt(expectation(*this, [m](double x) { return (x - m) * (x - m); }));
}

std::shared_ptr<const Distribution> Distribution::truncated(double low, double high) const {
  return std::make_shared<Truncated>(shared(), low, high);
}

}  // namespace boresight
