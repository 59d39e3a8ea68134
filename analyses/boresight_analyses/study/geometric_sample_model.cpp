#include "boresight_analyses/study/geometric_sample_model.hpp"

#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "boresight/rungs/cpu_clock.hpp"

namespace boresight {
namespace {

TimeStatistic statistic_of(const IndexChoice& index) {
  if (index.statistic == "max") return TimeStatistic::max;
  if (index.statistic == "rms") return TimeStatistic::rms;
  return index.statistic == "mean" ? TimeStatistic::mean : TimeStatistic::p9973;
}

}  // namespace

GeometricSampleModel::GeometricSampleModel(std::string rung, std::shared_ptr<const Mechanism> mechanism,
                                           RungSampleModel::ParametersOf parameters_of, IndexChoice index,
                                           const std::vector<double>& typical)
    : rung_(std::move(rung)),
      mechanism_(std::move(mechanism)),
      parameters_of_(std::move(parameters_of)),
      geometry_(mechanism_, index.kind(), statistic_of(index), index.start, typical) {}

bool GeometricSampleModel::serve(const std::string& rung, const Mechanism& mechanism) {
  return rung != rung_names().back() && GeometricErrors::serve(mechanism);
}

std::string GeometricSampleModel::leaves_out() const { return make_rung(rung_, mechanism_)->leaves_out(); }

void GeometricSampleModel::evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                                    const std::atomic<bool>& stop) const {
  const double start = thread_cpu_seconds();
  std::vector<Parameters> parameters;
  parameters.reserve(samples.size());
  for (const Sample& sample : samples) parameters.push_back(parameters_of_(sample.values));
  std::vector<GeometricOutcome> found(samples.size());
  const std::size_t done = geometry_.run(parameters, found, &stop);
  const double each = (thread_cpu_seconds() - start) / static_cast<double>(std::max<std::size_t>(1, done));
  for (std::size_t k = 0; k < done; ++k) {
    Outcome& outcome = outcomes[k];
    outcome.cpu_seconds = each;
    outcome.evaluations = geometry_.operations();
    if (!found[k].refusal.empty() || !std::isfinite(found[k].value)) {
      outcome.status = Outcome::Status::failed;
      outcome.message = found[k].refusal.empty() ? "the index is not a finite number" : found[k].refusal;
      continue;
    }
    outcome.value = found[k].value;
    outcome.model_error = found[k].model_error;
    outcome.motion = {.free_flight_share = 0.0, .impacts_per_second = 0.0};
    outcome.status = Outcome::Status::done;
  }
}

}  // namespace boresight
