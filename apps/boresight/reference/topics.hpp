// What holds for every key: how values are written, what paths and expressions are, how an editor completes files.
#pragma once

#include <string>
#include <vector>

namespace boresight::app {

struct Topic {
  std::string name;  // "units"
  std::string title;
  std::vector<std::string> paragraphs;  // one that begins with a blank is shown as it is written
};

const std::vector<Topic>& topics();

}  // namespace boresight::app
