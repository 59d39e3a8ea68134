#include "boresight_analyses/random/disc_coordinate.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>

namespace boresight {
namespace {

class DiscCoordinate final : public Distribution {
 public:
  DiscCoordinate(double centre, double radius, double sd)
      : centre_(centre), radius_(radius), sd_(sd), exponent_(0.5 * radius * radius / (sd * sd)) {}

  std::string text() const override {
    char text[160];
    std::snprintf(text, sizeof text, "disc coordinate(centre %.17g, radius %.17g, sd %.17g)", centre_, radius_, sd_);
    return text;
  }
  double cdf(double x) const override { return beyond(centre_ - x); }
  double survival(double x) const override { return beyond(x - centre_); }
  double quantile(double u) const override { return centre_ - offset_beyond(u); }
  double upper_quantile(double v) const override { return centre_ + offset_beyond(v); }
  double density(double x) const override { return density_at(x - centre_); }
  double lowest() const override { return centre_ - radius_; }
  double highest() const override { return centre_ + radius_; }
  double mean() const override { return centre_; }
  double sd() const override { return sd_ * std::sqrt(1.0 - exponent_ / std::expm1(exponent_)); }

 private:
  std::shared_ptr<const Distribution> shared() const override { return std::make_shared<DiscCoordinate>(*this); }

  double density_at(double offset) const {
    const double chord = radius_ * radius_ - offset * offset;
    if (chord <= 0.0) return 0.0;
    const double z = offset / sd_, scale = std::numbers::sqrt2 * sd_;
    return std::exp(-0.5 * z * z) * std::erf(std::sqrt(chord) / scale) /
           (std::sqrt(std::numbers::pi) * scale * -std::expm1(-exponent_));
  }
  // P(X - centre > offset): over the angle t with offset = R sin t, in which the density is smooth to its end.
  double beyond(double offset) const {
    if (offset >= radius_) return 0.0;
    if (offset < 0.0) return 1.0 - beyond(-offset);
    return boost::math::quadrature::gauss<double, 30>::integrate(
        [&](double t) { return density_at(radius_ * std::sin(t)) * radius_ * std::cos(t); },
        std::asin(offset / radius_), 0.5 * std::numbers::pi);
  }
  double offset_beyond(double v) const {
    if (v > 0.5) return -offset_beyond(1.0 - v);
    if (v == 0.5) return 0.0;
    if (v <= 0.0) return radius_;
    std::uintmax_t most = 100;
    const auto [a, b] =
        boost::math::tools::toms748_solve([&](double x) { return v - beyond(x); }, 0.0, radius_, v - 0.5, v,
                                          boost::math::tools::eps_tolerance<double>(50), most);
    return 0.5 * (a + b);
  }

  double centre_, radius_, sd_;
  double exponent_;  // R^2 / 2 sd^2
};

}  // namespace

DistributionPtr make_disc_coordinate(double centre, double radius, double sd) {
  return std::make_shared<DiscCoordinate>(centre, radius, sd);
}

}  // namespace boresight
