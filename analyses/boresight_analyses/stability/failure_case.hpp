// The cases in which a method or a model fails, each with what happens, what the program does, and what was
// measured of it just now on the mechanism at hand.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "boresight/io/document.hpp"
#include "boresight_analyses/stability/baumgarte_drift.hpp"
#include "boresight_analyses/stability/followed_motion.hpp"
#include "boresight_analyses/stability/predictability.hpp"
#include "boresight_analyses/stability/settling_contact.hpp"

namespace boresight {

struct FailureCase {
  enum class Standing {
    behaves,   // the program did what is said of it
    differs,   // it did not
    not_here,  // nothing on this mechanism shows it
  };
  std::string name;
  std::string happens;   // what happens there
  std::string program;   // what the program does
  std::string measured;  // now, on this mechanism
  Standing standing = Standing::not_here;
};
const char* to_string(FailureCase::Standing standing);

// What the cases are measured on; computed once.
struct Scene {
  std::shared_ptr<const Mechanism> mechanism;
  const IdealMotion* ideal = nullptr;  // null: it cannot be followed
  std::string infeasible;              // why, then
  std::vector<ContactFrequency> contacts;
  const FollowedMotion* followed = nullptr;  // null: no rung can follow the motion
  // Reads the mechanism's file again with one more setting and throws what its reader throws; may be empty.
  std::function<void(const Setting&)> reread;

  int stiffest() const;  // index among the contacts; -1 if there are none
};

// --- One function a case; each runs alone. ---
FailureCase case_of_a_large_step(const Scene& scene);
FailureCase case_of_no_stabilisation(const Scene& scene);
FailureCase case_of_baumgarte_gains(const BaumgarteMap& map);
FailureCase case_of_a_singular_pose(const Scene& scene);
FailureCase case_of_redundant_rows(const Scene& scene);
FailureCase case_of_vanishing_clearance(const Scene& scene);
FailureCase case_of_vanishing_restitution(const Scene& scene);
FailureCase case_of_chatter(const Scene& scene, const Settling& pair, const Settling& l_stable, double omega);
FailureCase case_of_creep(const Scene& scene);
FailureCase case_of_chaos(const Scene& scene, const std::vector<Separation>& separations);
FailureCase case_of_large_clearance(const Scene& scene);

}  // namespace boresight
