// A model of matching whose optimum is known, and a plan that seeks it.
#pragma once

#include <cmath>

#include "boresight_analyses/matching/matching.hpp"

namespace boresight {

// index = 1 + (x - 3)^2 + scatter, free flight = 0.1 + 0.02 (x - 7)^2: accuracy is best at 3, stability at 7.
class Valley final : public SampleModel {
 public:
  explicit Valley(double shift = 0.0, double width = 0.2) : shift_(shift), width_(width) {}
  std::string rung() const override { return "valley"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override { return ""; }
  std::size_t batch() const override { return 1; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes, const std::atomic<bool>&) const override {
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double x = samples[k].values[0], scatter = samples[k].values.size() > 1 ? samples[k].values[1] : 0.0;
      outcomes[k].status = Outcome::Status::done;
      outcomes[k].value = 1.0 + std::pow(x - 3.0 - shift_, 2) + width_ * (scatter - 0.5);
      outcomes[k].motion = {
          .free_flight_share = 0.1 + 0.02 * std::pow(x - 7.0, 2), .impacts_per_second = 1.0, .peak_acceleration = 1.0};
    }
  }

 private:
  double shift_, width_;
};

inline MatchingPlan valley_plan(Over over = Over::nominal) {
  MatchingPlan p;
  DesignVariable v;
  v.paths = {"x"};
  v.si_unit = "1";
  v.from = 0.0;
  v.to = 10.0;
  v.starts = {0.5, 5.0, 9.5};
  p.variables = {v};
  p.objective.over = over;
  p.tolerance = 1e-4;
  p.map = 5;
  p.front = 4;
  if (over != Over::nominal) {
    RandomInputs inputs;
    RandomParameter r;
    r.paths = {"u"};
    r.distribution = make_uniform(0.0, 1.0);
    inputs.parameters.push_back(r);
    p.inputs = inputs;
    p.samples = p.confirm = 40;
  }
  return p;
}

}  // namespace boresight
