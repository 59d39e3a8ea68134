// What the assumption about journal axes hides: the same scene at rest with axes parallel and free.
#pragma once

#include <optional>

#include "boresight/mechanism/mechanism.hpp"
#include "report/document.hpp"

namespace boresight::app {

struct AxesComparison {
  bool free = false;                                      // of the scene itself: at least one journal tilts
  double parallel_boresight = 0.0, free_boresight = 0.0;  // largest boresight error at rest [rad]
  double parallel_position = 0.0, free_position = 0.0;    // largest position error at rest [m]
  bool tells = false;                                     // the two differ, as they are printed
  std::string sentence;
};

// By the quasistatic rung. Nothing where it cannot be applied, or where a joint's sleeve has no length; nor where it takes too long, which
// left_out then says.
std::optional<AxesComparison> compare_axes(const Mechanism& mechanism, std::string& left_out);

}  // namespace boresight::app
