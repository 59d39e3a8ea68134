// A motion's index as a function of some numbers of the mechanism: what optimisers, samplers and other programs call.
//
//   const auto inputs = inputs_named(*mechanism, {"clearance.F1.radial", "clearance.F1.friction.coefficient"});
//   const IndexFunction f(mechanism, inputs, {.index = {"boresight_error", "rms"}, .rung = "perturbation"});
//   const Outcome outcome = f.at(std::vector{1e-4, 0.03});           // from any thread
//   const IndexSlopes slopes = f.slopes_at(std::vector{1e-4, 0.03});
//
// Its values are those of the samples of a study (sample_model.hpp), to the last bit: several samples a register where lanes
// serve, whatever they share it with.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "boresight_analyses/function/function_input.hpp"
#include "boresight_analyses/runs/parallel_evaluation.hpp"
#include "boresight_analyses/sensitivity/index_slopes.hpp"

namespace boresight {

struct FunctionModel {
  IndexChoice index = {};
  std::string rung = "multibody";
  RunOptions run = {};  // step, integrator, tolerance, ...; a step of 0: each point's own
};

class IndexFunction {
 public:
  // Throws ComputationError, OptionRefused.
  IndexFunction(std::shared_ptr<const Mechanism> mechanism, std::vector<FunctionInput> inputs, FunctionModel model);

  const Mechanism& mechanism() const { return *mechanism_; }
  const std::vector<FunctionInput>& inputs() const { return inputs_; }
  const FunctionModel& model() const { return model_; }
  const SampleModel& samples() const { return *samples_; }
  // SI, in the order of the inputs. Throws InputError where an input's path names numbers that differ: no point is that of the file.
  std::vector<double> nominal() const;

  // Of one point [SI]. What goes wrong in its motion is an outcome; stop: it then is not reached. Throws InputError for a point
  // of another size, or a value or values together that the mechanism does not take.
  Outcome at(std::span<const double> point, const std::atomic<bool>& stop = never()) const;
  // Of many, over threads, and on lanes where they serve. Throws besides what evaluate_all() throws.
  std::vector<Outcome> at_all(const std::vector<std::vector<double>>& points, const ParallelEvaluation& options) const;

  // Exact slopes by all inputs (index_slopes.hpp), those of the perturbation rung's motion with its contacts located in time.
  // Throws InputError as at() does, ComputationError, which says why there are none, and Interrupted once stop is set.
  IndexSlopes slopes_at(std::span<const double> point, const std::atomic<bool>& stop = never()) const;
  // Why no point has slopes: another rung, inputs that have none; "": points may have.
  std::string why_no_slopes() const;

  void check(std::span<const double> point) const;  // throws InputError

 private:
  static const std::atomic<bool>& never();
  Parameters parameters_at(std::span<const double> point) const;

  std::shared_ptr<const Mechanism> mechanism_;
  std::vector<FunctionInput> inputs_;
  FunctionModel model_;
  std::unique_ptr<SampleModel> samples_;
};

}  // namespace boresight
