#include "boresight_analyses/optimise/design_evaluator.hpp"

#include "boresight_analyses/random/sampling_design.hpp"

namespace boresight {

DesignEvaluator::DesignEvaluator(const SampleModel& model, const RandomInputs* inputs, EvaluationStore* store,
                                 Options options)
    : model_(model), inputs_(inputs), store_(store), options_(std::move(options)) {}

const std::vector<Outcome>& DesignEvaluator::keep(const std::vector<double>& design, std::vector<Outcome> outcomes) {
  for (const Outcome& outcome : outcomes) failures_.see(runs_++, outcome);
  return seen_[design] = std::move(outcomes);
}

const std::vector<Outcome>& DesignEvaluator::at(std::span<const double> design) {
  const std::vector<double> key(design.begin(), design.end());
  if (const auto found = seen_.find(key); found != seen_.end()) return found->second;
  if (store_ != nullptr)
    if (const auto* known = store_->find(design, options_.samples)) {
      ++reused_;
      return keep(key, *known);
    }

  const std::size_t scattered = inputs_ != nullptr ? inputs_->size() : 0, n = options_.samples;
  std::vector<std::vector<double>> values(n, key);
  if (scattered > 0) {
    const SamplingDesign points({.kind = SamplingKind::random, .seed = options_.seed}, static_cast<int>(scattered));
    std::vector<double> point(scattered);
    for (std::size_t k = 0; k < n; ++k) {
      points.point(k, point);
      inputs_->values(point);
      values[k].insert(values[k].end(), point.begin(), point.end());
    }
  }
  std::vector<Outcome> outcomes =
      evaluate_all(model_, values, {.jobs = options_.jobs, .interrupted = options_.interrupted});
  for (const Outcome& outcome : outcomes) cpu_seconds_ += outcome.cpu_seconds;
  ++computed_;
  if (store_ != nullptr) store_->add(design, outcomes);
  const std::vector<Outcome>& kept = keep(key, std::move(outcomes));
  if (options_.landed) options_.landed();
  return kept;
}

}  // namespace boresight
