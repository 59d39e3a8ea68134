#include "boresight_analyses/sweep/sweep_line.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace boresight {

SweepLine line_along(const SweepPlan& plan, const SweepResult& result, std::size_t axis) {
  SweepLine line;
  line.axis = &plan.axes[axis];
  std::vector<std::size_t> points;
  for (std::size_t k = 0; k < result.points.size(); ++k) {
    bool held = result.points[k].status == SweepPoint::Status::done;
    for (std::size_t i = 0; i < plan.axes.size(); ++i)
      held = held && (i == axis || result.points[k].values[i] == plan.axes[i].values.front());
    if (held) points.push_back(k);
  }
  std::sort(points.begin(), points.end(), [&](std::size_t a, std::size_t b) {
    return result.points[a].values[axis] < result.points[b].values[axis];
  });
  for (const std::size_t k : points) {
    line.values.push_back(result.points[k].values[axis]);
    line.point.push_back(k);
    line.results.push_back(&result.points[k].result);
  }
  return line;
}

double peak_acceleration(const RunResult& result) { return result.platform_acceleration_max.maxCoeff(); }

double free_flight_share(const RunResult& result) {
  double share = 0.0;
  for (const ContactSummary& c : result.contact) share = std::max(share, 1.0 - c.contact_fraction);
  return share;
}

std::optional<double> off_the_bore_share(const RunResult& result) {
  if (result.events.empty() || result.end_time <= 0.0) return std::nullopt;
  // Of a journal that tilts, either end may touch, or both at once.
  std::vector<std::pair<double, double>> spans;
  for (const ContactEvent& e : result.events)
    if (e.clearance == 0 && (e.place == ContactPlace::radial || e.place == ContactPlace::radial_minus ||
                             e.place == ContactPlace::radial_plus))
      spans.emplace_back(e.start, e.start + e.duration);
  std::sort(spans.begin(), spans.end());
  double touching = 0.0, until = 0.0;
  for (const auto& [start, end] : spans) {
    touching += std::max(0.0, end - std::max(start, until));
    until = std::max(until, end);
  }
  return std::max(0.0, 1.0 - touching / result.end_time);
}

std::optional<Vec3> acceleration_disturbance(const RunResult& result) {
  if (result.boresight.samples.empty()) return std::nullopt;
  Vec3 most = Vec3::Zero();
  for (const PoseSample& s : result.boresight.samples) most = most.cwiseMax((s.a - s.ideal_a).cwiseAbs());
  return most;
}

double largest_force(const RunResult& result) {
  double force = 0.0;
  for (const ContactSummary& c : result.contact) force = std::max(force, c.max_force);
  return force;
}

double fastest_impact(const RunResult& result) {
  double speed = 0.0;
  for (const ContactSummary& c : result.contact) speed = std::max(speed, c.max_impact_speed);
  return speed;
}

double impacts(const RunResult& result) {
  return std::accumulate(result.contact.begin(), result.contact.end(), 0.0,
                         [](double sum, const ContactSummary& c) { return sum + static_cast<double>(c.impacts); });
}

std::optional<double> angular_acceleration_disturbance(const RunResult& result) {
  if (result.boresight.samples.empty()) return std::nullopt;
  double difference = 0.0, ideal = 0.0;
  for (const PoseSample& s : result.boresight.samples) {
    difference = std::max(difference, (s.alpha - s.ideal_alpha).norm());
    ideal = std::max(ideal, s.ideal_alpha.norm());
  }
  if (ideal <= 0.0) return std::nullopt;
  return difference / ideal;
}

std::optional<MeanContact> mean_contact(const RunResult& result, double hertz_stiffness) {
  if (result.clearances.empty() || result.clearances.front().empty() || hertz_stiffness <= 0.0) return std::nullopt;
  MeanContact mean;
  std::size_t touching = 0;
  for (const ClearanceSample& s : result.clearances.front()) {
    if (s.contact != 1) continue;  // the bore alone: Hertz speaks of it
    mean.penetration += std::max(0.0, s.penetration);
    mean.force += s.normal_force;
    mean.hertz += std::pow(std::max(0.0, s.normal_force) / hertz_stiffness, 2.0 / 3.0);
    ++touching;
  }
  if (touching == 0) return std::nullopt;
  const double n = static_cast<double>(touching);
  return MeanContact{mean.penetration / n, mean.force / n, mean.hertz / n};
}

bool rises(const std::vector<double>& values, double tolerance) {
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] - values[i - 1] > tolerance * std::max(std::abs(values[i]), std::abs(values[i - 1])))) return false;
  return values.size() > 1;
}

bool falls(const std::vector<double>& values, double tolerance) {
  return rises(std::vector<double>(values.rbegin(), values.rend()), tolerance);
}

double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n, my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xy = 0.0, xx = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mx) * (y[i] - my);
    xx += (x[i] - mx) * (x[i] - mx);
  }
  return xx > 0.0 ? xy / xx : 0.0;
}

}  // namespace boresight
