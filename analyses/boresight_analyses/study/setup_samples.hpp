// The index of given samples by one way of computing them, for the pilot and for what a study says of its own error: computed
// as they are asked for, on several threads, and kept.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "boresight_analyses/study/measurement.hpp"
#include "boresight_analyses/study/sample_model.hpp"

namespace boresight {

// The RMS of each standing error over samples [SI].
std::vector<double> typical_errors(const std::vector<Parameters>& samples);

class SetupSamples {
 public:
  // samples must outlive it. scene_varies: whether more than contacts does.
  SetupSamples(std::shared_ptr<const Mechanism> mechanism, const std::vector<Parameters>& samples, RungSetup setup,
               const IndexChoice& index, bool scene_varies);

  const RungSetup& setup() const { return setup_; }
  // Those of `which` that are not there yet. advance: called from this thread between runs; where it returns false the
  // rest is left out and the answer is false.
  bool compute(const std::vector<std::size_t>& which, int jobs, const std::function<bool()>& advance);

  // NaN where it failed or was not computed.
  double value(std::size_t sample) const { return outcome_[sample].value; }
  std::vector<double> values(const std::vector<std::size_t>& which) const;
  // Why the first that failed did; "" if none.
  const std::string& refusal() const { return refusal_; }
  std::size_t failed() const { return failed_; }
  double cpu_seconds() const;  // of one sample: the median, the lower of two: preparing the scene does not count
  double spent_seconds() const { return spent_; }  // on all
  double estimate() const;                         // what the rung thinks it leaves out, relative, the largest

 private:
  RungSetup setup_;
  std::unique_ptr<SampleModel> model_;
  std::vector<Outcome> outcome_;
  std::vector<bool> asked_;
  std::string refusal_;
  std::size_t failed_ = 0;
  double spent_ = 0.0;
};

}  // namespace boresight
