// Reads a mechanism file (TOML) into a `MechanismDescription`.
//
//   const MechanismDescription scene = read_mechanism("3-rrcpr.toml", {parse_setting("clearance.F1.radial=0.2mm")});
//
// examples/3-rrcpr/3-rrcpr.toml documents the format. Whatever is wrong with the file or a setting is an InputError of one line:
// file, line, key, what was found, what was expected, and the nearest known name.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "boresight/io/document.hpp"
#include "boresight/mechanism/description.hpp"

namespace boresight {

MechanismDescription read_mechanism(const std::string& path, const std::vector<Setting>& settings = {});

// The same from text in memory; `filename` is what errors name.
MechanismDescription read_mechanism_text(std::string_view text, const std::string& filename,
                                         const std::vector<Setting>& settings = {});

// Every path of the file that a setting may name, sorted: "clearance.F1.radial", "motion.duration". Throws what read_mechanism throws.
std::set<std::string> settable_paths(const std::string& path, const std::vector<Setting>& settings = {});

// How every number that the file or a setting gives is written there, by its path: {"clearance.F1.radial", "0.1 mm"}. Throws as the above.
std::map<std::string, std::string> written_values(const std::string& path, const std::vector<Setting>& settings = {});

}  // namespace boresight
