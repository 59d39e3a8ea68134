// The commands that the documents tell a user to give: README.md and those of lib and tests, the pages and the comments of the examples, and what .ci/start runs.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace boresight::app {

struct DocumentedCommand {
  std::string document, text;  // text: as it stands there, blanks made one, comment and continuation taken off
};

// Those that call `boresight`, from blocks of code and from comments. Words in capitals stand for something else: those are left out.
std::vector<DocumentedCommand> documented_commands();
// Lines of code blocks of README.md that call something else.
std::set<std::string> other_documented_commands();
// As a shell would divide it, quotes taken off.
std::vector<std::string> shell_words(const std::string& command);

}  // namespace boresight::app
