// The quasistatic rung: every journal rests where the ideal joint's reaction pushes it. No impacts, no vibration.
#pragma once

#include "boresight/rungs/rung.hpp"

namespace boresight {

std::unique_ptr<Rung> make_quasistatic(std::shared_ptr<const Mechanism> mechanism);

}  // namespace boresight
