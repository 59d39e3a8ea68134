// The scene that lanes step in: as fine in time as the accelerations of their own form of it need.
#pragma once

#include <memory>

#include "boresight/scene/scene_rung.hpp"

namespace boresight {

SceneForm lane_form(const SceneLayout& layout);

// A scene's grid holds the accelerations A r, A C ... between its knots to ClearanceScene::kAccuracy. Where lanes divide forces by masses
// themselves, large forces that nearly cancel (a long sleeve's couple) leave more of what is missed: the grid is refined until A r is held
// as well from M and r. Throws what ClearanceScene throws.
std::shared_ptr<const PreparedScene> scene_for_lanes(const Mechanism& mechanism, const Parameters& parameters);

}  // namespace boresight
