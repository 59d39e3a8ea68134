// The ladder: every rung by its name, cheapest first. A new rung is one line of ladder.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boresight/rungs/rung.hpp"

namespace boresight {

// The rungs by name, cheapest first.
std::vector<std::string> rung_names();
// Throws std::invalid_argument for an unknown name.
std::unique_ptr<Rung> make_rung(const std::string& name, std::shared_ptr<const Mechanism> mechanism);

}  // namespace boresight
