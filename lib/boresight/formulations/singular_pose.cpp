#include "boresight/formulations/singular_pose.hpp"

#include <cstdio>

#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/rank_analysis.hpp"

namespace boresight {
namespace {

std::string message(const Mechanism& mechanism, const ConstraintSystem& rows, double t) {
  const RankAnalysis rank = analyse_rank(mechanism, rows);
  const int body = mechanism.boresight_body();
  char time[40];
  std::snprintf(time, sizeof time, "%.6g", t);
  return std::string("singular pose at t = ") + time + " s: the constraints lose rank, \"" +
         mechanism.description().bodies[body].name + "\" " + describe_motion(mechanism, rank.least_resisted, body) +
         " while every drive stands still; `boresight check` shows where";
}

}  // namespace

SingularPose::SingularPose(const Mechanism& mechanism, const ConstraintSystem& rows, double when)
    : ComputationError(message(mechanism, rows, when)), t(when) {}

bool rows_are_redundant(const Mechanism& mechanism, const IdealMotion* drives, ClearanceRows clearance,
                        const IdealState& here) {
  ConstraintSystem rows(mechanism, {.clearance = clearance});
  std::vector<TimeValue> laws(mechanism.joints());
  const auto evaluate = [&](const IdealState& at) {
    if (drives) drives->drive_laws(at.t, laws);
    rows.evaluate(at.bodies, laws);
  };
  evaluate(here);
  const int rank = constraint_rank(mechanism, rows);
  if (rank == rows.row_count()) return false;
  if (drives) {
    IdealState elsewhere;
    drives->state(generic_instant(here.t, drives->duration()), elsewhere);
    evaluate(elsewhere);
    if (constraint_rank(mechanism, rows) > rank) {
      evaluate(here);
      throw SingularPose(mechanism, rows, here.t);
    }
  }
  return true;
}

}  // namespace boresight
