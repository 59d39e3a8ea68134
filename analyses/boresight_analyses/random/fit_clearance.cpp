#include "boresight_analyses/random/fit_clearance.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>

namespace boresight {
namespace {

DistributionPtr deviation(const ToleranceZone& zone, ZoneLaw law) {
  if (law == ZoneLaw::uniform) return make_uniform(zone.lower, zone.upper);
  return make_normal(0.5 * (zone.lower + zone.upper), (zone.upper - zone.lower) / 6.0)
      ->truncated(zone.lower, zone.upper);
}

// P(c <= x) = int f_S(s) F_H(2 x + s) ds, cut where F_H reaches its ends.
class FitClearance final : public Distribution {
 public:
  FitClearance(const Fit& fit, ZoneLaw law)
      : text_("fit(" + fit.name + ", " + (law == ZoneLaw::uniform ? "uniform" : "normal") + ")"),
        hole_(deviation(fit.hole, law)),
        shaft_(deviation(fit.shaft, law)),
        lowest_(0.5 * fit.least_clearance()),
        highest_(0.5 * fit.largest_clearance()) {}

  std::string text() const override { return text_; }
  double cdf(double x) const override {
    if (x <= lowest_) return 0.0;
    if (x >= highest_) return 1.0;
    return over_the_shaft(x, [&](double s) { return hole_->cdf(2.0 * x + s); });
  }
  double survival(double x) const override {
    if (x <= lowest_) return 1.0;
    if (x >= highest_) return 0.0;
    return over_the_shaft(x, [&](double s) { return hole_->survival(2.0 * x + s); });
  }
  double density(double x) const override {
    if (x <= lowest_ || x >= highest_) return 0.0;
    return 2.0 * over_the_shaft(x, [&](double s) { return hole_->density(2.0 * x + s); });
  }
  double quantile(double u) const override {
    return u <= 0.5 ? root([&](double x) { return cdf(x) - u; }) : upper_quantile(1.0 - u);
  }
  double upper_quantile(double v) const override {
    return v > 0.5 ? quantile(1.0 - v) : root([&](double x) { return v - survival(x); });
  }
  double lowest() const override { return lowest_; }
  double highest() const override { return highest_; }
  std::vector<double> kinks() const override {
    const double hole = hole_->highest() - hole_->lowest(), shaft = shaft_->highest() - shaft_->lowest();
    const double narrow = 0.5 * std::min(hole, shaft);
    if (hole == shaft) return {lowest_ + narrow};
    return {lowest_ + narrow, highest_ - narrow};
  }
  double mean() const override { return 0.5 * (hole_->mean() - shaft_->mean()); }
  double sd() const override { return 0.5 * std::hypot(hole_->sd(), shaft_->sd()); }

 private:
  std::shared_ptr<const Distribution> shared() const override { return std::make_shared<FitClearance>(*this); }

  template <typename Function>
  double over_the_shaft(double x, const Function& of_hole) const {
    std::array<double, 4> cuts = {shaft_->lowest(), hole_->lowest() - 2.0 * x, hole_->highest() - 2.0 * x,
                                  shaft_->highest()};
    for (double& cut : cuts) cut = std::clamp(cut, shaft_->lowest(), shaft_->highest());
    std::sort(cuts.begin(), cuts.end());
    double sum = 0.0;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
      if (cuts[k + 1] > cuts[k])
        sum += boost::math::quadrature::gauss<double, 30>::integrate(
            [&](double s) { return shaft_->density(s) * of_hole(s); }, cuts[k], cuts[k + 1]);
    return sum;
  }
  template <typename Rising>
  double root(const Rising& rising) const {
    double low = lowest_, high = highest_;
    const double at_low = rising(low), at_high = rising(high);
    if (at_low >= 0.0) return low;
    if (at_high <= 0.0) return high;
    std::uintmax_t most = 100;
    const auto [a, b] = boost::math::tools::toms748_solve(rising, low, high, at_low, at_high,
                                                          boost::math::tools::eps_tolerance<double>(48), most);
    return 0.5 * (a + b);
  }

  std::string text_;
  DistributionPtr hole_, shaft_;
  double lowest_, highest_;
};

}  // namespace

DistributionPtr make_fit_clearance(const Fit& fit, ZoneLaw law) { return std::make_shared<FitClearance>(fit, law); }

}  // namespace boresight
