// What --help says, for verbs that show it: without the headers of the library that reads the command line.
#pragma once

#include <string>
#include <vector>

namespace boresight::app {

std::string help_of_program();
std::string help_of_verb(const std::string& verb);  // "" for another word
std::vector<std::string> verb_names();

}  // namespace boresight::app
