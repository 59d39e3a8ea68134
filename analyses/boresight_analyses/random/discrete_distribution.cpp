#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <stdexcept>

#include "boresight_analyses/random/distribution.hpp"

namespace boresight {
namespace {

class Discrete final : public Distribution {
 public:
  Discrete(std::string name, std::vector<double> values, std::vector<double> weights) : name_(std::move(name)) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(total > 0.0)) throw std::domain_error("no probability within the bounds");
    for (const std::size_t k : order) {
      if (weights[k] == 0.0) continue;
      if (!value_.empty() && value_.back() == values[k]) {
        weight_.back() += weights[k] / total;
        continue;
      }
      value_.push_back(values[k]);
      weight_.push_back(weights[k] / total);
    }
    std::partial_sum(weight_.begin(), weight_.end(), std::back_inserter(up_to_));
    up_to_.back() = 1.0;
  }

  std::string text() const override {
    std::string text = name_ + "(";
    char part[80];
    for (std::size_t k = 0; k < value_.size(); ++k) {
      std::snprintf(part, sizeof part, "%s%.17g: %.17g", k ? ", " : "", value_[k], weight_[k]);
      text += part;
    }
    return text + ")";
  }
  double quantile(double u) const override {
    const auto found = std::lower_bound(up_to_.begin(), up_to_.end(), u);
    return value_[std::min<std::size_t>(static_cast<std::size_t>(found - up_to_.begin()), value_.size() - 1)];
  }
  double upper_quantile(double v) const override { return quantile(1.0 - v); }
  double cdf(double x) const override {
    const auto above = std::upper_bound(value_.begin(), value_.end(), x);
    return above == value_.begin() ? 0.0 : up_to_[static_cast<std::size_t>(above - value_.begin()) - 1];
  }
  double survival(double x) const override { return 1.0 - cdf(x); }
  double density(double) const override { return 0.0; }
  double lowest() const override { return value_.front(); }
  double highest() const override { return value_.back(); }
  bool is_discrete() const override { return true; }
  double mean() const override { return std::inner_product(value_.begin(), value_.end(), weight_.begin(), 0.0); }
  double sd() const override {
    const double m = mean();
    double sum = 0.0;
    for (std::size_t k = 0; k < value_.size(); ++k) sum += weight_[k] * (value_[k] - m) * (value_[k] - m);
    return std::sqrt(sum);
  }
  std::shared_ptr<const Distribution> truncated(double low, double high) const override {
    std::vector<double> weights = weight_;
    for (std::size_t k = 0; k < value_.size(); ++k)
      if (value_[k] < low || value_[k] > high) weights[k] = 0.0;
    return std::make_shared<Discrete>(name_, value_, weights);
  }

 private:
  std::shared_ptr<const Distribution> shared() const override { return std::make_shared<Discrete>(*this); }

  std::string name_;
  std::vector<double> value_, weight_, up_to_;  // ascending, each value once
};

}  // namespace

DistributionPtr make_discrete(std::vector<double> values, std::vector<double> probabilities) {
  return std::make_shared<Discrete>("discrete", std::move(values), std::move(probabilities));
}

DistributionPtr make_empirical(std::vector<double> values) {
  std::vector<double> weights(values.size(), 1.0);
  return std::make_shared<Discrete>("empirical", std::move(values), std::move(weights));
}

}  // namespace boresight
