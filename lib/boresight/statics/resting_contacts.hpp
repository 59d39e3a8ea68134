// What joints at rest carry over a motion, summed up instant by instant.
#pragma once

#include <vector>

#include "boresight/statics/reaction_table.hpp"

namespace boresight {

class RestingContacts {
 public:
  // start: what comes before is left out [s].
  RestingContacts(const ReactionTable& reactions, double start);

  // Where the joints rest at time t and the loads that put them there; in order of time.
  void note(double t, const std::vector<RestingPlay>& rest);

  // One per joint, named. A journal that nothing presses on its sleeve is not in contact, whatever it may lie near.
  std::vector<ContactSummary> finish() const;

 private:
  double start_, first_ = 0.0, last_ = 0.0;  // the first and the last instant noted [s]
  bool noted_ = false;
  std::vector<ContactSummary> summary_;
  std::vector<bool> touches_;     // at the last instant
  std::vector<double> touching_;  // time in contact [s]
};

}  // namespace boresight
