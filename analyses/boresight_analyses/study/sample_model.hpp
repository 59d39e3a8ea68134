// What a study with many samples asks of a model: from the values of the scattered parameters to the index.
//
// Samples come in batches, so that a model may compute several at once (one per SIMD lane); a model says how many it
// likes. Each outcome depends on its own sample alone, whatever it shares a batch with, and evaluate() is called from
// many threads.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace boresight {

struct Sample {
  std::uint64_t number = 0;             // from 0
  std::span<const double> values = {};  // SI, in the order of the study's random parameters
};

// What else a run says of its motion: how steadily the joints hold, how hard they hit.
struct MotionMeasures {
  double free_flight_share = std::numeric_limits<double>::quiet_NaN();   // of the time, of the joint least in contact
  double impacts_per_second = std::numeric_limits<double>::quiet_NaN();  // contacts begun, all joints together [1/s]
  double peak_acceleration =
      std::numeric_limits<double>::quiet_NaN();  // of the boresight body, largest component [m/s^2]
};

struct Outcome {
  enum class Status { done = 0, failed = 1, not_reached = 2 };  // not_reached: stopped before its end
  Status status = Status::not_reached;
  double value = std::numeric_limits<double>::quiet_NaN();  // the index, SI; NaN unless done
  std::string message = {};                                 // why it failed, or what was done that it did not
  double cpu_seconds = 0.0;
  double evaluations =
      0.0;  // of its equations; on lanes steps tried; of errors alone operations. Counted: the same on every machine. Not kept in stores
  double model_error = 0.0;           // what the rung thinks of itself, relative: by what it leaves out
  double discretisation_error = 0.0;  // and by its steps
  MotionMeasures motion = {};         // NaN where the model does not say
  std::vector<double> history = {};   // what else is kept of the motion, in the model's own order; empty for most
};
const char* to_string(Outcome::Status status);

class SampleModel {
 public:
  virtual ~SampleModel() = default;
  virtual std::string rung() const = 0;
  virtual double step() const = 0;  // of its integration [s]; 0: its own choice
  virtual std::string leaves_out() const = 0;
  virtual std::size_t batch() const = 0;  // the number of samples it likes to be given at once: see portion.hpp
  // outcomes.size() == samples.size(). What goes wrong in a sample is an outcome, not an exception; so it is where a mechanism's file
  // could not hold its numbers together. Once `stop` is set it returns soon; samples cut short are then not_reached.
  virtual void evaluate(std::span<const Sample> samples, std::span<Outcome> outcomes,
                        const std::atomic<bool>& stop) const = 0;
  // The same, and tells of every sample that was reached, by its place among `samples`, once its outcome is there: one by one
  // where the model can, else all of them at the end. Told from the thread that called; what `reached` throws is thrown on.
  virtual void evaluate_each(std::span<const Sample> samples, std::span<Outcome> outcomes,
                             const std::atomic<bool>& stop, const std::function<void(std::size_t)>& reached) const {
    evaluate(samples, outcomes, stop);
    for (std::size_t k = 0; k < samples.size(); ++k)
      if (outcomes[k].status != Outcome::Status::not_reached) reached(k);
  }
};

}  // namespace boresight
