// Poses and rows: cases whose cause is the mechanism's own geometry.
#include <algorithm>

#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/kinematic_report.hpp"
#include "boresight_analyses/stability/failure_case.hpp"
#include "boresight_analyses/stability/text.hpp"

namespace boresight {

FailureCase case_of_a_singular_pose(const Scene& scene) {
  FailureCase c{.name = "Singular pose",
                .happens = "the Jacobian loses rank, a motion is lost",
                .program = "names the lost motion and the time",
                .measured = {}};
  const KinematicReport report = analyse_kinematics(*scene.mechanism);
  if (!report.lost.empty()) {
    c.measured = text("at t = %.4g s: ", report.lost.front().t) + report.lost.front().description;
    c.standing = FailureCase::Standing::behaves;
    return c;
  }
  if (!report.feasible) {
    c.measured = report.findings.empty() ? scene.infeasible : report.findings.front();
    c.standing = FailureCase::Standing::behaves;
    return c;
  }
  c.measured = "none on this motion";
  if (!report.along.empty()) {
    const auto nearest = std::min_element(report.along.begin(), report.along.end(), [](const auto& a, const auto& b) {
      return a.smallest_singular_value < b.smallest_singular_value;
    });
    c.measured += text("; nearest at t = %.3g s, where the smallest singular value is %.3g", nearest->t,
                       nearest->smallest_singular_value);
  }
  return c;
}

FailureCase case_of_redundant_rows(const Scene& scene) {
  FailureCase c{.name = "Redundant constraint rows",
                .happens = "the equations of motion become singular",
                .program = "bears redundancy that is consistent, refuses what contradicts itself",
                .measured = {}};
  const KinematicReport report = analyse_kinematics(*scene.mechanism, 21);
  if (report.redundant_rows == 0) {
    c.measured = text("%d rows, all independent", report.constraint_rows);
    return c;
  }
  c.measured = text("%d of %d rows are redundant; ", report.redundant_rows, report.constraint_rows);
  if (scene.followed) {
    c.measured += "the motion was followed with them by " + scene.followed->rung->name();
    c.standing = FailureCase::Standing::behaves;
  } else {
    c.measured += scene.infeasible;
    c.standing = scene.infeasible.empty() ? FailureCase::Standing::differs : FailureCase::Standing::behaves;
  }
  return c;
}

}  // namespace boresight
