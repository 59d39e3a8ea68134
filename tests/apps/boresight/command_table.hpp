// What README.md, the examples and .ci/start tell a user to give, and what they say of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "program.hpp"

namespace boresight::app {

// What a command left.
struct Left {
  Ended ended;
  nlohmann::json summary;
  std::function<std::string(const std::string&)> file;  // text of a file of its folder
  std::function<nlohmann::json(const std::vector<std::string>& options)>
      again;  // summary of the same command with more options
};

struct Edit {
  std::string file, what, with;
};

struct TableCommand {
  std::string text;
  std::vector<std::string> shorter = {};         // options that make it quick, and change nothing of what is claimed
  std::function<void(const Left&)> claims = {};  // what the text says of it
  std::vector<Edit> edits = {};                  // of the example's files, where no option makes it quick
  std::vector<std::string> before = {};          // commands whose results it takes
  int status = 0;
};

std::vector<TableCommand> commands();  // all of those below
std::vector<TableCommand> commands_on_the_paper();
std::vector<TableCommand> commands_on_calibration();
// On the starter template and on the other examples.
std::vector<TableCommand> commands_on_other_examples();
// About standing errors of lengths, axes, drives and temperature.
std::vector<TableCommand> commands_on_errors();
// About bearing pairs.
std::vector<TableCommand> commands_on_two_bearings();
// About mechanisms from other programs.
std::vector<TableCommand> commands_on_imports();

}  // namespace boresight::app
