// The quasistatic rung: every journal rests where the ideal joint's reaction pushes it. No impacts, no vibration.
#pragma once

#include "boresight/rungs/rung.hpp"

namespace boresight {

std::unique_ptr<Rung> make_quasistatic(std::shared_ptr<const Mechanism> mechanism);

// The same figures for those who want nothing else: what dynamics say of their error, which takes some motions, is not looked for.
std::unique_ptr<Rung> make_rests(std::shared_ptr<const Mechanism> mechanism);

}  // namespace boresight
