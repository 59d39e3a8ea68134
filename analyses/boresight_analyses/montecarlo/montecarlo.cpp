#include "boresight_analyses/montecarlo/montecarlo.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "boresight_analyses/montecarlo/estimates.hpp"
#include "boresight_analyses/runs/sampling.hpp"
#include "boresight_analyses/threads/portion.hpp"
#include "boresight_analyses/threads/watcher.hpp"

namespace boresight {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kCommitEvery{250};

// What rank 0 knows of all ranks' samples while they are being computed.
class Tally {
 public:
  Tally(const MonteCarloOptions& options, std::uint64_t total) : options_(options) { progress_.total = total; }

  void begin_with(double value) { count(value), ++progress_.begun_with; }
  void landed(std::span<const double> values) {
    const std::scoped_lock lock(mutex_);
    for (const double value : values) count(value);
    progress_.running = &running_;
    if (options_.progress) options_.progress(progress_);
  }

 private:
  void count(double value) {
    ++progress_.done;
    if (std::isnan(value)) {
      ++progress_.failed;
      running_.add_failed();
    } else {
      running_.add(value);
    }
  }

  const MonteCarloOptions& options_;
  std::mutex mutex_;
  MonteCarloProgress progress_;
  RunningQuantiles running_;
};

std::uint64_t unit_of(const MonteCarloPlan& plan) {
  return plan.design.kind == SamplingKind::lhs     ? plan.design.strata
         : plan.design.kind == SamplingKind::sobol ? plan.design.replicates
                                                   : 1;
}

std::vector<double> leading_values(const SampleStore& store, std::uint64_t end,
                                   const std::function<void(const SampleRecord&)>& each = {}) {
  std::vector<double> values;
  values.reserve(std::min<std::uint64_t>(end, store.count()));
  bool gap = false;
  store.read(end, [&](const SampleRecord& record) {
    gap = gap || record.number != values.size();
    if (gap) return;
    values.push_back(record.outcome.value);
    if (each) each(record);
  });
  return values;
}

bool narrow_enough(const SampleStore& store, const MonteCarloPlan& plan, std::uint64_t n) {
  const std::vector<double> values = leading_values(store, n);
  const ReportedInterval i =
      estimate_of(plan.stop.of, values, values.size(), plan, interval_confidence(plan, plan.stop.of));
  return std::isfinite(i.value) && std::max(i.high - i.value, i.value - i.low) <= plan.stop.width * std::abs(i.value);
}

std::filesystem::path shard(const std::filesystem::path& folder, int rank) {
  return folder / (rank == 0 ? "samples.db" : "samples." + std::to_string(rank) + ".db");
}

}  // namespace

const char* to_string(Ended ended) {
  switch (ended) {
    case Ended::samples:
      return "all samples computed";
    case Ended::width:
      return "the interval is narrow enough";
    case Ended::time:
      return "the time was up";
    case Ended::interrupted:
      return "interrupted";
  }
  return "";
}

std::vector<std::uint64_t> stopping_points(const MonteCarloPlan& plan) {
  std::vector<std::uint64_t> points;
  if (plan.stop.width > 0.0) {
    const std::uint64_t unit = unit_of(plan);
    const bool net = plan.design.kind == SamplingKind::sobol;  // these keep their balance at powers of two
    std::uint64_t units = std::max<std::uint64_t>(2, net ? 16 : (200 + unit - 1) / unit);
    for (; units * unit < plan.samples; units = net ? 2 * units : units + (units + 1) / 2)
      points.push_back(units * unit);
  }
  points.push_back(plan.samples);
  return points;
}

void merge_shards(SampleStore& store, const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool is_shard = name.size() > 11 && name.starts_with("samples.") && name.ends_with(".db") &&
                          name.substr(8, name.size() - 11).find_first_not_of("0123456789") == std::string::npos;
    if (is_shard) found.push_back(entry.path());
  }
  for (const std::filesystem::path& file : found) {
    store.merge(file);
    std::filesystem::remove(file);
  }
}

MonteCarloResult run_montecarlo(const SampleModel& model, const MonteCarloPlan& plan, SampleStore* store, Ranks& ranks,
                                const MonteCarloOptions& options) {
  const Clock::time_point start = Clock::now();
  const bool first = ranks.rank() == 0;
  const SamplingDesign design(plan.design, static_cast<int>(plan.inputs.size()));
  Watcher watcher(options.interrupted);
  Tally tally(options, plan.samples);
  const auto time_is_up = [&] {
    return plan.stop.seconds > 0.0 && std::chrono::duration<double>(Clock::now() - start).count() > plan.stop.seconds;
  };
  if (first) store->read(plan.samples, [&](const SampleRecord& record) { tally.begin_with(record.outcome.value); });

  MonteCarloResult result;
  for (const std::uint64_t target : stopping_points(plan)) {
    std::unique_ptr<SampleStore> own;  // of this rank, where it is not the first
    if (!first) {
      own = std::make_unique<SampleStore>(shard(options.folder, ranks.rank()), options.facts, [&] {
        std::vector<std::string> names;
        for (const RandomParameter& p : plan.inputs.parameters) names.push_back(p.name());
        return names;
      }());
      own->use_rung(model.rung(), model.step());
    }
    SampleStore& here = first ? *store : *own;
    Clock::time_point committed = Clock::now();
    std::vector<double> landed;

    Ranks::Work work;
    work.compute = [&](const NumberRange& block, bool& whole) {
      std::vector<double> block_values;
      ParallelSampling sampling{.jobs = options.jobs, .landed = {}, .stop = &watcher.stop};
      sampling.landed = [&](std::span<const SampleRecord> records) {
        landed.clear();
        for (const SampleRecord& record : records) {
          here.add(record);
          landed.push_back(record.outcome.value);
        }
        if (Clock::now() - committed > kCommitEvery) {
          here.commit();
          committed = Clock::now();
        }
        if (first)
          tally.landed(landed);
        else
          block_values.insert(block_values.end(), landed.begin(), landed.end());
        return ranks.size() > 1 || !time_is_up();
      };
      whole = compute_samples(model, plan.inputs, design, {block}, sampling);
      here.commit();
      return block_values;
    };
    work.brought = [&](std::span<const double> values) { tally.landed(values); };
    work.enough = [&] { return watcher.stop || time_is_up(); };
    if (first) {
      work.blocks = here.missing(target);
      if (ranks.size() > 1) {
        std::uint64_t all = 0;
        for (const NumberRange& range : work.blocks) all += range.size();
        const std::uint64_t batch = least_portion(model.batch()) * static_cast<std::uint64_t>(options.jobs);
        const std::uint64_t fair = all / (16 * static_cast<std::uint64_t>(ranks.size()));
        work.blocks =
            blocks_of(work.blocks, std::clamp<std::uint64_t>(fair, batch, std::max<std::uint64_t>(batch, 65536)));
      }
    }
    const bool whole = ranks.share(work);
    own.reset();  // closes this rank's file
    ranks.wait_for_all();

    std::string go_on;
    if (first) {
      merge_shards(*store, options.folder);
      result.ended = Ended::samples;
      if (!whole) result.ended = !watcher.stop && time_is_up() ? Ended::time : Ended::interrupted;
      if (whole && target < plan.samples && narrow_enough(*store, plan, target)) result.ended = Ended::width;
      go_on = result.ended == Ended::samples ? "yes" : "no";
      if (result.ended == Ended::width) result.values = leading_values(*store, target, options.read_back);
    }
    ranks.broadcast(go_on);
    if (go_on == "no") break;
  }
  if (first) {
    result.stored = store->count();
    if (result.ended != Ended::width) result.values = leading_values(*store, plan.samples, options.read_back);
    if (result.ended == Ended::samples && result.values.size() != plan.samples)
      throw StoreFailed(store->file().string() + " gives back " + std::to_string(result.values.size()) + " of the " +
                        std::to_string(plan.samples) +
                        " samples that were stored in it; the same command computes the others anew");
  }
  return result;
}

}  // namespace boresight
