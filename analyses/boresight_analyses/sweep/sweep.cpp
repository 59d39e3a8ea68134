#include "boresight_analyses/sweep/sweep.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight_analyses/runs/result_numbers.hpp"
#include "boresight_analyses/threads/on_threads.hpp"

namespace boresight {

static void fields(Numbers& n, SweepPoint& p) { n(p.status, p.values, p.result, p.failure); }

namespace {

// Gathers how far every point has come; tells the caller, one thread at a time, and remembers a wish to stop.
class Watch {
 public:
  Watch(std::size_t points, const std::function<bool(const SweepProgress&)>& tell) : share_(points, 0.0), tell_(tell) {}

  bool stopped() const { return stopped_.load(std::memory_order_relaxed); }
  void stop() { stopped_ = true; }

  bool update(std::size_t point, double share, double position_error_max) {
    const std::scoped_lock lock(mutex_);
    done_ += share - share_[point];
    share_[point] = share;
    largest_ = std::max(largest_, position_error_max);
    if (tell_ && !stopped_ && !tell_({done_, share_.size(), largest_})) stopped_ = true;
    return !stopped_;
  }

 private:
  std::mutex mutex_;
  std::vector<double> share_;
  double done_ = 0.0, largest_ = 0.0;
  const std::function<bool(const SweepProgress&)>& tell_;
  std::atomic<bool> stopped_{false};
};

void compute(SweepPoint& point, std::size_t k, const Rung& rung, const Mechanism& mechanism, const SweepPlan& plan,
             const SweepOptions& sweep, Watch& watch) {
  if (std::optional<SweepPoint> found = kept_result<SweepPoint>(sweep.kept, k)) {
    point = std::move(*found);
    watch.update(k, 1.0, point.result.index.position_error.max);
    return;
  }
  RunOptions options = sweep.run;
  options.progress = [&](const RunProgress& p) {
    const double share = p.duration > 0.0 ? std::clamp(p.t / p.duration, 0.0, 1.0) : 0.0;
    return watch.update(k, share, p.position_error_max_so_far);
  };
  try {
    point.result = rung.run(plan.parameters_at(mechanism, k), options);
    point.status = point.result.interrupted ? SweepPoint::Status::interrupted : SweepPoint::Status::done;
  } catch (const ComputationError& error) {
    point.status = SweepPoint::Status::failed;
    point.failure = error.what();
  } catch (const Interrupted&) {  // heard while the scene was built
    watch.stop();
    return;
  }
  if (point.status == SweepPoint::Status::interrupted) return;
  if (sweep.kept != nullptr) sweep.kept->keep(k, Numbers::of(point));
  watch.update(k, 1.0, point.result.index.position_error.max);
}

}  // namespace

const char* to_string(SweepPoint::Status status) {
  switch (status) {
    case SweepPoint::Status::not_reached:
      return "not reached";
    case SweepPoint::Status::done:
      return "done";
    case SweepPoint::Status::failed:
      return "failed";
    case SweepPoint::Status::interrupted:
      return "interrupted";
  }
  return "";
}

SweepResult run_sweep(const Rung& rung, const Mechanism& mechanism, const SweepPlan& plan,
                      const SweepOptions& options) {
  SweepResult result;
  result.points.resize(plan.points());
  for (std::size_t k = 0; k < result.points.size(); ++k) result.points[k].values = plan.values_at(k);

  Watch watch(result.points.size(), options.progress);
  for_each_on_threads(
      result.points.size(), options.jobs,
      [&](std::size_t k) {
        if (!watch.stopped()) compute(result.points[k], k, rung, mechanism, plan, options, watch);
      },
      [&] { watch.stop(); });

  result.interrupted = std::any_of(result.points.begin(), result.points.end(), [](const SweepPoint& p) {
    return p.status == SweepPoint::Status::interrupted || p.status == SweepPoint::Status::not_reached;
  });
  result.failed =
      static_cast<std::size_t>(std::count_if(result.points.begin(), result.points.end(), [](const SweepPoint& p) {
        return p.status == SweepPoint::Status::failed;
      }));
  return result;
}

}  // namespace boresight
