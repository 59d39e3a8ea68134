#include "boresight/statics/measured_by_dynamics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "boresight/mechanism/error.hpp"
#include "boresight/perturbation/perturbation.hpp"
#include "boresight/play/play_words.hpp"
#include "boresight/pointing/relative_text.hpp"
#include "boresight/rungs/integrator_choice.hpp"

namespace boresight {
namespace {

// Of the rung's own step: the second one is as good as the first, the third is finer.
constexpr std::array kShares = {1.0, 0.97, 0.5};
// Steps after which a motion counts as too long to be followed for an estimate, in the looks that a rung
// grants: every 4096 of rk4, every 64 of an integrator with steps of its own.
constexpr int kMostLooks = 1000;
constexpr double kRounding = 1e-12;  // of a motion in metres [m or rad]
// What is smaller than this share of the largest, on the mechanism's size, is next to nothing: what it is off by counts against the largest.
constexpr double kNextToNothing = 1e-4;
// Where numbers scatter that begin at zero, every sample may stand for itself alone.
constexpr std::size_t kMostKept = 4096;

// The mean over many such motions lies within this many ranges of three of them, with a confidence of 95
// percent: Student's t of two degrees of freedom, 4.303 / sqrt(3), over the mean range of three normal
// draws, 1.693 standard deviations.
constexpr double kOfRange = 1.467;

// What exceeds a bound by less does so by rounding.
constexpr double kExceeds = 1e-6;
// A bound that the pose's curvature may exceed by less is one for all that is built.
constexpr double kBent = 0.05;

bool within_twice(double a, double b) { return a == b || (a > 0.0 && b > 0.0 && a <= 2.0 * b && b <= 2.0 * a); }

// What stands for b: a itself within a factor of two of it, else a by the power of two that comes nearest to b; where a is zero, as a
// payload that comes and goes is, that power itself.
double standing_for(double b, double a) {
  if (within_twice(a, b)) return a;
  if (!(b > 0.0)) return b;
  const double unit = a > 0.0 ? a : 1.0;
  return unit * std::exp2(std::round(std::log2(b / unit)));
}

// What a sample's play is told apart by.
constexpr std::array kSizes = {
    &ClearanceParameters::journal_radius, &ClearanceParameters::cap_radius, &ClearanceParameters::radial,
    &ClearanceParameters::axial,          &ClearanceParameters::width_gap,  &ClearanceParameters::height_gap,
    &ClearanceParameters::sleeve_length,  &ClearanceParameters::pad_radius, &ClearanceParameters::width,
    &ClearanceParameters::height,         &ClearanceParameters::length};

constexpr std::array kOfContact = {&ContactParameters::stiffness_scale, &ContactParameters::linear_stiffness,
                                   &ContactParameters::linear_damping, &ContactParameters::density,
                                   &ContactParameters::minimum_impact_speed};
constexpr std::array kOfFriction = {&FrictionParameters::coefficient,       &FrictionParameters::static_speed,
                                    &FrictionParameters::dynamic_speed,     &FrictionParameters::stribeck_speed,
                                    &FrictionParameters::bristle_stiffness, &FrictionParameters::bristle_damping,
                                    &FrictionParameters::viscosity,         &FrictionParameters::static_coefficient};
constexpr std::array kOfSpring = {&SpringParameters::stiffness, &SpringParameters::damping, &SpringParameters::preload};
// Of lengths that are no sizes, places of a grid stand, of the mechanism's own length: mass centres, springs at rest.
constexpr double kGridOfCentres = 0.1, kGridOfSprings = 0.01;
double standing_for(double b, double a, double grid) { return a + grid * std::round((b - a) / grid); }

ClearanceParameters standing_for(const ClearanceParameters& b, const ClearanceParameters& a) {
  ClearanceParameters p = a;
  for (const auto number : kSizes) p.*number = standing_for(b.*number, a.*number);
  const double lost = standing_for(1.0 - b.contact.restitution, 1.0 - a.contact.restitution);
  p.contact.restitution = lost < 1.0 ? 1.0 - lost : b.contact.restitution;
  for (const auto number : kOfContact) p.contact.*number = standing_for(b.contact.*number, a.contact.*number);
  for (int side = 0; side < 2; ++side) {
    p.contact.young[side] = standing_for(b.contact.young[side], a.contact.young[side]);
    p.contact.poisson[side] = standing_for(b.contact.poisson[side], a.contact.poisson[side]);
  }
  for (const auto number : kOfFriction) p.friction.*number = standing_for(b.friction.*number, a.friction.*number);
  // Numbers that belong together do so still: a peak is no lower than what it decays to.
  const FrictionParameters& f = p.friction;
  if ((f.static_coefficient > 0.0 && f.static_coefficient < f.coefficient) || f.dynamic_speed <= f.static_speed)
    p.friction = b.friction;
  if (p.cap_radius > 0.0 && p.cap_radius <= p.journal_radius + p.radial) {
    p.cap_radius = b.cap_radius;
    p.journal_radius = b.journal_radius;
    p.radial = b.radial;
  }
  return p;
}

// The parameters at which the error of a sample b is measured: the mechanism's own, departed from by factors of two. Standing errors are the
// sample's: where they add to what the play does, or to a load that is next to nothing, hangs on all of them together.
Parameters standing_for(const Parameters& b, const Parameters& a, double length) {
  Parameters p = a;
  const auto centre = [&](const Vec3& of_b, const Vec3& of_a, Vec3& stands) {
    for (int i = 0; i < 3; ++i) stands[i] = standing_for(of_b[i], of_a[i], kGridOfCentres * length);
  };
  centre(b.payload_center, a.payload_center, p.payload_center);
  for (std::size_t k = 0; k < a.body_center.size(); ++k) centre(b.body_center[k], a.body_center[k], p.body_center[k]);
  p.error = b.error;
  if ((b.gravity - a.gravity).norm() > 0.5 * a.gravity.norm()) p.gravity = b.gravity;
  p.payload_mass = standing_for(b.payload_mass, a.payload_mass);
  for (std::size_t k = 0; k < a.body_mass.size(); ++k) p.body_mass[k] = standing_for(b.body_mass[k], a.body_mass[k]);
  for (std::size_t k = 0; k < a.clearance.size(); ++k) p.clearance[k] = standing_for(b.clearance[k], a.clearance[k]);
  for (std::size_t k = 0; k < a.spring.size(); ++k) {
    for (const auto number : kOfSpring) p.spring[k].*number = standing_for(b.spring[k].*number, a.spring[k].*number);
    p.spring[k].free_length = standing_for(b.spring[k].free_length, a.spring[k].free_length, kGridOfSprings * length);
  }
  return p;
}

// The numbers that tell such parameters apart.
std::vector<double> numbers_of(const Parameters& p) {
  std::vector<double> numbers = {p.gravity.x(), p.gravity.y(), p.gravity.z(), p.payload_mass};
  numbers.insert(numbers.end(), p.body_mass.begin(), p.body_mass.end());
  for (const ClearanceParameters& c : p.clearance) {
    for (const auto size : kSizes) numbers.push_back(c.*size);
    for (const auto number : kOfContact) numbers.push_back(c.contact.*number);
    for (const auto number : kOfFriction) numbers.push_back(c.friction.*number);
    numbers.insert(numbers.end(), {c.contact.restitution, c.contact.young[0], c.contact.young[1], c.contact.poisson[0],
                                   c.contact.poisson[1]});
  }
  for (const SpringParameters& s : p.spring) {
    for (const auto number : kOfSpring) numbers.push_back(s.*number);
    numbers.push_back(s.free_length);
  }
  numbers.insert(numbers.end(), p.payload_center.data(), p.payload_center.data() + 3);
  for (const Vec3& center : p.body_center) numbers.insert(numbers.end(), center.data(), center.data() + 3);
  numbers.insert(numbers.end(), p.error.begin(), p.error.end());
  return numbers;
}

PerQuantity all_of_it() {
  PerQuantity whole;
  whole.fill(1.0);
  return whole;
}

struct Measured {
  ErrorEstimate error;
  double exceeded =
      0.0;  // by how much the largest position error of the dynamic rung exceeds the static one's, relative
  PerQuantity of_linearity =
      {};             // what the dynamic rung states for its own model, relative: both are linear in the offsets
  double bent = 0.0;  // the largest of these, of what is more than next to nothing
  bool keeps = true;  // false: its caller wanted it to stop
  bool found = true;  // false: it could not be measured
  std::int64_t evaluations = 0;  // of the dynamic rung, for it
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
    // Without play there are no dynamics that it could miss.
    if (result.interrupted || mechanism_->clearances() == 0) return result;
    RunCost cost;
    // Whoever wants no look at what the model leaves out wants none at what the static one does.
    if (options.model_look == ModelLook::none) {
      result.error = {{}, kNotMeasured, "not looked at"};
      return result;
    }
    const Measured measured = measure(parameters, options, cost);
    if (!measured.keeps) {  // a run without its error is not done
      result.interrupted = true;
      return result;
    }
    const ErrorEstimate of_errors = result.error;
    result.error = measured.error;
    result.error.of_play = of_errors.of_play;
    // With errors both rungs are linear in them, and the dynamic one's statement has been taken in.
    if (bounds_)
      for (int k = 0; k < kPointingQuantities; ++k) {
        // Of the bound of the play, which alone was measured.
        if (measured.found) result.error.model[k] *= of_errors.of_play[k];
        result.error.model[k] += of_errors.model[k];
      }
    if (!of_errors.basis.empty()) result.error.basis += "; " + of_errors.basis;
    result.cost.cpu_seconds += cost.cpu_seconds;
    result.cost.wall_seconds += cost.wall_seconds;
    result.cost.evaluations += cost.evaluations;
    result.cost.shared_evaluations += cost.shared_evaluations;
    if (bounds_ && measured.exceeded > kExceeds) {
      char text[200];
      if (std::isinf(measured.exceeded))
        std::snprintf(text, sizeof text,
                      "the bound is zero, which is one of continuous contact: on the perturbation rung the pose errs");
      else
        std::snprintf(text, sizeof text,
                      "impacts exceed the bound, which is one of continuous contact: the perturbation rung's "
                      "largest position error is %s above it",
                      relative_text(measured.exceeded, 2, "the bound").c_str());
      result.warnings.push_back(text);
    }
    if (bounds_ && measured.bent > kBent) {
      result.warnings.push_back("the bound is linear in the " + parts_in_play(mechanism_->description()).inserts +
                                "' offsets, and the pose is not: errors may exceed it by " +
                                relative_text(measured.bent, 2, "the bound"));
    }
    return result;
  }

 private:
  Measured measure(const Parameters& parameters, const RunOptions& options, RunCost& cost) const {
    Parameters at = standing_for(parameters, mechanism_->parameters(), mechanism_->characteristic_length());
    // A bound holds whatever its journals do: one measure without errors serves all samples.
    if (bounds_) std::fill(at.error.begin(), at.error.end(), 0.0);
    std::vector<double> key = numbers_of(at);
    key.insert(key.end(), {options.start, static_cast<double>(options.model_look)});
    // What samples share is measured once; errors of its own nobody shares, and others need not wait.
    const std::vector<double> none(at.error.size(), 0.0);
    const bool own = at.error != none && at.error != mechanism_->parameters().error;
    std::unique_lock lock(mutex_);
    if (const auto known = measured_.find(key); known != measured_.end()) {
      // Evaluations are those of a rung that has not met the sample, so that what is planned by them is the same however often it ran.
      if (own) cost.evaluations = known->second.evaluations;
      return known->second;
    }
    RunOptions plain;
    plain.start = options.start;
    plain.sample_spacing = 0.0;
    plain.events = false;
    if (own) lock.unlock();
    Measured measured;
    try {
      measured = against_dynamics(at, options, rung_->run(at, plain).index, cost);
    } catch (const ComputationError& failure) {
      // Of what stands for the sample, and not of the sample itself.
      measured = not_measured(std::string("near this sample ") + failure.what());
    }
    if (own) lock.lock();
    if (measured.keeps && measured_.size() < kMostKept) {
      measured.evaluations = cost.evaluations;
      measured_.emplace(std::move(key), measured);
      if (!own) cost.shared_evaluations = cost.evaluations;
    }
    return measured;
  }

  static Measured not_measured(const std::string& why, bool keeps = true) {
    return {
        {all_of_it(), kNotMeasured, "not measured, so anything up to the whole: " + why}, 0.0, {}, 0.0, keeps, false};
  }

  Measured against_dynamics(const Parameters& parameters, const RunOptions& asked, const PointingIndices& index,
                            RunCost& cost) const {
    RunOptions options;
    options.start = asked.start;
    options.sample_spacing = 0.0;
    options.events = false;
    options.model_look = asked.model_look;
    std::vector<RunResult> motions;
    int looks = 0;
    bool stopped = false, asked_to = false;
    options.progress = [&](const RunProgress&) {
      ++looks;
      asked_to = asked_to || (asked.progress && !asked.progress({mechanism_->duration(), mechanism_->duration(), 0.0}));
      stopped = asked_to || looks > kMostLooks;
      return !stopped;
    };
    std::string why_not;
    try {
      for (double share : kShares) {
        motions.push_back(dynamics_->run(parameters, options));
        // Steps of the dynamic rung err too, and where its forces' share says more than what they move, that covers these.
        const bool shares_are_next = motions.size() == 1 && asked.model_look == ModelLook::motions;
        options.model_look = shares_are_next ? ModelLook::shares : ModelLook::none;
        cost.cpu_seconds += motions.back().cost.cpu_seconds;
        cost.wall_seconds += motions.back().cost.wall_seconds;
        cost.evaluations += motions.back().cost.evaluations;
        if (stopped || says_nothing(motions[0])) break;
        const double next = kShares[std::min(motions.size(), kShares.size() - 1)];
        if (const std::string& taken = motions[0].integrator_taken; !taken.empty()) {
          options.integrator = taken;
          options.tolerance = next * kPerturbationTolerance;
          continue;
        }
        if (options.step == 0.0) options.step = motions[0].end_time / static_cast<double>(motions[0].cost.steps);
        options.step *= next / share;
      }
    } catch (const ComputationError& failure) {
      why_not = failure.what();
    }
    if (stopped) why_not = "following the motion takes too long";
    if (!why_not.empty() || (motions.size() < kShares.size() && !says_nothing(motions[0])))
      return not_measured("on the perturbation rung " + why_not, !asked_to);
    return compared(index, motions);
  }

  // Where the dynamic rung may itself be off by the whole, further motions of it tell no more.
  static bool says_nothing(const RunResult& motion) {
    // Of those that every mechanism has.
    for (const auto quantity :
         {PointingQuantity::position_error, PointingQuantity::orientation_error, PointingQuantity::boresight_error})
      if (motion.error.model_of(quantity) < 1.0) return false;
    return true;
  }

  Measured compared(const PointingIndices& index, const std::vector<RunResult>& motions) const {
    Measured measured;
    measured.error.discretisation = kNotMeasured;
    measured.error.basis =
        "measured against the perturbation rung, which knows impacts, vibration, friction and the start: "
        "largest over maximum, "
        "RMS and mean";
    const double length = mechanism_->characteristic_length();
    std::vector<PointingQuantity> quantities = {PointingQuantity::position_error, PointingQuantity::orientation_error,
                                                PointingQuantity::boresight_error};
    const bool sighted = mechanism_->pointing().line_of_sight.has_value();
    if (sighted) quantities.push_back(PointingQuantity::line_of_sight_error);
    // All on the mechanism's size, so that they weigh against each other [m]. The line of sight weighs against itself alone: how
    // small an angle a displacement is depends on the target's distance.
    const auto unit = [&](PointingQuantity quantity) {
      return quantity == PointingQuantity::position_error ? 1.0 : length;
    };
    const auto largest_of = [&](PointingQuantity quantity) {
      double largest = 0.0;
      for (const RunResult& motion : motions)
        largest = std::max(largest, unit(quantity) * motion.index.of(quantity).max);
      return largest;
    };
    PerQuantity of_bound;  // how much of a bound the motions reach: what they miss is a smaller share of that
    of_bound.fill(1.0);
    double largest_pose = 0.0;
    for (int k = 0; k < 3; ++k) largest_pose = std::max(largest_pose, largest_of(quantities[k]));
    for (const auto quantity : quantities) {
      const double largest = quantity == PointingQuantity::line_of_sight_error ? largest_of(quantity) : largest_pose;
      double& model = measured.error.model[static_cast<std::size_t>(quantity)];
      for (const auto statistic : {&Statistics::max, &Statistics::rms, &Statistics::mean}) {
        double low = 1e300, high = 0.0, sum = 0.0;
        for (const RunResult& motion : motions) {
          const double value = motion.index.of(quantity).*statistic;
          low = std::min(low, value);
          high = std::max(high, value);
          sum += value;
        }
        const double mean = sum / static_cast<double>(motions.size());
        const double own = index.of(quantity).*statistic, least = kNextToNothing * largest / unit(quantity);
        const double off = std::abs(own - mean) + kOfRange * (high - low);
        // Relative to what is said, which may be far less than what there is.
        const double against = mean > least ? std::max(std::min(own, mean), least) : largest / unit(quantity);
        if (against > 0.0)
          model = std::max(model, off / against);
        else if (off > kRounding)  // where nothing moves at all, all of it is wrong
          model = std::max(model, 1.0);
        if (bounds_ && statistic == &Statistics::max && own > mean)
          of_bound[static_cast<std::size_t>(quantity)] = mean / own;
        if (statistic == &Statistics::max && quantity == quantities[0] && high > own + kRounding)
          measured.exceeded = own > 0.0 ? high / own - 1.0 : std::numeric_limits<double>::infinity();
      }
    }
    for (const RunResult& motion : motions)
      for (int k = 0; k < kPointingQuantities; ++k)
        measured.of_linearity[k] = std::max(measured.of_linearity[k], motion.error.model[k]);
    for (int k = 0; k < kPointingQuantities; ++k) measured.error.model[k] += measured.of_linearity[k];
    for (const auto quantity : quantities)
      if (unit(quantity) * largest_of(quantity) > kNextToNothing * largest_pose)
        measured.bent = std::max(measured.bent, of_bound[static_cast<std::size_t>(quantity)] *
                                                    measured.of_linearity[static_cast<std::size_t>(quantity)]);
    return measured;
  }

  std::unique_ptr<Rung> rung_, dynamics_;
  std::shared_ptr<const Mechanism> mechanism_;
  bool bounds_;
  mutable std::mutex mutex_;
  // By numbers_of the parameters, the index's start and how closely the dynamic rung looks at its own model.
  mutable std::map<std::vector<double>, Measured> measured_;
};

}  // namespace

std::unique_ptr<Rung> with_error_measured_by_dynamics(std::unique_ptr<Rung> rung,
                                                      std::shared_ptr<const Mechanism> mechanism, bool bounds) {
  return std::make_unique<MeasuredByDynamics>(std::move(rung), std::move(mechanism), bounds);
}

}  // namespace boresight
