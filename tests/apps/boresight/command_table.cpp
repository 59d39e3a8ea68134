#include "command_table.hpp"

#include <utility>

namespace boresight::app {

std::vector<TableCommand> commands() {
  std::vector<TableCommand> all;
  for (const auto& some : {commands_on_the_paper, commands_on_calibration, commands_on_other_examples,
                           commands_on_errors, commands_on_imports, commands_on_two_bearings})
    for (TableCommand& c : some()) all.push_back(std::move(c));
  return all;
}

}  // namespace boresight::app
