// What `check` says of a mechanism's ideal motion: mobility, redundancy, and how near it comes to a singular pose.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/lost_motion.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight {

struct ConditioningSample {
  double t = 0.0;
  double smallest_singular_value = 0.0;  // of the scaled square Jacobian of all ideal rows
  double orientation = 0.0;  // inverse condition number of the map from the body's angular velocity to the drives
  double position = 0.0;     // the same from its velocity
};

struct KinematicReport {
  int bodies = 0, joints = 0, constraint_rows = 0;
  int rank = 0;            // of the joint rows at home and along the motion
  int redundant_rows = 0;  // rows minus rank
  int mobility = 0;        // 6 bodies - rank
  int drives = 0;
  int free_freedoms = 0;  // mobility not taken by drives or a prescribed pose
  std::vector<ConditioningSample> along;
  std::vector<LostMotion> lost;       // empty: no singular pose met
  std::vector<std::string> findings;  // sentences, most serious first
  std::vector<double> passed;  // [s] singular poses of a motion that is not all driven, which goes on through them
  bool feasible = true;        // the ideal motion exists from start to end
};

KinematicReport analyse_kinematics(const Mechanism& mechanism, int samples = 201);

class IdealMotion;

// `along` and `passed` of a motion simulated without clearance, which the report of its mechanism leaves empty. Empty again where no joint closes
// a loop; at fewer samples where loops are of so many bodies that all would take minutes.
void look_along(const Mechanism& mechanism, const IdealMotion& motion, KinematicReport& report, int samples = 201);

}  // namespace boresight
