#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/lognormal.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/triangular.hpp>
#include <boost/math/distributions/uniform.hpp>
#include <boost/math/distributions/weibull.hpp>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <utility>

#include "boresight_analyses/random/distribution.hpp"

namespace boresight {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Number {
  const char* name;
  double value;
};

std::string described(const char* name, std::initializer_list<Number> numbers) {
  std::string text = std::string(name) + "(";
  for (const Number& n : numbers) {
    char part[80];
    std::snprintf(part, sizeof part, "%s%s %.17g", text.back() == '(' ? "" : ", ", n.name, n.value);
    text += part;
  }
  return text + ")";
}

// X = shift + scale * Y with Y one of Boost's.
template <typename Law>
class FromBoost final : public Distribution {
 public:
  FromBoost(Law law, std::string text, double lowest, double highest, std::vector<double> kinks = {},
            double shift = 0.0, double scale = 1.0)
      : law_(std::move(law)),
        text_(std::move(text)),
        lowest_(lowest),
        highest_(highest),
        kinks_(std::move(kinks)),
        shift_(shift),
        scale_(scale) {}

  std::string text() const override { return text_; }
  double quantile(double u) const override { return shift_ + scale_ * boost::math::quantile(law_, u); }
  double upper_quantile(double v) const override {
    return shift_ + scale_ * boost::math::quantile(boost::math::complement(law_, v));
  }
  double cdf(double x) const override {
    return x <= lowest_ ? 0.0 : x >= highest_ ? 1.0 : boost::math::cdf(law_, inner(x));
  }
  double survival(double x) const override {
    return x <= lowest_ ? 1.0 : x >= highest_ ? 0.0 : boost::math::cdf(boost::math::complement(law_, inner(x)));
  }
  double density(double x) const override {
    return x < lowest_ || x > highest_ ? 0.0 : boost::math::pdf(law_, inner(x)) / scale_;
  }
  double lowest() const override { return lowest_; }
  double highest() const override { return highest_; }
  std::vector<double> kinks() const override { return kinks_; }
  double mean() const override { return shift_ + scale_ * boost::math::mean(law_); }
  double sd() const override { return scale_ * boost::math::standard_deviation(law_); }

 private:
  std::shared_ptr<const Distribution> shared() const override { return std::make_shared<FromBoost>(*this); }
  double inner(double x) const { return (x - shift_) / scale_; }

  Law law_;
  std::string text_;
  double lowest_, highest_;
  std::vector<double> kinks_;
  double shift_, scale_;
};

}  // namespace

// In double throughout: the quantile, of which a study with many tolerances takes dozens a sample, costs a third of what it does by
// way of long double, and is within 3 units in the last place of it.
DistributionPtr make_normal(double mean, double sd) {
  using Normal =
      boost::math::normal_distribution<double,
                                       boost::math::policies::policy<boost::math::policies::promote_double<false>>>;
  return std::make_shared<FromBoost<Normal>>(Normal(mean, sd), described("normal", {{"mean", mean}, {"sd", sd}}),
                                             -kInfinity, kInfinity);
}

DistributionPtr make_uniform(double min, double max) {
  return std::make_shared<FromBoost<boost::math::uniform>>(
      boost::math::uniform(min, max), described("uniform", {{"min", min}, {"max", max}}), min, max);
}

DistributionPtr make_lognormal(double median, double factor) {
  return std::make_shared<FromBoost<boost::math::lognormal>>(
      boost::math::lognormal(std::log(median), std::log(factor)),
      described("lognormal", {{"median", median}, {"factor", factor}}), 0.0, kInfinity);
}

DistributionPtr make_triangular(double min, double mode, double max) {
  std::vector<double> kinks;
  if (mode > min && mode < max) kinks.push_back(mode);
  return std::make_shared<FromBoost<boost::math::triangular>>(
      boost::math::triangular(min, mode, max), described("triangular", {{"min", min}, {"mode", mode}, {"max", max}}),
      min, max, kinks);
}

DistributionPtr make_beta(double alpha, double beta, double min, double max) {
  return std::make_shared<FromBoost<boost::math::beta_distribution<>>>(
      boost::math::beta_distribution<>(alpha, beta),
      described("beta", {{"alpha", alpha}, {"beta", beta}, {"min", min}, {"max", max}}), min, max,
      std::vector<double>{}, min, max - min);
}

DistributionPtr make_weibull(double shape, double scale, double location) {
  return std::make_shared<FromBoost<boost::math::weibull>>(
      boost::math::weibull(shape, scale),
      described("weibull", {{"shape", shape}, {"scale", scale}, {"location", location}}), location, kInfinity,
      std::vector<double>{}, location);
}

}  // namespace boresight
