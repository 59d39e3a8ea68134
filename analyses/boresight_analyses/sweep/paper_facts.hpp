// The facts by which the statements of Sun, Song and Wang on the 3-RRCPR mechanism with clearance (sections 4 and 5 of their
// paper) are judged: each a number, or a comparison, of a sweep's own results. What the paper says of them is the program's
// (apps/boresight/sweep/published_findings.cpp).
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/sweep/sweep_line.hpp"

namespace boresight {

// Whether this is a mechanism of the paper's kind: three legs of R, R, C, P and R, whose first and fourth joints are driven.
bool is_3_rrcpr(const MechanismDescription& mechanism);

// Which axes the paper speaks of: one over clearance.*.radial or .axial, one over payload.mass.
bool names_clearance(const SweepAxis& axis);
bool names_load(const SweepAxis& axis);

// Whether every clearance keeps journal and sleeve axes parallel.
bool parallel_axes(const Mechanism& mechanism);

// Whether the orientation stays the ideal one all along the line: a rotation is called none if it moves a point one
// characteristic length away by less than 1 % of the displacement error.
bool orientation_stays(const Mechanism& mechanism, const SweepLine& line);

// acceleration_disturbance() at each point of the line, and at how many of them world axis y has the largest part.
struct DisturbedDirections {
  std::vector<Vec3> disturbance;  // [m/s^2]
  int strongest_is_y = 0;
};
DisturbedDirections disturbed_directions(const SweepLine& line);

// mean_contact() at each point of the line; nothing if one of them has none.
std::optional<std::vector<MeanContact>> mean_contacts(const Mechanism& mechanism, const SweepPlan& plan,
                                                      const SweepLine& line);

// How the largest error per world axis grows from the line's first point to its last [m], and when the last one's error along
// z is largest [s]. The line's results must have histories.
struct GrowthPerAxis {
  Vec3 growth = Vec3::Zero();
  double time_of_z = 0.0;
};
GrowthPerAxis growth_per_axis(const SweepLine& line);

// The point at which the journal is away from the bore least, and whether it lies inside the line. Nothing where the contacts were not kept.
struct LeastOffTheBore {
  std::vector<double> share;  // at each point, of the time
  std::size_t point = 0;
  bool interior = false;
};
std::optional<LeastOffTheBore> least_off_the_bore(const SweepLine& line);

// Among the twenty fastest impacts of a run: how far the first five are apart on average, and the last five [s]. Nothing where
// there are fewer than ten.
struct ImpactIntervals {
  std::size_t impacts = 0;
  double early = 0.0, late = 0.0;
};
std::optional<ImpactIntervals> impact_intervals(const RunResult& result);

// For one clearance of a sweep over clearance and load: the loads of the smallest error and of the least free flight.
struct BestLoads {
  double clearance = 0.0, smallest_error = 0.0, least_flight = 0.0;
  bool interior = false;    // the second lies between the least and the largest load
  bool least_load = false;  // the first is the least load
};
// Those clearances at which a point was done.
std::vector<BestLoads> best_loads(const SweepPlan& plan, const SweepResult& result, std::size_t clearance,
                                  std::size_t load);

}  // namespace boresight
