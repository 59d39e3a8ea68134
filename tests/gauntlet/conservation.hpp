// What a motion must keep: its momentum where nothing holds it, its energy where nothing drives it.
#pragma once

#include <memory>

#include "boresight/mechanism/mechanism.hpp"
#include "verdict.hpp"

namespace boresight::gauntlet {

void check_momentum(const std::shared_ptr<const Mechanism>& mechanism, const Limits& limits, Verdict& verdict);
void check_energy(const std::shared_ptr<const Mechanism>& mechanism, const Limits& limits, Verdict& verdict);

}  // namespace boresight::gauntlet
