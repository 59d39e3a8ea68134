// The ideal joints' reactions r(t) and the pose gain E(t) of one set of parameters, instant by instant: what the rungs
// without dynamics walk along.
#pragma once

#include <vector>

#include "boresight/rungs/clearance_scene.hpp"
#include "boresight/rungs/resting_journal.hpp"
#include "boresight/rungs/run_result.hpp"

namespace boresight {

class ReactionTable {
 public:
  ReactionTable(const Mechanism& mechanism, const ClearanceScene& scene, const Parameters& parameters);

  struct Instant {
    double t;
    VecX reaction;                                   // on the journals, sleeve axes, n numbers [N]
    Eigen::Matrix<double, 6, Eigen::Dynamic> pose_gain;  // E
  };
  int instants() const { return instants_; }
  Instant at(int instant) const;
  const std::vector<JournalInSleeve>& joints() const { return joints_; }

  // One per joint, named, in lasting contact.
  std::vector<ContactSummary> summaries() const;
  // Adds a rest's forces and deflections to a summary.
  void note(const Rest& rest, ContactSummary& summary) const;

 private:
  const Mechanism& mechanism_;
  int n_, instants_;
  double spacing_;
  TimeTable table_;  // r (n), then E (6 x n)
  std::vector<JournalInSleeve> joints_;
};

}  // namespace boresight
