#include "boresight/formulations/singular_pose.hpp"

#include <cstdio>

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

}  // namespace boresight
