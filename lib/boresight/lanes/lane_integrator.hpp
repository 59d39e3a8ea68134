// Integrates many samples of the perturbation rung, W at a time: every lane at its own time with its own step, its error
// estimate and its contacts; a lane whose sample is done takes the next one from the list. So a sample that needs small steps
// holds nobody back, and no sample's result depends on what runs beside it.
//
// Per attempt and sample: the scene's numbers, one right-hand side with derivatives, one decomposition, and the stages that
// the method has besides; that is the Step's (lane_row_step.hpp, lane_window_step.hpp). What all lanes do in common is counted in
// tests/benchmarks/README.md.
// Control of the step: Hairer and Wanner (1996), section IV.8, with the exponent 1/4 of methods of order 4(3).
#pragma once

#include "boresight/lanes/lane_clock.hpp"
#include "boresight/lanes/lane_contacts.hpp"
#include "boresight/lanes/lane_courses.hpp"
#include "boresight/lanes/lane_statistics.hpp"

namespace boresight {

// T: lanes of single or double precision.
template <typename T, typename Step>
class LaneIntegrator {
 public:
  static constexpr int W = T::kWidth;
  using Mask = typename T::Mask;

  LaneIntegrator(const LaneJob& first, const LaneSettings& settings)
      : settings_(settings),
        step_(first, settings),
        contacts_(first.scene->layout->joints.size(), first.scene->places),
        z_(step_.numbers()),
        v_(z_),
        new_z_(z_),
        new_v_(z_),
        middle_z_(z_),
        slowest_(z_),
        settled_(z_),
        error_(step_.pairs()),
        tolerance_(error_),
        held_(first.scene->layout->joints.size(), T(0.0)) {
    jobs_of_.fill(nullptr);
  }

  void run(const LaneJob* jobs, long total, LaneOutcome* outcomes) {
    long next = 0;
    int busy = 0;  // lanes with a job
    double attempts = 0.0;
    for (int l = 0; l < W; ++l) {
      scenes_[l] = jobs[0].scene;
      if (next < total) {
        begin(l, jobs[next], outcomes[next]);
        ++next;
        ++busy;
      } else {
        rest(l);
      }
    }
    read_starts(Mask::all(true));
    for (long k = 0; busy > 0; ++k) {
      if (settings_.stop != nullptr && k % kAttemptsPerLook == 0 && settings_.stop->load(std::memory_order_relaxed)) {
        for (int l = 0; l < W; ++l)
          if (jobs_of_[l] != nullptr) outcomes_of_[l]->status = LaneStatus::not_reached;
        for (; next < total; ++next) outcomes[next].status = LaneStatus::not_reached;
        return;
      }
      attempt();
      attempts += busy;
      if (!any(ends_)) continue;
      Mask fresh = Mask::all(false);
      for (int l = 0; l < W; ++l) {
        if (!ends_.lane(l)) continue;
        finish(l);
        if (settings_.ended != nullptr) settings_.ended(settings_.listener, jobs_of_[l] - jobs, attempts);
        if (next < total) {
          begin(l, jobs[next], outcomes[next]);
          ++next;
          fresh.set(l, true);
        } else {
          rest(l);
          --busy;
        }
      }
      if (any(fresh)) read_starts(fresh);
    }
  }

 private:
  int count() const { return step_.count(); }

  void begin(int l, const LaneJob& job, LaneOutcome& outcome) {
    jobs_of_[l] = &job;
    outcomes_of_[l] = &outcome;
    scenes_[l] = job.scene;
    for (int k = 0; k < count(); ++k) {
      z_[k].set(l, job.start ? job.start[k] : 0.0);
      v_[k].set(l, job.start ? job.start[count() + k] : 0.0);
      tolerance_[k].set(l, 1.0 / job.tolerance[k]);
      tolerance_[count() + k].set(l, 1.0 / job.tolerance[count() + k]);
      slowest_[k].set(l, job.tolerance[count() + k] / job.tolerance[k]);
    }
    for (std::size_t c = 0; c < step_.play.at.joints.size(); ++c) {
      set_lane(step_.play.laws[c], l, journal_of(job.joints[c]));
      set_lane(step_.play.acting[c], l, journal_of(job.joints[c]));
      held_[c].set(l, 0.0);
      contacts_.tolerance[c].set(l, job.gap_tolerance[c]);
      contacts_.slowest[c].set(l, job.joints[c].minimum_impact_speed);
    }
    standing_.set(l, job.standing.index);
    errs_[static_cast<std::size_t>(l)] = job.standing.index.knots != nullptr;
    step_.set_loads(l, job.standing.loads, job.standing.longest_step);
    longest_.set(l, std::min(step_.longest(), job.standing.longest_step));
    clock_.set(l, 0.0, job.scene->duration);
    contact_since_.set(l, 0.0);
    h_.set(l, settings_.first_step);
    for (T* x : {&statistics_.value, &statistics_.max, &statistics_.time_of_max, &statistics_.integral,
                 &statistics_.square, &of_play_, &touching_time_, &deepest_, &impacts_, &steps_, &rejected_})
      x->set(l, 0.0);
    entry_.set(l, longest_.lane(l));
    running_.set(l, true);
    rejected_before_.set(l, false);
    entering_.set(l, false);
  }

  // A lane with nothing to do goes through the motions at rest.
  void rest(int l) {
    jobs_of_[l] = nullptr;
    standing_.set(l, {});
    errs_[static_cast<std::size_t>(l)] = false;
    step_.set_loads(l, {}, settings_.longest_step);
    for (int k = 0; k < count(); ++k) {
      z_[k].set(l, 0.0);
      v_[k].set(l, 0.0);
    }
    clock_.set(l, 0.0, 1.0);
    h_.set(l, settings_.first_step);
    running_.set(l, false);
  }

  // Rows and gaps of lanes that stand at the start of their motion.
  void read_starts(const Mask& lanes) {
    step_.open(lanes, scenes_, clock_);
    T standing[3];
    standing_.at(clock_.times(), standing);
    statistics_.begin(lanes, step_.index_here(z_.data(), standing), settings_.start == 0.0);
    step_.contacts(z_.data(), v_.data(), contacts_.end.data());
    for (int l = 0; l < W; ++l)
      if (lanes.lane(l)) contacts_.restart(l, step_.play.impact_speed);
    contacts_.act(step_.play.laws, step_.play.acting);
  }

  void attempt() {
    const int n = count();
    T h = h_;
    clock_.aim(h);
    step_.step(running_, scenes_, clock_, h, z_.data(), v_.data(), new_z_.data(), new_v_.data(), error_.data());
    step_.contacts(new_z_.data(), new_v_.data(), contacts_.end.data());
    if (step_.weighs_rates()) weigh_rates_of_settled_contacts();
    T error(0.0);
    Mask finite = Mask::all(true);
    for (int k = 0; k < 2 * n; ++k) {
      const T scaled = abs(error_[k]) * tolerance_[k];
      finite = finite & is_finite(scaled);
      error = larger(scaled, error);
    }
    const T share = contacts_.first_beginning(h);
    const Mask lands = finite & (share < T(1.0));
    const Mask accepted = running_ & finite & !lands & (error <= T(1.0));
    // The step that this error asks for.
    T factor = T(kSafety) / sqrt(sqrt(larger(error, T(1e-8))));
    factor =
        select(finite, larger(smaller(factor, select(rejected_before_, T(1.0), T(kLargestFactor))), T(kSmallestFactor)),
               T(kSmallestFactor));
    T next = smaller(h * factor, longest_);
    next = select(lands, h * larger(share, T(1e-3)), next);

    observe(accepted, h);
    const Mask was_open = !contacts_.touching();
    T impacts = impacts_;
    const Mask began = contacts_.accept(accepted, step_.play.impact_speed, impacts);
    impacts_ = settings_.start > 0.0 ? select(clock_.now() + h < T(settings_.start), impacts_, impacts) : impacts;
    // The first step into a contact is much shorter than the flight's: remember how long the last one was.
    entry_ = select(accepted & entering_, h, entry_);
    next = select(began, smaller(next, T(kEntryFactor) * entry_), next);
    entering_ = select(accepted, began, entering_);
    steps_ = select(accepted, steps_ + T(1.0), steps_);
    rejected_ = select(accepted, rejected_, rejected_ + T(1.0));
    rejected_before_ = running_ & !accepted;
    h_ = next;
    for (int k = 0; k < n; ++k) {
      z_[k] = select(accepted, new_z_[k], z_[k]);
      v_[k] = select(accepted, new_v_[k], v_[k]);
    }
    step_.accept(accepted);
    contacts_.act(step_.play.laws, step_.play.acting);
    clock_.advance(accepted);
    contact_since_ = select(accepted & (began | was_open), clock_.now(), contact_since_);
    gave_up_ = running_ & ((h_ < T(settings_.smallest_step)) | (steps_ + rejected_ >= T(double(settings_.most_steps))));
    ends_ = (running_ & clock_.ended()) | gave_up_;
  }

  // While a contact begins and ends, an error of a rate lives on in the flight that follows. One that has lasted for tens of its
  // own periods only vibrates: there a rate's error counts by the offset that it leads to. The index sees offsets; what the
  // vibration is worth when the contact ends later on is what kSettledShare stands for.
  void weigh_rates_of_settled_contacts() {
    const int n = count();
    for (int k = 0; k < n; ++k) settled_[k] = error_[n + k];
    const T stiffest = step_.offsets_of_rate_errors(slowest_.data(), settled_.data());
    const Mask settled = contacts_.touching() & ((clock_.now() - contact_since_) * stiffest > T(kSettledAngle));
    for (int k = 0; k < n; ++k)
      error_[n + k] = select(settled, T(1.0 / kSettledShare) * settled_[k] * slowest_[k], error_[n + k]);
  }

  void observe(const Mask& accepted, const T& h) {
    const int n = count();
    for (int k = 0; k < n; ++k) middle_z_[k] = T(0.5) * (z_[k] + new_z_[k]) + T(0.125) * h * (v_[k] - new_v_[k]);
    T middle, end;
    alignas(64) std::array<double, W> halfway;
    clock_.middles(halfway.data());
    T standing_halfway[3], standing_at_end[3];
    standing_.at(halfway.data(), standing_halfway);
    standing_.at(clock_.next(), standing_at_end);
    step_.index_over_step(h, {middle_z_.data(), standing_halfway}, {new_z_.data(), standing_at_end}, middle, end);
    if (settings_.start > 0.0)
      statistics_.add_from(T(settings_.start), accepted, clock_.now(), h, middle, end);
    else
      statistics_.add(accepted, clock_.now(), h, middle, end);
    if (any_errs()) {
      const T none[3] = {T(0.0), T(0.0), T(0.0)};
      of_play_ = select(accepted, larger(of_play_, step_.index_here(new_z_.data(), none)), of_play_);
    }
    touching_time_ = select(accepted & contacts_.touching(), touching_time_ + h, touching_time_);
    const T counted = settings_.start > 0.0 ? larger(T(0.0), smaller(h, clock_.now() + h - T(settings_.start))) : h;
    for (std::size_t c = 0; c < held_.size(); ++c)
      held_[c] = select(accepted & contacts_.touching(c), held_[c] + counted, held_[c]);
    deepest_ = select(accepted, larger(deepest_, contacts_.deepest(h)), deepest_);
  }

  bool any_errs() const {
    bool any = false;
    for (const bool one : errs_) any |= one;
    return any;
  }

  void finish(int l) {
    LaneOutcome& out = *outcomes_of_[l];
    const double t = clock_.now(l);
    out.status = clock_.ended(l)                        ? LaneStatus::done
                 : h_.lane(l) < settings_.smallest_step ? LaneStatus::step_too_small
                                                        : LaneStatus::too_many_steps;
    out.t = t;
    out.max = statistics_.max.lane(l);
    out.time_of_max = statistics_.time_of_max.lane(l);
    out.max_of_play = errs_[static_cast<std::size_t>(l)] ? of_play_.lane(l) : out.max;
    const double counted = t - settings_.start;
    out.mean = counted > 0.0 ? statistics_.integral.lane(l) / counted : 0.0;
    out.mean_square = counted > 0.0 ? statistics_.square.lane(l) / counted : 0.0;
    out.free_flight_share = 0.0;
    for (const T& held : held_)
      if (counted > 0.0) out.free_flight_share = std::max(out.free_flight_share, 1.0 - held.lane(l) / counted);
    out.touching_time = touching_time_.lane(l);
    out.max_penetration = deepest_.lane(l);
    out.impacts = static_cast<long>(impacts_.lane(l));
    out.steps = static_cast<long>(steps_.lane(l));
    out.rejected = static_cast<long>(rejected_.lane(l));
  }

  static constexpr long kAttemptsPerLook = 64;  // well below a millisecond
  static constexpr double kSafety = 0.9, kSmallestFactor = 0.2, kLargestFactor = 4.0, kEntryFactor = 1.5;
  // Measured over the default scene's nine combinations of clearance and load and eight tolerances around kLaneTolerance: steps
  // fall by a fifth and no maximum leaves 1 %; from an angle of 60 or a share of 1 on some do (two peaks of nearly one height).
  static constexpr double kSettledAngle = 200.0, kSettledShare = 1.0 / 3.0;

  LaneSettings settings_;
  Step step_;
  LaneContacts<T> contacts_;
  typename Step::Numbers z_, v_, new_z_, new_v_, middle_z_;
  typename Step::Numbers slowest_, settled_;  // rates' tolerances over offsets' [1/s]
  typename Step::Pairs error_, tolerance_;    // of offsets, then of rates
  std::vector<T> held_;                       // how long each joint touched, from the start of the statistics on [s]
  LaneStatistics<T> statistics_;
  LaneOwnCourses<T> standing_{3};
  LaneClock<T> clock_;
  T h_{1.0}, entry_{1.0}, longest_{1.0};
  std::array<bool, W> errs_{};  // whether the lane's sample has standing errors
  T of_play_{0.0};              // the largest index that the offsets alone would make, where any lane's sample has such
  T contact_since_{0.0}, touching_time_{0.0}, deepest_{0.0}, impacts_{0.0}, steps_{0.0}, rejected_{0.0};
  Mask running_ = Mask::all(false), rejected_before_ = running_, entering_ = running_, gave_up_ = running_,
       ends_ = running_;
  std::array<const LaneJob*, W> jobs_of_;
  std::array<LaneOutcome*, W> outcomes_of_;
  std::array<const LaneScene*, W> scenes_;
};

}  // namespace boresight
