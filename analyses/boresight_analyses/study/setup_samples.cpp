#include "boresight_analyses/study/setup_samples.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "boresight_analyses/study/geometric_sample_model.hpp"
#include "boresight_analyses/study/lane_sample_model.hpp"
#include "boresight_analyses/threads/on_threads.hpp"

namespace boresight {

std::vector<double> typical_errors(const std::vector<Parameters>& samples) {
  std::vector<double> typical;
  for (const Parameters& sample : samples) {
    typical.resize(sample.error.size(), 0.0);
    for (std::size_t e = 0; e < typical.size(); ++e) typical[e] += sample.error[e] * sample.error[e];
  }
  for (double& size : typical) size = std::sqrt(size / static_cast<double>(samples.size()));
  return typical;
}

SetupSamples::SetupSamples(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples,
                           RungSetup setup, const IndexChoice& index, bool scene_varies)
    : setup_(std::move(setup)), outcome_(samples.size()), asked_(samples.size(), false) {
  // A sample's only value is its place in the list.
  const auto parameters_of = [&samples](std::span<const double> values) {
    return samples[static_cast<std::size_t>(values[0])];
  };
  if (setup_.lanes)
    model_ = std::make_unique<LaneSampleModel>(std::move(mechanism), parameters_of, index, scene_varies,
                                               setup_.tolerance > 0.0 ? setup_.tolerance : kLaneTolerance,
                                               typical_errors(samples));
  else if (GeometricSampleModel::serve(setup_.rung, *mechanism))
    model_ = std::make_unique<GeometricSampleModel>(setup_.rung, std::move(mechanism), parameters_of, index,
                                                    typical_errors(samples));
  else
    model_ = std::make_unique<RungSampleModel>(setup_.rung, std::move(mechanism), parameters_of, index,
                                               setup_.options(), scene_varies);
}

bool SetupSamples::compute(const std::vector<std::size_t>& which, int jobs, const std::function<bool()>& advance) {
  std::vector<std::size_t> open;
  for (std::size_t k : which)
    if (!asked_[k]) open.push_back(k);
  if (open.empty()) return true;
  const std::size_t batch = std::max<std::size_t>(1, std::min(model_->batch(), open.size()));
  std::atomic<std::size_t> next{0};
  std::atomic<bool> stop{false};
  const std::thread::id caller = std::this_thread::get_id();  // which alone asks whether to go on
  const auto work = [&] {
    for (;;) {
      if (std::this_thread::get_id() == caller && advance && !advance()) stop = true;
      const std::size_t begin = next.fetch_add(batch);
      if (begin >= open.size() || stop) return;
      const std::size_t count = std::min(batch, open.size() - begin);
      std::vector<double> place(count);
      std::vector<Sample> samples(count);
      std::vector<Outcome> outcomes(count);
      for (std::size_t k = 0; k < count; ++k) {
        place[k] = static_cast<double>(open[begin + k]);
        samples[k] = {open[begin + k], {&place[k], 1}};
      }
      model_->evaluate(samples, outcomes, stop);
      for (std::size_t k = 0; k < count; ++k) outcome_[open[begin + k]] = outcomes[k];
    }
  };
  const std::size_t portions = (open.size() + batch - 1) / batch;
  on_threads(static_cast<int>(std::min<std::size_t>(portions, static_cast<std::size_t>(std::max(1, jobs)))), work,
             [&] { stop = true; });
  for (std::size_t k : open) {
    const Outcome& outcome = outcome_[k];
    spent_ += outcome.cpu_seconds;
    if (outcome.status == Outcome::Status::not_reached) continue;
    asked_[k] = true;
    if (outcome.status != Outcome::Status::failed) continue;
    if (failed_++ == 0) refusal_ = outcome.message.empty() ? "no reason was given" : outcome.message;
  }
  return !stop;
}

std::vector<double> SetupSamples::values(const std::vector<std::size_t>& which) const {
  std::vector<double> values;
  for (std::size_t k : which) values.push_back(value(k));
  return values;
}

double SetupSamples::cpu_seconds() const {
  std::vector<double> cpu;
  for (std::size_t k = 0; k < outcome_.size(); ++k)
    if (asked_[k] && outcome_[k].status == Outcome::Status::done) cpu.push_back(outcome_[k].cpu_seconds);
  if (cpu.empty()) return 0.0;
  const auto middle = cpu.begin() + static_cast<std::ptrdiff_t>((cpu.size() - 1) / 2);
  std::nth_element(cpu.begin(), middle, cpu.end());
  return *middle;
}

double SetupSamples::estimate() const {
  double largest = 0.0;
  for (std::size_t k = 0; k < outcome_.size(); ++k)
    if (asked_[k] && outcome_[k].status == Outcome::Status::done) largest = std::max(largest, outcome_[k].model_error);
  return largest;
}

}  // namespace boresight
