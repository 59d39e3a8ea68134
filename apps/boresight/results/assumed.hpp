// What the mechanism file leaves out and results hang on, said where results are: summary.json, reports, terminal.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "boresight/io/assumed_values.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "command_line/command.hpp"

namespace boresight::app {

// Of the file that the mechanism was read from, with the command's settings.
std::vector<AssumedValue> assumed_by(const Command& command, const Mechanism& mechanism);

// {"clearance.F1.contact.young": "72 GPa", ...}
nlohmann::ordered_json assumed_json(const std::vector<AssumedValue>& assumed);

// Sentences about joints whose material or restitution nobody gave: results then are those of another joint.
std::vector<std::string> material_warnings(const std::vector<AssumedValue>& assumed);

// A verb's warnings on the terminal, and after them those sentences: every verb that computes with a mechanism's contacts says them once.
void tell_warnings(const std::vector<std::string>& warnings, const Command& command, const Mechanism& mechanism);

}  // namespace boresight::app
