// What one axis of a sweep shows with the other axes held at their first value: the numbers its findings are
// made of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/sweep/sweep.hpp"

namespace boresight {

struct SweepLine {
  const SweepAxis* axis = nullptr;
  std::vector<double> values;      // SI, ascending
  std::vector<std::size_t> point;  // index in the plan
  std::vector<const RunResult*> results;

  std::size_t size() const { return values.size(); }
};

// Done points only.
SweepLine line_along(const SweepPlan& plan, const SweepResult& result, std::size_t axis);

// Taken from one result.
double peak_acceleration(const RunResult& result);  // largest of the three axes [m/s^2]
double free_flight_share(const RunResult& result);  // of the joint that flies most
// Share of the time in which the journal of the first clearance does not touch the bore, whatever the end
// faces do; from the events.
std::optional<double> off_the_bore_share(const RunResult& result);
// Largest difference between true and ideal acceleration, per world axis; from the histories.
std::optional<Vec3> acceleration_disturbance(const RunResult& result);
double largest_force(const RunResult& result);   // [N]
double fastest_impact(const RunResult& result);  // [m/s]
double impacts(const RunResult& result);
// Largest difference between true and ideal angular acceleration over the largest ideal one; from the
// histories.
std::optional<double> angular_acceleration_disturbance(const RunResult& result);
// Means over the samples in which the first clearance's joint touches.
struct MeanContact {
  double penetration = 0.0;  // [m]
  double force = 0.0;        // [N]
  double hertz = 0.0;        // mean of (F / K)^(2/3), the penetration that Hertz gives for the same forces [m]
};
std::optional<MeanContact> mean_contact(const RunResult& result, double hertz_stiffness);

// Whether the values only rise (or only fall), each by more than `tolerance` of the larger one.
bool rises(const std::vector<double>& values, double tolerance = 0.005);
bool falls(const std::vector<double>& values, double tolerance = 0.005);
// Slope of the least-squares line through the points.
double slope(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace boresight
