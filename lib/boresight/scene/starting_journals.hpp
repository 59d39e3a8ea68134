// Where the journals of a mechanism start, before anything is integrated: for `check`.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/ideal_motion.hpp"

namespace boresight {

struct StartingJournals {
  struct Journal {
    std::string joint;
    Vec3 offset = Vec3::Zero();  // from the middle of the sleeve, sleeve frame [m]
    Vec3 slope = Vec3::Zero();   // of its axis, sleeve frame, y zero
  };
  std::vector<Journal> journals;  // per clearance
  std::string warning;            // where journals were to rest and do not
  std::string remark;             // that loads tip them over (tipping.hpp)
  std::string undecided;          // that nothing holds some of them along part of their play (tipping.hpp)
};

// Of the mechanism as these parameters' standing errors build it. ideal: the motion of the drawn one, which its drives are told to make.
// Throws ComputationError where the built mechanism's joints do not close.
StartingJournals starting_journals(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal);

}  // namespace boresight
