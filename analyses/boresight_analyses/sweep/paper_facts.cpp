#include "boresight_analyses/sweep/paper_facts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {

bool is_3_rrcpr(const MechanismDescription& mechanism) {
  std::map<std::pair<JointType, bool>, int> joints;  // by type, and whether driven
  for (const JointDescription& joint : mechanism.joints) ++joints[{joint.type, joint.driven}];
  const std::map<std::pair<JointType, bool>, int> legs = {{{JointType::revolute, true}, 3},
                                                          {{JointType::revolute, false}, 6},
                                                          {{JointType::cylindrical, false}, 3},
                                                          {{JointType::prismatic, true}, 3}};
  return joints == legs;
}

bool names_clearance(const SweepAxis& axis) {
  return std::any_of(axis.parameters.begin(), axis.parameters.end(), [](const std::string& path) {
    return path.starts_with("clearance.") && (path.ends_with(".radial") || path.ends_with(".axial"));
  });
}

bool names_load(const SweepAxis& axis) {
  return std::find(axis.parameters.begin(), axis.parameters.end(), "payload.mass") != axis.parameters.end();
}

bool parallel_axes(const Mechanism& mechanism) {
  const auto& all = mechanism.description().clearances;
  return std::all_of(all.begin(), all.end(),
                     [](const ClearanceDescription& c) { return c.axes == JournalAxes::parallel; });
}

bool orientation_stays(const Mechanism& mechanism, const SweepLine& line) {
  return std::all_of(line.results.begin(), line.results.end(), [&](const RunResult* r) {
    return r->index.orientation_error.max * mechanism.characteristic_length() < 0.01 * r->index.position_error.max;
  });
}

DisturbedDirections disturbed_directions(const SweepLine& line) {
  DisturbedDirections found;
  for (const RunResult* result : line.results) {
    const Vec3 a = acceleration_disturbance(*result).value_or(Vec3::Zero());
    Vec3::Index k = 0;
    a.maxCoeff(&k);
    found.strongest_is_y += k == 1;
    found.disturbance.push_back(a);
  }
  return found;
}

std::optional<std::vector<MeanContact>> mean_contacts(const Mechanism& mechanism, const SweepPlan& plan,
                                                      const SweepLine& line) {
  std::vector<MeanContact> means;
  for (std::size_t i = 0; i < line.size(); ++i) {
    try {
      const auto contacts = analyse_contacts(mechanism, plan.parameters_at(mechanism, line.point[i]));
      const auto mean =
          contacts.empty() ? std::nullopt : mean_contact(*line.results[i], contacts.front().hertz_stiffness);
      if (!mean) return std::nullopt;
      means.push_back(*mean);
    } catch (const ComputationError&) {
      return std::nullopt;
    }
  }
  return means;
}

GrowthPerAxis growth_per_axis(const SweepLine& line) {
  Vec3 first = Vec3::Zero(), last = Vec3::Zero();
  GrowthPerAxis found;
  double largest_z = 0.0;
  for (const PoseSample& s : line.results.front()->boresight.samples)
    first = first.cwiseMax(s.error.displacement.cwiseAbs());
  const RunResult& heaviest = *line.results.back();
  for (std::size_t i = 0; i < heaviest.time.size(); ++i) {
    const Vec3 now = heaviest.boresight.samples[i].error.displacement.cwiseAbs();
    last = last.cwiseMax(now);
    if (now.z() > largest_z) {
      largest_z = now.z();
      found.time_of_z = heaviest.time[i];
    }
  }
  found.growth = last - first;
  return found;
}

std::optional<LeastOffTheBore> least_off_the_bore(const SweepLine& line) {
  LeastOffTheBore found;
  for (const RunResult* result : line.results) {
    const std::optional<double> share = off_the_bore_share(*result);
    if (!share) return std::nullopt;
    found.share.push_back(*share);
  }
  found.point =
      static_cast<std::size_t>(std::min_element(found.share.begin(), found.share.end()) - found.share.begin());
  found.interior = line.size() > 2 && found.point > 0 && found.point + 1 < line.size();
  return found;
}

std::optional<ImpactIntervals> impact_intervals(const RunResult& result) {
  constexpr std::size_t kFastest = 20;
  std::vector<const ContactEvent*> events;
  for (const ContactEvent& e : result.events) events.push_back(&e);
  if (events.size() < 10) return std::nullopt;
  std::sort(events.begin(), events.end(), [](const auto* a, const auto* b) { return a->start_speed > b->start_speed; });
  events.resize(std::min(kFastest, events.size()));
  std::sort(events.begin(), events.end(), [](const auto* a, const auto* b) { return a->start < b->start; });
  const std::size_t n = events.size();
  return ImpactIntervals{n, (events[4]->start - events[0]->start) / 4.0,
                         (events[n - 1]->start - events[n - 5]->start) / 4.0};
}

std::vector<BestLoads> best_loads(const SweepPlan& plan, const SweepResult& result, std::size_t clearance,
                                  std::size_t load) {
  const auto& loads = plan.axes[load].values;
  const double least = *std::min_element(loads.begin(), loads.end()),
               most = *std::max_element(loads.begin(), loads.end());
  std::vector<BestLoads> found;
  for (const double c : plan.axes[clearance].values) {
    const SweepPoint *steadiest = nullptr, *best = nullptr;
    for (const SweepPoint& p : result.points) {
      if (p.status != SweepPoint::Status::done || p.values[clearance] != c) continue;
      if (!steadiest || free_flight_share(p.result) < free_flight_share(steadiest->result)) steadiest = &p;
      if (!best || p.result.index.position_error.max < best->result.index.position_error.max) best = &p;
    }
    if (!best) continue;
    const double steady = steadiest->values[load], exact = best->values[load];
    found.push_back({c, exact, steady, steady > least && steady < most, exact == least});
  }
  return found;
}

}  // namespace boresight
