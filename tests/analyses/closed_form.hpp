// A sample model whose distribution is known, and plans around it: the sum of independent normal parameters.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <thread>

#include "boresight_analyses/montecarlo/montecarlo.hpp"

namespace boresight {

// x1 + x2, both normal(5, 1): normal(10, sqrt 2). Samples whose x1 is above `fails_above` fail.
class SumModel final : public SampleModel {
 public:
  explicit SumModel(double fails_above = 1e300, std::size_t batch = 1) : fails_above_(fails_above), batch_(batch) {}
  std::string rung() const override { return "sum"; }
  double step() const override { return 0.0; }
  std::string leaves_out() const override { return ""; }
  std::size_t batch() const override { return batch_; }
  void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                const std::atomic<bool>& stop) const override {
    for (std::size_t k = 0; k < samples.size() && !stop; ++k) {
      outcomes[k].status = samples[k].values[0] > fails_above_ ? Outcome::Status::failed : Outcome::Status::done;
      if (outcomes[k].status == Outcome::Status::done)
        outcomes[k].value = samples[k].values[0] + samples[k].values[1];
      else
        outcomes[k].message = "x1 is too large";
      ++evaluated;
    }
  }
  mutable std::atomic<std::uint64_t> evaluated{0};

 private:
  double fails_above_;
  std::size_t batch_;
};

inline MonteCarloPlan sum_plan(std::uint64_t samples, SamplingKind kind = SamplingKind::random,
                               std::uint64_t seed = 1) {
  MonteCarloPlan plan;
  plan.samples = samples;
  plan.design.kind = kind;
  plan.design.seed = seed;
  for (const char* name : {"x1", "x2"}) {
    RandomParameter p;
    p.paths = {name};
    p.si_unit = "1";
    p.distribution = make_normal(5.0, 1.0);
    plan.inputs.parameters.push_back(p);
    plan.inputs.text += std::string(name) + " ~ " + p.distribution->text() + "\n";
  }
  return plan;
}

// A folder of a test's own, empty at first and gone afterwards.
class Folder {
 public:
  // Of this process: tests of the same name run side by side.
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("boresight-" + name + "-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::unique_ptr<SampleStore> open_sum_store(const Folder& folder) {
  return std::make_unique<SampleStore>(folder.path() / "samples.db",
                                       std::map<std::string, std::string>{{"study", "sum"}},
                                       std::vector<std::string>{"x1", "x2"});
}

inline MonteCarloResult run_sum(const SampleModel& model, const MonteCarloPlan& plan, SampleStore& store,
                                const Folder& folder, int jobs = 1, std::function<bool()> interrupted = {}) {
  store.use_rung(model.rung(), model.step());
  const std::unique_ptr<Ranks> alone = Ranks::join();
  return run_montecarlo(model, plan, &store, *alone,
                        {.folder = folder.path(),
                         .facts = {{"study", "sum"}},
                         .jobs = jobs,
                         .progress = {},
                         .interrupted = std::move(interrupted)});
}

}  // namespace boresight
