// How a parameter scatters: a distribution in one dimension, known by its quantile function, so that any design on the
// unit
// cube (random, Latin hypercube, Sobol') becomes samples by x = quantile(u).
//
// All values are SI. The functions themselves are Boost.Math's; truncation is exact (the distribution given that the
// value lies within the bounds, not clipped to them), and so are mean and sd of a truncated one, up to rounding.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace boresight {

class Distribution {
 public:
  virtual ~Distribution() = default;
  // "normal(mean 0.0001, sd 1e-05)": name and numbers with all digits; equal texts are equal distributions.
  virtual std::string text() const = 0;
  virtual double quantile(double u) const = 0;        // u in (0, 1)
  virtual double upper_quantile(double v) const = 0;  // the value exceeded with probability v: exact for small v
  virtual double cdf(double x) const = 0;             // P(X <= x)
  virtual double survival(double x) const = 0;        // P(X > x)
  virtual double density(double x) const = 0;         // per unit of x; 0 where the distribution is discrete
  virtual double lowest() const = 0;                  // of the support; may be -infinity
  virtual double highest() const = 0;
  virtual bool is_discrete() const { return false; }
  virtual std::vector<double> kinks() const { return {}; }  // where the density is not smooth, inside the support
  virtual double mean() const;                              // by quadrature of the quantile function, unless overridden
  virtual double sd() const;
  // Given that low <= X <= high. Throws std::domain_error where that has no probability.
  virtual std::shared_ptr<const Distribution> truncated(double low, double high) const;

 protected:
  Distribution() = default;
  Distribution(const Distribution&) = default;

 private:
  virtual std::shared_ptr<const Distribution> shared() const = 0;  // a copy of itself
};

using DistributionPtr = std::shared_ptr<const Distribution>;

DistributionPtr make_normal(double mean, double sd);
DistributionPtr make_uniform(double min, double max);
DistributionPtr make_lognormal(double median, double factor);  // ln X is normal with sd ln(factor)
DistributionPtr make_triangular(double min, double mode, double max);
DistributionPtr make_beta(double alpha, double beta, double min, double max);  // on [min, max]
DistributionPtr make_weibull(double shape, double scale, double location);     // location + scale W
// Values with their probabilities (which need not be sorted, nor add up to one).
DistributionPtr make_discrete(std::vector<double> values, std::vector<double> probabilities);
// Measured values, each as likely as the others: resampled, nothing is put between them.
DistributionPtr make_empirical(std::vector<double> values);

}  // namespace boresight
