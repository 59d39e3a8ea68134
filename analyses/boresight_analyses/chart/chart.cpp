#include "boresight_analyses/chart/chart.hpp"

#include <algorithm>
#include <numeric>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"

namespace boresight {

static void fields(Numbers& n, Measurement& m) {
  n(m.values, m.value, m.half_spread, m.estimate, m.step, m.cpu_seconds, m.spent_seconds, m.refusal);
}

namespace {

class Chart {
 public:
  Chart(const std::shared_ptr<const Mechanism>& mechanism, const Parameters& parameters, const ChartOptions& options)
      : mechanism_(mechanism), parameters_(parameters), options_(options) {}

  ChartResult run() {
    result_.index = options_.index.title();
    result_.unit = options_.index.si_unit();
    result_.machine = this_machine();
    try {
      now_ = "the reference";
      const auto multibody = make_rung("multibody", mechanism_);
      ReferenceOptions reference{.target = options_.reference_target,
                                 .most_seconds = options_.reference_seconds,
                                 .measured = [&](const RungSetup& setup) { return measured(*multibody, setup, 0.0); }};
      result_.reference = find_reference(*multibody, parameters_, reference);
      const std::vector<SetupFamily> families = chart_setups(result_.reference.own_step);
      runs_left_ = 0;
      for (const SetupFamily& f : families) runs_left_ += 3 * f.setups.size();
      runs_left_ += 3;
      done_before_ = 0.15;
      runs_ = 0;
      add(papers_setup(), "multibody, paper, baumgarte, rk4", *multibody, true);
      for (const SetupFamily& family : families) measure_family(family);
      if (options_.flight) {
        now_ = "the flight before the first impact";
        done_before_ = 0.85;
        runs_left_ = 200;
        runs_ = 0;
        result_.flight = fly(
            *mechanism_, parameters_, result_.reference.own_step, 0.2 * options_.total_seconds,
            [this] { return advance(); }, options_.kept);
      }
    } catch (const MeasurementInterrupted&) {
      result_.interrupted = true;
    } catch (const Interrupted&) {  // heard while a scene was built
      result_.interrupted = true;
    }
    result_.front = pareto_front(result_.points, result_.reference.uncertainty);
    return result_;
  }

 private:
  bool advance() {
    const double width = done_before_ == 0.0 ? 0.15 : done_before_ < 0.5 ? 0.7 : 0.15;
    const double share =
        done_before_ + width * std::min(1.0, static_cast<double>(runs_++) / std::max<std::size_t>(1, runs_left_));
    return !options_.progress || options_.progress(share, now_);
  }
  MeasureOptions measuring(double most_seconds) {
    return {.index = options_.index, .most_seconds = most_seconds, .advance = [this] { return advance(); }};
  }

  // What is measured next hangs on what was measured before: a start that goes on asks for the same, in the same order.
  Measurement measured(const Rung& rung, const RungSetup& setup, double most_seconds) {
    return kept_or_computed<Measurement>(options_.kept, measurements_++,
                                         [&] { return measure(rung, parameters_, setup, measuring(most_seconds)); });
  }

  // From coarse to fine, until finer ways only cost more: below the floor of the reference, or too long.
  void measure_family(const SetupFamily& family) {
    now_ = family.name;
    if (spent_ > options_.total_seconds) {
      result_.left_out.push_back(family.name);
      return;
    }
    // Each family with a rung of its own: what it precomputes is not charged to it, and not shared.
    const auto rung = make_rung(family.setups.front().rung, mechanism_);
    int below = 0;
    for (const RungSetup& setup : family.setups) {
      const ChartPoint& point = add(setup, family.name, *rung, false);
      const bool too_long = !point.measured.refusal.empty() && point.measured.spent_seconds > options_.most_seconds;
      below = point.measured.refusal.empty() && point.error <= result_.reference.uncertainty ? below + 1 : 0;
      if (too_long || below == 2 || spent_ > options_.total_seconds) break;
    }
  }

  const ChartPoint& add(const RungSetup& setup, const std::string& family, const Rung& rung, bool papers) {
    ChartPoint point{
        .setup = setup, .family = family, .measured = measured(rung, setup, options_.most_seconds), .papers = papers};
    spent_ += point.measured.spent_seconds;
    if (point.measured.refusal.empty())
      point.error = relative_error(point.measured, result_.reference.value, nothing_of(options_.index, *mechanism_));
    result_.points.push_back(std::move(point));
    return result_.points.back();
  }

  std::shared_ptr<const Mechanism> mechanism_;
  const Parameters& parameters_;
  const ChartOptions& options_;
  ChartResult result_;
  std::string now_;
  double done_before_ = 0.0, spent_ = 0.0;
  std::size_t runs_ = 0, runs_left_ = 15;
  std::uint64_t measurements_ = 0;
};

}  // namespace

const ChartPoint* ChartResult::papers() const {
  for (const ChartPoint& p : points)
    if (p.papers && p.measured.refusal.empty()) return &p;
  return nullptr;
}

const ChartPoint* ChartResult::cheapest_within(double accuracy) const {
  const ChartPoint* best = nullptr;
  if (reference.uncertainty > accuracy) return nullptr;  // then it is luck which point comes near
  for (const ChartPoint& p : points)
    // By as much as the reference is off, a way may be so too.
    if (p.measured.refusal.empty() && p.error + reference.uncertainty <= accuracy &&
        (!best || p.measured.cpu_seconds < best->measured.cpu_seconds))
      best = &p;
  return best;
}

std::vector<std::size_t> pareto_front(const std::vector<ChartPoint>& points, double floor) {
  std::vector<std::size_t> order(points.size()), front;
  std::iota(order.begin(), order.end(), 0);
  order.erase(
      std::remove_if(order.begin(), order.end(), [&](std::size_t k) { return !points[k].measured.refusal.empty(); }),
      order.end());
  const auto error = [&](std::size_t k) { return std::max(points[k].error, floor); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double ta = points[a].measured.cpu_seconds, tb = points[b].measured.cpu_seconds;
    return ta != tb ? ta < tb : error(a) < error(b);
  });
  for (std::size_t k : order)
    if (front.empty() || error(k) < error(front.back())) front.push_back(k);
  return front;
}

ChartResult make_chart(const std::shared_ptr<const Mechanism>& mechanism, const Parameters& parameters,
                       const ChartOptions& options) {
  return Chart(mechanism, parameters, options).run();
}

}  // namespace boresight
