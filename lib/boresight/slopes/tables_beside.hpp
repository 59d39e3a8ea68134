// A parameter that the scene's tables hang on, a mass say, beside those of the contacts: tables for a little less and a little more of it. What
// lies between them, over how far they are apart, is how the tables follow it.
#pragma once

#include <memory>

#include "boresight/scene/clearance_scene.hpp"

namespace boresight {

struct TablesBeside {
  int parameter = 0;   // among those varied
  double apart = 0.0;  // of its values
  std::shared_ptr<const SceneTables> less, more;
};

}  // namespace boresight
