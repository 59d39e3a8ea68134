#include "run/axes_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/statics/quasistatic.hpp"
#include "terminal/interruption.hpp"
#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

// What is said beside the motion may take so long; where a scene of its loads takes longer, it is left out.
constexpr std::chrono::seconds kMostTime{10};

// Set once that time is over.
class TimeLimit {
 public:
  explicit TimeLimit(std::chrono::seconds most)
      : timer_([this, most] {
          std::unique_lock lock(mutex_);
          if (!ended_.wait_for(lock, most, [this] { return done_; })) over_ = true;
        }) {}
  ~TimeLimit() {
    {
      const std::scoped_lock lock(mutex_);
      done_ = true;
    }
    ended_.notify_one();
    timer_.join();
  }
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
  const std::atomic<bool>& over() const { return over_; }

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  std::atomic<bool> over_{false};
  std::thread timer_;
};

PointingIndices at_rest(MechanismDescription description, JournalAxes axes, const std::atomic<bool>& over) {
  for (ClearanceDescription& c : description.clearances) c.axes = axes;
  const auto mechanism = std::make_shared<const Mechanism>(std::move(description));
  RunOptions options;
  options.sample_spacing = 0.0;
  options.progress = [&over](const RunProgress&) { return !interrupted() && !over; };
  const RunResult result = make_rests(mechanism)->run(mechanism->parameters(), options);
  if (result.interrupted) throw Interrupted{};
  return result.index;
}

}  // namespace

std::optional<AxesComparison> compare_axes(const Mechanism& mechanism, std::string& left_out) {
  const MechanismDescription& m = mechanism.description();
  if (m.clearances.empty()) return {};
  for (const ClearanceDescription& c : m.clearances)
    if (tilt_lever(c.parameters) <= 0.0) return {};
  AxesComparison result;
  result.free = std::any_of(m.clearances.begin(), m.clearances.end(),
                            [](const ClearanceDescription& c) { return c.axes == JournalAxes::free; });
  const TimeLimit limit(kMostTime);
  const StopOfThread stop(limit.over());
  try {
    const PointingIndices parallel = at_rest(m, JournalAxes::parallel, limit.over()),
                          free = at_rest(m, JournalAxes::free, limit.over());
    result.parallel_boresight = parallel.boresight_error.max;
    result.free_boresight = free.boresight_error.max;
    result.parallel_position = parallel.position_error.max;
    result.free_position = free.position_error.max;
  } catch (const ComputationError&) {
    return {};
  } catch (const Interrupted&) {
    if (interrupted()) throw;
    left_out = fmt::format(
        "what free journal axes change at rest is not compared with parallel ones: here that takes more than {:d} s",
        kMostTime.count());
    return {};
  }
  // Rounding of a motion integrated in metres.
  const auto angle = [](double rad) {
    return rad < 1e-9 ? std::string("0") : readable(rad, "rad") + " (" + readable_arcsec(rad) + ")";
  };
  const std::string figures = fmt::format(
      "with journals at rest, the largest boresight error is {} with parallel axes and {} with free ones, the largest "
      "position "
      "error {} and {}",
      angle(result.parallel_boresight), angle(result.free_boresight), readable(result.parallel_position, "m"),
      readable(result.free_position, "m"));
  result.tells = angle(result.parallel_boresight) != angle(result.free_boresight) ||
                 readable(result.parallel_position, "m") != readable(result.free_position, "m");
  result.sentence =
      !result.tells ? "Whether journals tilt in their sleeves makes no difference at rest: " + figures + "."
      : result.free ? "Journals tilt in their sleeves here. What parallel axes would have hidden: " + figures + "."
                    : "Journal and sleeve axes are assumed parallel. What that hides: " + figures +
                          ". Set axes = \"free\" to have the tilt computed.";
  return result;
}

}  // namespace boresight::app
