// The plainest sample model: every sample is one run of a rung. The rung, and with it the scene that it prepares for
// the mechanism, is shared by all samples and threads where no parameter changes the scene; where masses, gravity or
// springs scatter, each thread has a rung of its own, so that none waits for another's scene.
//
// With rk4 all samples are integrated with one step (RunOptions::step): finding a step afresh costs more than a cheap
// rung's whole run. Where a sample proves stiffer than that, its step is halved until it holds, and its message says so.
// An integrator with an error estimate chooses the steps of each sample by its tolerance, as in a single run.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/study/index_choice.hpp"
#include "boresight_analyses/study/sample_model.hpp"

namespace boresight {

// What is kept of each run beside its index: Outcome::history, from histories at this spacing.
struct KeptOfRun {
  double spacing = 0.0;  // [s]; 0: nothing is kept
  std::function<std::vector<double>(const RunResult&)> of = {};
};

class RungSampleModel final : public SampleModel {
 public:
  using ParametersOf = std::function<Parameters(std::span<const double>)>;

  RungSampleModel(std::string rung, std::shared_ptr<const Mechanism> mechanism, ParametersOf parameters_of,
                  IndexChoice index, RunOptions options, bool scene_varies, KeptOfRun kept = {});

  std::string rung() const override { return rung_; }
  double step() const override { return options_.step; }
  std::string leaves_out() const override { return shared_->leaves_out(); }
  std::size_t batch() const override { return 1; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                const std::atomic<bool>& stop) const override;

 private:
  RunResult run(const Rung& rung, const Parameters& parameters, RunOptions options, std::string& message) const;
  void evaluate_one(const Rung& rung, const Sample& sample, Outcome& outcome, const std::atomic<bool>& stop) const;

  std::string rung_;
  std::shared_ptr<const Mechanism> mechanism_;
  ParametersOf parameters_of_;
  IndexChoice index_;
  RunOptions options_;
  bool scene_varies_;
  KeptOfRun kept_;
  std::unique_ptr<Rung> shared_;
  mutable std::mutex mutex_;
  mutable std::vector<std::unique_ptr<Rung>> idle_;  // where the scene varies
};

// The step that suits all of these samples: the smallest that the rung chooses for any of them; 0 where it takes none,
// and where steps follow an error estimate: their mean would be far too long for a contact.
// Throws ComputationError where it can follow none of them. Those whose numbers do not fit together (impossible_numbers()) are left out.
// known: the steps of these samples as far as an earlier start found them, else 0; found(k, step) is told each that is found now, so
// that a study whose motions are long gets on in however short a time.
double common_step(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism,
                   const std::vector<Parameters>& samples, RunOptions options, const std::vector<double>& known = {},
                   const std::function<void(std::size_t, double)>& found = {});

}  // namespace boresight
