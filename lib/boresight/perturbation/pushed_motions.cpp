#include "boresight/perturbation/pushed_motions.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/stepping/located_motion.hpp"

namespace boresight {
namespace {

constexpr int kCells = 4 * LargestDeviations::kMany;  // of the load's table, where no finer one is there
// What is smaller than this share of the largest, on the mechanism's size, is next to nothing: it counts against a little of that.
constexpr double kNextToNothing = 1e-4;
// Neighbouring steps, as measured_error.hpp has them.
constexpr double kNeighbours[] = {0.985, 0.97};
// A second look would move the indices again, by less than the first did where linear forces are of use at all: as much is stated.
constexpr double kWithTheRest = 2.0;
// A pushed motion that takes this many times the steps of the motion itself is another one: it is given up.
constexpr double kMostSteps = 4.0;

// What the indices of `other` differ by, relative to those of `index`.
PerQuantity moved(const PointingIndices& index, const PointingIndices& other, double length) {
  const double largest =
      std::max({index.position_error.max, length * index.orientation_error.max, length * index.boresight_error.max});
  PerQuantity share = {};
  for (int k = 0; k < kPointingQuantities; ++k) {
    const auto quantity = PointingQuantity(k);
    const double unit = quantity == PointingQuantity::position_error ? 1.0 : length;
    const double least = quantity == PointingQuantity::line_of_sight_error ? 0.0 : kNextToNothing * largest / unit;
    for (const auto statistic : {&Statistics::max, &Statistics::rms, &Statistics::mean}) {
      const double a = index.of(quantity).*statistic, off = std::abs(other.of(quantity).*statistic - a);
      if (const double against = std::max(a, least); against > 0.0) share[k] = std::max(share[k], off / against);
    }
  }
  return share;
}

void raise(PerQuantity& to, const PerQuantity& by) {
  for (int k = 0; k < kPointingQuantities; ++k) to[k] = std::max(to[k], by[k]);
}

// What is missed at a time between two instants, and at which rate it changes.
struct Between {
  const Missed &from, &to;
  double share;

  VecX acceleration() const { return (1.0 - share) * from.acceleration + share * to.acceleration; }
  MatX inverse_mass() const { return (1.0 - share) * from.inverse_mass + share * to.inverse_mass; }
  VecX offset() const { return (1.0 - share) * from.offset + share * to.offset; }
  VecX offset_rate() const {
    const double gap = to.t - from.t;
    return gap > 0.0 ? VecX((to.offset - from.offset) / gap) : VecX(VecX::Zero(to.offset.size()));
  }
};
Between between(const std::vector<Missed>& missed, double t) {
  const auto next =
      std::lower_bound(missed.begin(), missed.end(), t, [](const Missed& m, double at) { return m.t < at; });
  const Missed& to = next == missed.end() ? missed.back() : *next;
  const Missed& from = next == missed.begin() ? to : *(next - 1);
  return {from, to, to.t > from.t ? (t - from.t) / (to.t - from.t) : 0.0};
}

void change_inverse_mass(const std::vector<Missed>& missed, double times, const SceneTables& tables,
                         SceneTables& changed) {
  const TimeTable& dynamics = tables.dynamics;
  const SceneLayout& at = tables.layout;
  const auto change = [&](double t, double* row) {
    const MatX more = times * between(missed, t).inverse_mass();
    for (int i = 0; i < at.n; ++i)
      for (int j = i; j < at.n; ++j) row[at.inverse_mass(i, j)] += more(i, j);
  };
  const int width = at.n * (at.n + 1) / 2;
  std::vector<double> row(static_cast<std::size_t>(dynamics.width())), values;
  for (int k = 0; k <= dynamics.cells(); ++k) {
    dynamics.at(k * dynamics.spacing(), row.data());
    change(k * dynamics.spacing(), row.data());
    values.insert(values.end(), &row[at.A], &row[at.A] + width);
  }
  changed.dynamics.replace(at.A, TimeTable(dynamics.spacing(), width, values));
}

void shift_offsets(const std::vector<Missed>& missed, double times, const SceneTables& tables, SceneTables& shifted) {
  const TimeTable& dynamics = tables.dynamics;
  std::vector<double> row(static_cast<std::size_t>(dynamics.width()));
  int first = 0;  // of the joint's dependent offsets
  for (const SceneLayout::Joint& joint : tables.layout.joints) {
    if (!joint.has_dependent) continue;
    std::vector<int> dependent;
    for (int k = 0; k < joint.offsets; ++k)
      if (joint.source[k] == DeviationCoordinates::kDependent) dependent.push_back(k);
    const auto shift = [&](double t, double* values) {  // those of all offsets, then their rates
      const Between now = between(missed, t);
      const VecX offset = times * now.offset(), rate = times * now.offset_rate();
      for (std::size_t i = 0; i < dependent.size(); ++i) {
        values[dependent[i]] += offset[first + static_cast<int>(i)];
        values[joint.offsets + dependent[i]] += rate[first + static_cast<int>(i)];
      }
    };
    const int width = 2 * joint.offsets;
    std::vector<double> values;
    for (int k = 0; k <= dynamics.cells(); ++k) {
      dynamics.at(k * dynamics.spacing(), row.data());
      shift(k * dynamics.spacing(), &row[joint.shift]);
      values.insert(values.end(), &row[joint.shift], &row[joint.shift] + width);
    }
    shifted.dynamics.replace(joint.shift, TimeTable(dynamics.spacing(), width, values));
    first += static_cast<int>(dependent.size());
  }
}

// Whether inverse masses are such with what is missed added and taken away: where that is as large as they are, no small push shows anything.
bool all_stay_masses(const std::vector<Missed>& missed, const SceneTables& tables) {
  std::vector<double> row(static_cast<std::size_t>(tables.dynamics.width()));
  MatX A;
  return std::all_of(missed.begin(), missed.end(), [&](const Missed& m) {
    tables.dynamics.at(m.t, row.data());
    tables.layout.inverse_mass(row.data(), A);
    return Eigen::LLT<MatX>(A + m.inverse_mass).info() == Eigen::Success &&
           Eigen::LLT<MatX>(A - m.inverse_mass).info() == Eigen::Success;
  });
}

}  // namespace

std::shared_ptr<const SceneTables> pushed_by(const SecondOrder& beyond, double times, double duration,
                                             const SceneTables& tables) {
  const std::vector<Missed>& missed = beyond.missed;
  const int n = tables.layout.n;
  const TimeTable& before = tables.load_change;
  double spacing = duration / kCells;
  if (before.width() > 0) spacing = before.spacing() / std::max(1.0, std::ceil(before.spacing() / spacing));
  const int cells = static_cast<int>(std::ceil(duration / spacing - 1e-9));
  std::vector<double> values;
  for (int i = 0; i <= cells; ++i) {
    const double t = i * spacing;
    const Between now = between(missed, t);
    VecX load = times * now.acceleration();
    // Where A r is made of A and r, more in A makes more of it.
    if (tables.reaction.width() > 0) {
      VecX r(n);
      tables.reaction.at(t, r.data());
      load -= times * now.inverse_mass() * r;
    }
    if (before.width() > 0) before.add(t, load.data());
    values.insert(values.end(), load.data(), load.data() + n);
  }
  auto pushed = std::make_shared<SceneTables>(tables);
  pushed->load_change = TimeTable(spacing, n, values);
  change_inverse_mass(missed, times, tables, *pushed);
  if (missed.front().offset.size() > 0) shift_offsets(missed, times, tables, *pushed);
  if (beyond.start.size() > 0) {
    VecX& beside = pushed->start.beside;
    beside = VecX((beside.size() > 0 ? beside : VecX::Zero(2 * n)) + times * beyond.start);
  }
  return pushed;
}

void state_what_pushes_move(const SecondOrder& beyond, const Mechanism& mechanism,
                            const std::shared_ptr<const SceneTables>& tables, const RunOptions& options,
                            double tolerance, const FollowOn& follow, RunResult& result) {
  if (beyond.missed.empty() || !all_stay_masses(beyond.missed, *tables)) return;
  RunOptions beside = options;
  beside.sample_spacing = beside.frame_spacing = 0.0;
  beside.pose_bodies.clear();
  beside.events = false;
  double looks = 0.0;
  if (!result.integrator_taken.empty()) beside.integrator = result.integrator_taken;
  const bool by_steps = beside.integrator.empty() || beside.integrator == "rk4";
  const double most_looks =
      2.0 + kMostSteps * static_cast<double>(result.cost.steps) / (by_steps ? kStepsBetweenLooks : kEndsBetweenLooks);
  bool asked_to_stop = false;
  beside.progress = [&](const RunProgress&) {
    if (++looks > most_looks) return false;
    asked_to_stop = asked_to_stop || (options.progress && !options.progress({mechanism.duration(), mechanism.duration(),
                                                                             result.index.position_error.max}));
    return !asked_to_stop;
  };
  if (by_steps && result.cost.steps > 0) beside.step = result.end_time / static_cast<double>(result.cost.steps);

  const double length = mechanism.characteristic_length();
  PerQuantity measured = {}, by_pushes = {}, by_what_is_missed = {}, by_chance = {};
  bool more = false;
  try {
    for (const double times : {1.0, -1.0}) {
      looks = 0.0;
      const RunResult pushed = follow(pushed_by(beyond, times, mechanism.duration(), *tables), beside);
      if (pushed.interrupted) {
        result.interrupted = asked_to_stop;  // a run without its error is not done
        return;
      }
      raise(by_pushes, moved(result.index, pushed.index, length));
      if (times > 0.0) by_what_is_missed = by_pushes;
    }
    for (int k = 0; k < kPointingQuantities; ++k) {
      by_pushes[k] *= kWithTheRest;
      measured[k] = std::min(1.0, beyond.pose[k] + by_pushes[k]);
      // Taken away, it shows how much hangs on little. Of a freedom that nothing drives that may be all of the motion: where what is missed
      // moves less than the share, no more than the share is stated.
      if (beyond.free && beyond.pose[k] + kWithTheRest * by_what_is_missed[k] <= beyond.whole[k])
        measured[k] = std::min(measured[k], beyond.whole[k]);
      more = more || measured[k] > beyond.whole[k];
    }
    for (const double share : kNeighbours) {
      if (!more) break;
      RunOptions neighbour = beside;
      if (by_steps || beside.step > 0.0) neighbour.step *= share;
      if (!by_steps) neighbour.tolerance = share * tolerance;
      looks = 0.0;
      const RunResult scattered = follow(tables, neighbour);
      if (scattered.interrupted) {
        result.interrupted = asked_to_stop;
        return;
      }
      raise(by_chance, moved(result.index, scattered.index, length));
    }
  } catch (const ComputationError&) {
    return;
  }
  for (int k = 0; k < kPointingQuantities; ++k)
    if (measured[k] <= beyond.whole[k] || by_pushes[k] > kWithTheRest * by_chance[k])
      // What standing errors and play do together is in the share alone.
      result.error.model[k] =
          mechanism.description().errors.empty() ? measured[k] : std::max(measured[k], beyond.whole[k]);
}

}  // namespace boresight
