#include "boresight/rungs/measured_by_dynamics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/perturbation.hpp"

namespace boresight {
namespace {

// Of the rung's own step: the second one is as good as the first, the third is finer.
constexpr std::array kShares = {1.0, 0.97, 0.5};
// Steps after which a motion counts as too long to be followed for an estimate, in the looks that a rung
// grants (every 4096).
constexpr int kMostLooks = 1000;
// An error that weighs less than this against the others, on the mechanism's size, is next to nothing.
constexpr double kWeighs = 1e-3;

// The mean over many such motions lies within this many ranges of three of them, with a confidence of 95
// percent: Student's t of two degrees of freedom, 4.303 / sqrt(3), over the mean range of three normal
// draws, 1.693 standard deviations.
constexpr double kOfRange = 1.467;

bool within_twice(double a, double b) {
  return a == b || (a > 0.0 && b > 0.0 && a <= 2.0 * b && b <= 2.0 * a);
}

bool alike(const ClearanceParameters& a, const ClearanceParameters& b) {
  return within_twice(a.radial, b.radial) && within_twice(a.axial, b.axial) &&
         within_twice(a.sleeve_length, b.sleeve_length) &&
         within_twice(1.0 - a.contact.restitution, 1.0 - b.contact.restitution) &&
         within_twice(a.contact.stiffness_scale, b.contact.stiffness_scale) &&
         within_twice(a.contact.young[0], b.contact.young[0]) &&
         within_twice(a.contact.young[1], b.contact.young[1]) &&
         within_twice(a.friction.coefficient, b.friction.coefficient);
}

// Whether what was measured at one holds for the other.
bool alike(const Parameters& a, const Parameters& b) {
  if ((a.gravity - b.gravity).norm() > 0.5 * b.gravity.norm() ||
      !within_twice(a.payload_mass, b.payload_mass))
    return false;
  for (std::size_t k = 0; k < a.body_mass.size(); ++k)
    if (!within_twice(a.body_mass[k], b.body_mass[k])) return false;
  for (std::size_t k = 0; k < a.clearance.size(); ++k)
    if (!alike(a.clearance[k], b.clearance[k])) return false;
  for (std::size_t k = 0; k < a.spring.size(); ++k)
    if (!within_twice(a.spring[k].stiffness, b.spring[k].stiffness) ||
        !within_twice(a.spring[k].damping, b.spring[k].damping))
      return false;
  return true;
}

struct Measured {
  ErrorEstimate error;
  double exceeded =
      0.0;  // by how much the largest position error of the dynamic rung exceeds the static one's, relative
};

class MeasuredByDynamics final : public Rung {
 public:
  MeasuredByDynamics(std::unique_ptr<Rung> rung, std::shared_ptr<const Mechanism> mechanism, bool bounds)
      : rung_(std::move(rung)),
        dynamics_(make_perturbation(mechanism)),
        mechanism_(std::move(mechanism)),
        bounds_(bounds) {}

  std::string name() const override { return rung_->name(); }
  std::string leaves_out() const override { return rung_->leaves_out(); }

  RunResult run(const Parameters& parameters, const RunOptions& options) const override {
    RunResult result = rung_->run(parameters, options);
    if (result.interrupted) return result;
    RunCost cost;
    const Measured measured = measure(parameters, options, result.index, cost);
    result.error = measured.error;
    result.cost.cpu_seconds += cost.cpu_seconds;
    result.cost.wall_seconds += cost.wall_seconds;
    if (bounds_ && measured.exceeded > 0.0) {
      char text[160];
      std::snprintf(text, sizeof text,
                    "impacts exceed the bound, which is one of continuous contact: the perturbation rung's "
                    "largest position error "
                    "is %.2g %% above it",
                    100.0 * measured.exceeded);
      result.warnings.push_back(text);
    }
    return result;
  }

 private:
  Measured measure(const Parameters& parameters, const RunOptions& options, const PointingIndices& index,
                   RunCost& cost) const {
    const Parameters& own = mechanism_->parameters();
    if (!alike(parameters, own)) return against_dynamics(parameters, options, index, cost);
    const std::lock_guard lock(mutex_);
    if (!at_own_ || at_own_start_ != options.start) {
      RunOptions plain;
      plain.start = options.start;
      plain.sample_spacing = 0.0;
      plain.events = false;
      at_own_start_ = options.start;
      at_own_ = against_dynamics(own, options, rung_->run(own, plain).index, cost);
    }
    return *at_own_;
  }

  Measured against_dynamics(const Parameters& parameters, const RunOptions& asked,
                            const PointingIndices& index, RunCost& cost) const {
    RunOptions options;
    options.start = asked.start;
    options.sample_spacing = 0.0;
    options.events = false;
    std::vector<RunResult> motions;
    int looks = 0;
    bool stopped = false;
    options.progress = [&](const RunProgress&) {
      stopped = stopped || ++looks > kMostLooks ||
                (looks % 16 == 0 && asked.progress &&
                 !asked.progress({mechanism_->duration(), mechanism_->duration(), 0.0}));
      return !stopped;
    };
    std::string why_not;
    try {
      for (double share : kShares) {
        motions.push_back(dynamics_->run(parameters, options));
        cost.cpu_seconds += motions.back().cost.cpu_seconds;
        cost.wall_seconds += motions.back().cost.wall_seconds;
        if (stopped) break;
        if (options.step == 0.0)
          options.step = motions[0].end_time / static_cast<double>(motions[0].cost.steps);
        options.step *= kShares[std::min(motions.size(), kShares.size() - 1)] / share;
      }
    } catch (const ComputationError& failure) {
      why_not = failure.what();
    }
    if (stopped) why_not = "following the motion takes too long";
    if (!why_not.empty() || motions.size() < kShares.size())
      return {{1.0, 0.0, "not measured, so anything up to the whole: on the perturbation rung " + why_not},
              0.0};
    return compared(index, motions);
  }

  Measured compared(const PointingIndices& index, const std::vector<RunResult>& motions) const {
    Measured measured;
    measured.error.discretisation = 0.0;  // instants are many
    measured.error.basis =
        "measured against the perturbation rung, which knows impacts, vibration, friction and the start: "
        "largest over maximum, "
        "RMS and mean";
    const double length = mechanism_->characteristic_length();
    std::vector<Statistics PointingIndices::*> quantities = {
        &PointingIndices::position_error, &PointingIndices::orientation_error, &PointingIndices::boresight_error};
    const bool sighted = mechanism_->pointing().line_of_sight.has_value();
    if (sighted) quantities.push_back(&PointingIndices::line_of_sight_error);
    // All on the mechanism's size, so that they weigh against each other [m]. The line of sight weighs against itself alone: how
    // small an angle a displacement is depends on the target's distance.
    const auto unit = [&](Statistics PointingIndices::*quantity) {
      return quantity == &PointingIndices::position_error ? 1.0 : length;
    };
    const auto largest_of = [&](Statistics PointingIndices::*quantity) {
      double largest = 0.0;
      for (const RunResult& motion : motions) largest = std::max(largest, unit(quantity) * (motion.index.*quantity).max);
      return largest;
    };
    double largest_pose = 0.0;
    for (int k = 0; k < 3; ++k) largest_pose = std::max(largest_pose, largest_of(quantities[k]));
    for (const auto quantity : quantities) {
      const double largest = quantity == &PointingIndices::line_of_sight_error ? largest_of(quantity) : largest_pose;
      for (const auto statistic : {&Statistics::max, &Statistics::rms, &Statistics::mean}) {
        double low = 1e300, high = 0.0, sum = 0.0;
        for (const RunResult& motion : motions) {
          const double value = motion.index.*quantity.*statistic;
          low = std::min(low, value);
          high = std::max(high, value);
          sum += value;
        }
        const double mean = sum / static_cast<double>(motions.size());
        const double off = std::abs(index.*quantity.*statistic - mean) + kOfRange * (high - low);
        // What next to nothing is off by counts against the error that is there.
        const double against = unit(quantity) * mean > kWeighs * largest ? mean : largest / unit(quantity);
        if (against > 0.0) measured.error.model = std::max(measured.error.model, off / against);
        if (statistic == &Statistics::max && quantity == quantities[0])
          measured.exceeded = high / (index.*quantity).max - 1.0;
      }
    }
    double own = 0.0;
    for (const RunResult& motion : motions) own = std::max(own, motion.error.model);
    measured.error.model += own;
    return measured;
  }

  std::unique_ptr<Rung> rung_, dynamics_;
  std::shared_ptr<const Mechanism> mechanism_;
  bool bounds_;
  mutable std::mutex mutex_;
  mutable std::optional<Measured> at_own_;
  mutable double at_own_start_ = 0.0;  // of the indices that were measured
};

}  // namespace

std::unique_ptr<Rung> with_error_measured_by_dynamics(std::unique_ptr<Rung> rung,
                                                      std::shared_ptr<const Mechanism> mechanism,
                                                      bool bounds) {
  return std::make_unique<MeasuredByDynamics>(std::move(rung), std::move(mechanism), bounds);
}

}  // namespace boresight
