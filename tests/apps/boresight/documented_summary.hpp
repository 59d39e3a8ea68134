// apps/boresight/summary.md: which keys of summary.json it explains.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace boresight::app {

// Keys of the summary, and of the entries within them, that neither the part on every verb nor that on its own one names.
std::vector<std::string> unexplained_keys(const nlohmann::json& summary);

// Keys that a row explains and that nothing in the program's sources writes.
std::vector<std::string> keys_without_a_source();

}  // namespace boresight::app
