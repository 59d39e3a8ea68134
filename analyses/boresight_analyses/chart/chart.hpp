// boresight chart: accuracy against speed, every way of computing the motion of one mechanism, measured now,
// on this machine.
//
//   ChartResult result = make_chart(mechanism, mechanism->parameters(), {});
//   result.points[result.front.back()]  // the most accurate of the Pareto front
#pragma once

#include "boresight_analyses/chart/free_flight.hpp"
#include "boresight_analyses/chart/machine.hpp"
#include "boresight_analyses/chart/reference.hpp"
#include "boresight_analyses/chart/setups.hpp"
#include "boresight_analyses/runs/kept_results.hpp"

namespace boresight {

struct ChartOptions {
  IndexChoice index;
  double most_seconds = 3.0;       // of CPU for one run, beyond which it is given up
  double total_seconds = 60.0;     // of CPU for all, beyond which no further way is begun
  double reference_target = 1e-5;  // relative uncertainty of the reference that is good enough
  double reference_seconds = 9.0;  // of CPU for the reference
  bool flight = true;              // also the trajectory error before the first impact
  // Called with the share done (of an estimate) and what comes next; return false to stop.
  std::function<bool(double, const std::string&)> progress = {};
  // Where what was measured is kept as it is done, and an earlier start's is found, with the times that it took; none: nowhere.
  KeptResults* kept = nullptr;
};

struct ChartPoint {
  RungSetup setup;
  std::string family;
  Measurement measured;
  double error = 0.0;  // relative, of the index; see relative_error
  bool papers = false;
};

struct ChartResult {
  std::string index, unit;
  Reference reference;
  std::vector<ChartPoint> points;  // family by family, coarse to fine; refused ones too
  std::vector<std::size_t> front;  // Pareto: fastest first, each more accurate than all faster ones
  FreeFlight flight;
  Machine machine;
  std::vector<std::string> left_out;  // families for which there was no time
  bool interrupted = false;

  const ChartPoint* papers() const;  // null if it was not reached or refused
  // The cheapest point that comes within an accuracy; null if none does.
  const ChartPoint* cheapest_within(double accuracy) const;
};

// Indices of the points that no other beats in both error and CPU time. Errors below `floor` count as equal
// to it: what the reference cannot tell apart is no progress.
std::vector<std::size_t> pareto_front(const std::vector<ChartPoint>& points, double floor);

// Throws ComputationError where not even multibody can follow the motion.
ChartResult make_chart(const std::shared_ptr<const Mechanism>& mechanism, const Parameters& parameters,
                       const ChartOptions& options);

}  // namespace boresight
