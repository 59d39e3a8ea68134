// The reference as one page of HTML that works offline: verbs with their options, every key of every file, topics.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace boresight::app {

// helps: every verb with its --help.
std::string reference_page(const std::vector<std::pair<std::string, std::string>>& helps);

}  // namespace boresight::app
