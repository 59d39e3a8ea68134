// What a sweep varies, as the [sweep] table of a study file says it:
//
//   [[sweep.axis]]
//   parameter = ["clearance.F1.radial", "clearance.F1.axial"]   # one path, or several that take the same value
//   values = ["0.1 mm", "0.2 mm", "0.3 mm"]
//
//   [[sweep.axis]]
//   parameter = "payload.mass"
//   from = "0 kg"
//   to = "500 kg"
//   count = 11
//   scale = "linear"                                              # or "log"
//
// Several axes make a full grid; the last axis runs fastest.
#pragma once

#include <string>
#include <vector>

#include "boresight/io/cursor.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/study/legal_corners.hpp"

namespace boresight {

struct SweepAxis {
  std::vector<std::string> parameters;  // paths, all set to the same value
  std::string si_unit;                  // "m", "kg", "1", ...
  std::vector<double> values;           // SI
  std::string unit = {};                // in which they are written: "mm"; "" for pure numbers

  const std::string& name() const { return parameters.front(); }
};

struct SweepPlan {
  std::vector<SweepAxis> axes;
  std::string findings;  // whose published findings the sweep is held against: "sun-3-rrcpr", or "" for none

  std::size_t points() const;
  // The values of point `k`, one per axis.
  std::vector<double> values_at(std::size_t k) const;
  // The mechanism's own parameters with these values set.
  Parameters parameters_at(const Mechanism& mechanism, std::size_t k) const;
};

inline constexpr std::size_t kMostSweepPoints = 100'000;

// Reads the [sweep] table. Throws InputError, for points too that no mechanism's file may hold: see check_corners().
SweepPlan read_sweep_plan(Cursor& root, const MechanismDescription& mechanism, const AcceptsSetting& accepts,
                          const AcceptsSettings& accepts_all = {});

}  // namespace boresight
