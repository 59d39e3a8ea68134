#include "comparison.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight/rungs/cpu_clock.hpp"
#include "boresight_analyses/chart/setups.hpp"

namespace boresight::peers {
namespace {

// As in measurement.hpp: neighbours that are as good as the first, judged by their median, half their spread,
// and the least CPU.
constexpr double kNeighbours[] = {1.0, 0.985, 0.97};
constexpr double kTolerances[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5};
// A batch that a Monte Carlo run would hand over: clearances spread by 5 % to both sides, the first one the
// scene's own.
constexpr int kBatch = 1024;  // as many as Monte Carlo hands out
constexpr double kSpread = 0.05;

struct OneRun {
  double index, cpu_seconds;
};

template <typename Run>
Measurement over_neighbours(Run&& run) {
  Measurement out;
  std::vector<double> values;
  for (double share : kNeighbours) {
    const OneRun one = run(share);
    values.push_back(one.index);
    out.spent_seconds += one.cpu_seconds;
    out.cpu_seconds = values.size() == 1 ? one.cpu_seconds : std::min(out.cpu_seconds, one.cpu_seconds);
  }
  std::sort(values.begin(), values.end());
  out.value = values[1];
  out.half_spread = 0.5 * (values.back() - values.front());
  return out;
}

// Beyond this many times the reference a journal has left its sleeve: a contact that was stepped over.
constexpr double kLost = 10.0;

Measurement measure_peer(const Peer& peer, const PeerScene& scene, const PeerSetting& setting, double reference,
                         double most_seconds) {
  try {
    return over_neighbours([&](double share) -> OneRun {
      const PeerMotion motion = peer.follow(scene, {.setting = setting.scaled(share), .most_seconds = most_seconds});
      if (!(motion.largest < kLost * reference)) throw PeerFailure("the journal leaves the sleeve");
      return {motion.largest, motion.cpu_seconds};
    });
  } catch (const PeerFailure& failure) {
    Measurement out;
    out.refusal = failure.what();
    return out;
  }
}

// Per sample of a batch.
Measurement measure_lanes(const PerturbationLanes& lanes, const Parameters& parameters, double tolerance) {
  std::vector<Parameters> batch(kBatch, parameters);
  for (int k = 1; k < kBatch; ++k)
    for (ClearanceParameters& c : batch[static_cast<std::size_t>(k)].clearance) {
      const double scale = 1.0 + kSpread * (2.0 * k / (kBatch - 1.0) - 1.0);
      c.radial *= scale;
      c.axial *= scale;
    }
  std::vector<LaneOutcome> outcomes(kBatch);
  Measurement out;
  bool failed = false;
  out = over_neighbours([&](double share) -> OneRun {
    const double start = thread_cpu_seconds();
    lanes.run(batch, outcomes, share * tolerance);
    const double cpu = thread_cpu_seconds() - start;
    for (const LaneOutcome& o : outcomes) failed = failed || o.status != LaneStatus::done;
    return {outcomes.front().max, cpu / kBatch};
  });
  if (failed) out.refusal = "a lane did not reach the end";
  return out;
}

class Comparing {
 public:
  Comparing(const std::shared_ptr<const Mechanism>& mechanism, const Parameters& parameters,
            const ComparisonOptions& options)
      : mechanism_(mechanism), parameters_(parameters), options_(options), scene_(mechanism, parameters) {}

  Comparison run() {
    options_.progress("the reference");
    const auto multibody = make_rung("multibody", mechanism_);
    out_.reference = find_reference(*multibody, parameters_, {.target = 1e-5, .most_seconds = 10.0});
    out_.machine = this_machine();
    for (const SetupFamily& family : chart_setups(out_.reference.own_step)) ours(family);
    on_lanes();
    for (const auto& peer : peers()) {
      options_.progress("what " + peer->name() + " models");
      const PeerSetting setting = peer->proving_setting();
      out_.proofs.push_back(
          {peer->name(), peer->models(), setting.method + ", " + setting.fineness(), prove(*peer, scene_, setting)});
      theirs(*peer);
    }
    return out_;
  }

 private:
  void ours(const SetupFamily& family) {
    const RungSetup& first = family.setups.front();
    // Left to `boresight chart`, being far from the front here: second order, and the paper's coordinates but
    // for its own way.
    if (first.integrator == "generalized-alpha") return;
    if (first.formulation == "paper" && first.family() != papers_setup().family()) return;
    const auto rung = make_rung(first.rung, mechanism_);
    std::string setup = family.name;
    setup.erase(0, std::min(setup.size(), first.rung.size() + 2));
    for (const RungSetup& one : family.setups) {
      add({.program = first.rung,
           .setup = setup,
           .fineness = fineness(one),
           .ours = true,
           .measured = measure(*rung, parameters_, one, {.most_seconds = options_.most_seconds})});
      if (done_with_line()) break;
    }
  }

  void on_lanes() {
    if (!PerturbationLanes::serve(*mechanism_)) return;
    const PerturbationLanes lanes(mechanism_, PointingQuantity::position_error);
    measure_lanes(lanes, parameters_, 1e-1);  // what is computed once for a mechanism is not timed
    for (double tolerance : kTolerances) {
      const RungSetup setup{.rung = "perturbation", .tolerance = tolerance};
      add({.program = "perturbation on lanes",
           .setup = std::string("a sample of ") + std::to_string(kBatch) + ", " +
                    lane_targets(LanePrecision::single_precision).front().name,
           .fineness = fineness(setup),
           .ours = true,
           .measured = measure_lanes(lanes, parameters_, tolerance)});
      if (done_with_line()) break;
    }
  }

  void theirs(const Peer& peer) {
    std::string finished;  // method of which finer settings only cost more
    for (const PeerSetting& setting : peer.settings()) {
      if (setting.method == finished) continue;
      add({.program = peer.name(),
           .setup = setting.method,
           .fineness = setting.fineness(),
           .stands_alone = peer.stands_alone(),
           .measured = measure_peer(peer, scene_, setting, out_.reference.value, options_.most_seconds)});
      if (done_with_line()) finished = setting.method;
    }
  }

  void add(ComparedPoint point) {
    if (point.done()) point.error = relative_error(point.measured, out_.reference.value);
    options_.progress(point.line() + ", " + point.fineness);
    out_.points.push_back(std::move(point));
  }
  // Two in a row below what the reference can tell apart, or given up.
  bool done_with_line() const {
    const auto below = [&](const ComparedPoint& p) { return p.done() && p.error <= out_.reference.uncertainty; };
    const std::size_t n = out_.points.size();
    const ComparedPoint& last = out_.points.back();
    if (last.measured.refusal.rfind("given up", 0) == 0) return true;
    return n > 1 && out_.points[n - 2].line() == last.line() && below(last) && below(out_.points[n - 2]);
  }

  std::shared_ptr<const Mechanism> mechanism_;
  const Parameters& parameters_;
  const ComparisonOptions& options_;
  PeerScene scene_;
  Comparison out_;
};

}  // namespace

const ComparedPoint* Comparison::cheapest_within(double accuracy,
                                                 const std::function<bool(const ComparedPoint&)>& wanted) const {
  const ComparedPoint* best = nullptr;
  for (const ComparedPoint& p : points)
    if (p.done() && p.error <= accuracy && wanted(p) && (!best || p.measured.cpu_seconds < best->measured.cpu_seconds))
      best = &p;
  return best;
}

Comparison compare(const std::shared_ptr<const Mechanism>& mechanism, const Parameters& parameters,
                   const ComparisonOptions& options) {
  return Comparing(mechanism, parameters, options).run();
}

}  // namespace boresight::peers
