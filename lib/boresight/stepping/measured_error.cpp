#include "boresight/stepping/measured_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <vector>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {
namespace {

constexpr std::array kQuantities = {&PointingIndices::position_error, &PointingIndices::orientation_error,
                                    &PointingIndices::boresight_error, &PointingIndices::line_of_sight_error};
constexpr std::array kStatistics = {&Statistics::max, &Statistics::rms, &Statistics::mean, &Statistics::p9973};

// The second and third neighbour, and further ones for those that cannot be followed: near the largest stable step it is chance which can.
constexpr double kNeighbours[] = {0.985, 0.97, 0.955, 0.94, 0.91, 0.88};
constexpr double kFinerStep = 0.5;
// Steps grow with the fourth or fifth root of the tolerance, and what they step over hides at a tenth of it too: there motions agreed that
// were off by four times what they stated.
constexpr double kFinerTolerance = 0.01;
// What a method damps of fast modes it damps at finer tolerances too, over decades of them: another one shows it.
constexpr const char *kDamping = "generalized-alpha", *kUndamped = "rosenbrock";
// How much more a finer run costs: twice the steps, or what a method of third order takes for its tolerance.
constexpr double kCostOfFinerStep = 2.0, kCostOfFinerTolerance = 3.2;
// A neighbour is followed, to learn what further runs take, where twice the time of the run is in the time for them.
constexpr double kTriedForItsCost = 2.0;
// What further runs may take of the time for them, where one turns out dearer than foreseen.
constexpr double kOverrun = 2.0;
// Rounding of a motion integrated in metres [m or rad].
constexpr double kRounding = 1e-12;
// Where the first three runs agree to this share of an index, further ones are not worth their time.
constexpr double kAgreed = 1e-3;
// What three runs that agree say of the rest: twice their range, for an error of first order in the step is twice what
// half the step shows.
constexpr double kOfRange = 2.0;
// Implicit methods step over a contact's vibration that is smaller than the tolerance, and finer tolerances that still do show nothing of
// it. It is a share of the clearances, as the indices are, and may stand to either side.
constexpr double kOfTolerance = 2.0;
// Few runs that do not agree, and no time or no neighbour for more: of three draws of one distribution the next one lies
// beyond three ranges in less than one case out of twenty.
constexpr double kOfScatteredRange = 3.0;
// Student's t at 97.5 percent, four degrees of freedom: two groups of three.
constexpr double kStudent4 = 2.776;

// What a run says of a motion.
struct Followed {
  explicit Followed(const RunResult& run)
      : index(run.index), peaks(run.peaks), acceleration(run.platform_acceleration_max) {
    for (const ContactSummary& contact : run.contact) force.push_back(contact.max_force);
  }
  PointingIndices index;
  PeaksOfParts peaks;
  std::vector<double> force;
  Vec3 acceleration;
};

// Further runs took more than kOverrun times what they may.
class OutOfTime {};

class FurtherRuns {
 public:
  FurtherRuns(const Rung& rung, const Parameters& parameters, const RunOptions& options, const RunResult& result,
              const MeasureErrorOptions& measure)
      : rung_(rung),
        parameters_(parameters),
        options_(options),
        measure_(measure),
        longest_(options.share_of_longest_step) {
    options_.sample_spacing = 0.0;
    options_.frame_spacing = 0.0;
    options_.events = false;
    options_.pose_bodies.clear();
    options_.progress = [this](const RunProgress&) {
      stopped_ = stopped_ || (measure_.advance && !measure_.advance());
      // Steps that follow what grows may be far shorter than those of the run.
      const double run = thread_cpu_seconds() - began_, most = measure_.most_seconds;
      too_long_ = options_.follow_growth && most > 0.0 && run > most;
      // And what runs on end take is foreseen from one of them.
      out_of_time_ = most > 0.0 && cpu_seconds + run > kOverrun * most;
      return !stopped_ && !too_long_ && !out_of_time_;
    };
    options_.model_look = ModelLook::none;
    if (options.integrator.empty()) options_.integrator = result.integrator_taken;
    integrator_ = options_.integrator;
    by_instants_ = integrator_names(rung.name()).empty();
    if (by_instants_) return;
    by_tolerance_ = controls_error(options_);
    damps_ = by_tolerance_ && integrator_ == kDamping;
    tolerance_ = by_tolerance_ ? tolerance_of(options_, rung.name()) : 0.0;
    // Steps that locate contacts are shortened by these: what was asked for counts, not their mean.
    step_ = by_tolerance_        ? 0.0
            : options.step > 0.0 ? options.step
                                 : result.end_time / static_cast<double>(result.cost.steps);
  }

  // share: of the run's own step or tolerance, or of the finer one. The longest step that a tolerance may choose goes with it: where that
  // bounds the steps, another tolerance alone changes nothing, whatever they leave out.
  Followed at(double share, bool finer = false) {
    options_.step = share * (finer ? kFinerStep : 1.0) * step_;
    options_.tolerance = share * (finer ? kFinerTolerance : 1.0) * tolerance_;
    options_.share_of_longest_step = share * (finer ? kFinerStep : 1.0) * longest_;
    options_.follow_growth = finer && by_tolerance_ && follows_;
    options_.integrator = finer && damps_ ? kUndamped : integrator_;
    out_of_time_ = false;
    began_ = thread_cpu_seconds();
    const RunResult result = rung_.run(parameters_, options_);
    if (out_of_time_ && !too_long_ && !stopped_) {
      cpu_seconds += thread_cpu_seconds() - began_;
      throw OutOfTime();
    }
    last_cpu_seconds = result.cost.cpu_seconds;
    cpu_seconds += last_cpu_seconds;
    ++runs;
    if (too_long_) {
      too_long_ = follows_ = false;
      return at(share, finer);
    }
    if (result.interrupted || stopped_) throw ComputationError("it was stopped");
    return Followed(result);
  }

  bool out_of_time() const { return out_of_time_; }

  // The next neighbour that can be followed, if there is one.
  void add_neighbour(std::vector<Followed>& to) {
    while (next_ < std::size(kNeighbours) && !out_of_time_ && !add_followed(to, kNeighbours[next_++], false)) {
    }
  }
  // Whether it could be followed.
  bool add_followed(std::vector<Followed>& to, double share, bool finer) {
    try {
      to.push_back(at(share, finer));
      return true;
    } catch (const UnstableStep&) {
    } catch (const StepFailed&) {
    } catch (const SingularPose&) {  // what a motion that blows up may meet on its way
    } catch (const OutOfTime&) {     // this once: the next one would be as dear
    }
    return false;
  }

  int runs = 0;
  double cpu_seconds = 0.0, last_cpu_seconds = 0.0;
  // What a step may leave out unseen, over the smallest clearance; 0 where steps are given.
  double tolerance() const { return tolerance_; }
  bool by_instants() const { return by_instants_; }
  // Whether vibrations that grow were followed as they do, where steps are by an error estimate.
  bool follows() const { return follows_; }
  double cost_of_finer() const { return by_tolerance_ ? kCostOfFinerTolerance : kCostOfFinerStep; }
  const char* neighbours() const {
    return by_instants_ ? "spacings of instants" : by_tolerance_ ? "tolerances" : "steps";
  }
  const char* neighbour() const { return by_instants_ ? "spacing of instants" : by_tolerance_ ? "tolerance" : "step"; }
  const char* fineness() const {
    return by_instants_    ? "half the spacing of instants"
           : damps_        ? "a hundredth of the tolerance and half the longest step, by rosenbrock"
           : by_tolerance_ ? "a hundredth of the tolerance and half the longest step"
                           : "half the step";
  }

 private:
  const Rung& rung_;
  const Parameters& parameters_;
  RunOptions options_;
  const MeasureErrorOptions& measure_;
  double longest_;
  bool by_instants_ = false, by_tolerance_ = false, stopped_ = false, too_long_ = false, out_of_time_ = false;
  bool follows_ = true, damps_ = false;
  std::string integrator_;
  double began_ = 0.0;
  double step_ = 0.0, tolerance_ = 0.0;
  std::size_t next_ = 0;
};

double range(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double squares(const std::vector<double>& values) {
  const double m = mean(values);
  double sum = 0.0;
  for (double v : values) sum += (v - m) * (v - m);
  return sum;
}

// Calls each(quantity, statistic) for every index.
template <typename Each>
void for_each_index(const Each& each) {
  for (const auto quantity : kQuantities)
    for (const auto statistic : kStatistics) each(quantity, statistic);
}

std::vector<double> of(const std::vector<Followed>& runs, Statistics PointingIndices::*quantity,
                       double Statistics::*statistic) {
  std::vector<double> values;
  for (const Followed& r : runs) values.push_back(r.index.*quantity.*statistic);
  return values;
}

// The largest values in parts first to last.
std::vector<double> peaks_of(const std::vector<Followed>& runs, std::size_t quantity, int first, int last) {
  std::vector<double> values;
  for (const Followed& r : runs) {
    const auto& peaks = r.peaks[quantity];
    values.push_back(
        *std::max_element(peaks.begin() + std::max(first, 0), peaks.begin() + std::min(last, kPeakParts - 1) + 1));
  }
  return values;
}

bool all_agree(const std::vector<Followed>& runs) {
  bool agree = true;
  for_each_index([&](auto quantity, auto statistic) {
    const std::vector<double> values = of(runs, quantity, statistic);
    agree = agree && range(values) <= std::max(kRounding, kAgreed * std::abs(values.front()));
  });
  return agree;
}

}  // namespace

MeasuredError measure_discretisation(const Rung& rung, const Parameters& parameters, const RunOptions& options,
                                     const RunResult& result, const MeasureErrorOptions& measure) {
  MeasuredError error;
  // A rung states nothing of its own steps or instants; it states 0 where no play can move and there are none.
  if (result.error.discretisation == 0.0) {
    error.measured = true;
    error.basis = "no play can move, so there are no steps to err";
    error.stated.has_line_of_sight = error.spread.has_line_of_sight = error.shift.has_line_of_sight =
        result.index.has_line_of_sight;
    return error;
  }
  if (result.interrupted || result.cost.steps == 0) {
    error.why_not = "the motion was not followed to its end";
    return error;
  }
  FurtherRuns further(rung, parameters, options, result, measure);
  // One neighbour and one finer run; two and three where these do not agree. What the run took may be its look at its own model for the
  // most part, which further runs do without: the first neighbour tells.
  const double first_stage = 1.0 + further.cost_of_finer();
  double one = result.cost.cpu_seconds;
  char text[200];
  const auto fits = [&](double seconds) { return measure.most_seconds <= 0.0 || seconds <= measure.most_seconds; };
  const auto too_dear = [&] {
    std::snprintf(text, sizeof text, "further runs would take %.3g s of CPU, more than the %.3g s that they may",
                  first_stage * one, measure.most_seconds);
    error.why_not = text;
    return error;
  };
  if (!fits(kTriedForItsCost * one)) return too_dear();
  std::vector<Followed> own = {Followed(result)}, finer;
  bool settled = false, whole = false;
  try {
    further.add_neighbour(own);
    if (further.runs > 0) one = std::min(one, further.last_cpu_seconds);
    if (!fits(first_stage * one)) return too_dear();
    finer.push_back(further.at(1.0, true));
    settled = own.size() > 1 && all_agree({own[0], own[1], finer[0]});
    if (!settled && fits(further.cpu_seconds + one + 2.0 * further.last_cpu_seconds)) {
      further.add_neighbour(own);
      for (const double share : {kNeighbours[0], kNeighbours[1]})
        if (!further.out_of_time()) further.add_followed(finer, share, true);
    }
    whole = own.size() == 3 && finer.size() == 3;
  } catch (const OutOfTime&) {
    std::snprintf(text, sizeof text, "further runs take more than %.3g s of CPU", kOverrun * measure.most_seconds);
    error.why_not = text;
  } catch (const ComputationError& failure) {
    error.why_not = std::string("a further run failed: ") + failure.what();
  }
  error.runs = further.runs;
  error.cpu_seconds = further.cpu_seconds;
  error.by_instants = further.by_instants();
  if (!error.why_not.empty()) return error;

  error.measured = true;
  for (PointingIndices* indices : {&error.stated, &error.spread, &error.shift})
    indices->has_line_of_sight = result.index.has_line_of_sight;
  struct Said {
    double stated, spread, shift;
  };
  const auto said_of = [&](const std::vector<double>& x, const std::vector<double>& y) {
    const double shift = std::abs(mean(x) - mean(y));
    if (whole) {
      const double n = static_cast<double>(x.size());
      const double spread = std::sqrt((squares(x) + squares(y)) / (2.0 * n - 2.0));
      const bool stands_out = shift > kStudent4 * spread * std::sqrt(2.0 / n);
      return Said{
          std::abs(x[0] - mean(x)) + (stands_out ? 2.0 : 1.0) * shift + kStudent4 * spread * std::sqrt(1.0 + 1.0 / n),
          spread, shift};
    }
    std::vector<double> values = x;
    values.insert(values.end(), y.begin(), y.end());
    // What agrees does not scatter.
    const double spread = settled || x.size() < 2 ? 0.0 : std::abs(x[0] - x[1]) / std::sqrt(2.0);
    return Said{(settled ? kOfRange : kOfScatteredRange) * range(values), spread, shift};
  };
  for_each_index([&](auto quantity, auto statistic) {
    const std::vector<double> x = of(own, quantity, statistic), y = of(finer, quantity, statistic);
    const Said said = said_of(x, y);
    error.stated.*quantity.*statistic = std::max(said.stated, kOfTolerance * further.tolerance() * std::abs(x[0]));
    error.spread.*quantity.*statistic = said.spread;
    error.shift.*quantity.*statistic = said.shift;
  });
  // A maximum that all runs have in common may come early, and a later part of the motion, where they go their own ways, exceed it in the
  // next one. A peak that lies at the end of a part in one run and at the beginning of the next one in another is no scatter: of a part alone
  // and with half of its neighbours, what says less counts.
  for (std::size_t k = 0; k < kQuantities.size(); ++k) {
    const auto reach = [&](int first, int last) {
      const std::vector<double> x = peaks_of(own, k, first, last);
      return x[0] + said_of(x, peaks_of(finer, k, first, last)).stated;
    };
    double highest = 0.0;
    for (int part = 0; part < kPeakParts; part += 2)
      highest = std::max(highest, std::min(reach(part, part + 1), reach(part - 1, part + 2)));
    double& stated = (error.stated.*kQuantities[k]).max;
    stated = std::max(stated, highest - (result.index.*kQuantities[k]).max);
  }
  // A step may go through the peak of an impact that it follows well otherwise.
  const auto stated_of = [&](const auto& value_of) {
    std::vector<double> x, y;
    for (const Followed& run : own) x.push_back(value_of(run));
    for (const Followed& run : finer) y.push_back(value_of(run));
    return said_of(x, y).stated;
  };
  for (std::size_t c = 0; c < result.contact.size(); ++c)
    error.contact_force.push_back(stated_of([c](const Followed& run) { return run.force[c]; }));
  for (int k = 0; k < 3; ++k)
    error.acceleration[k] = stated_of([k](const Followed& run) { return std::abs(run.acceleration[k]); });
  if (own.size() > 1)
    std::snprintf(text, sizeof text, "%s: %zu of them at neighbouring %s, %zu at %s",
                  settled ? "measured by further runs that agree" : "measured by further runs", own.size() - 1,
                  further.neighbours(), finer.size(), further.fineness());
  else
    std::snprintf(text, sizeof text,
                  "no neighbouring %s can be followed, so this one is by chance; measured by %zu at %s",
                  further.neighbour(), finer.size(), further.fineness());
  error.basis = text;
  if (!further.follows()) error.basis += ", in too little time to follow vibrations that begin to grow";
  return error;
}

}  // namespace boresight
