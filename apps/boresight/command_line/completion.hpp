// Completion of verbs, options and their words in a shell, written from the command line's own description.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace boresight::app {

// The shells that completion_script() knows.
const std::vector<std::string>& completion_shells();

// A script to be read by the shell: bash, zsh or fish. Throws std::invalid_argument for another.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace boresight::app
