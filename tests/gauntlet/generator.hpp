// A mechanism from a seed: the same seed gives the same text on any machine.
#pragma once

#include <cstdint>

#include "scene.hpp"

namespace boresight::gauntlet {

Scene generate(std::uint64_t seed);

}  // namespace boresight::gauntlet
