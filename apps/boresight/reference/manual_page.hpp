// The manual page, boresight(1): verbs and topics as roff, from the same texts as help and the reference page.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace boresight::app {

// summary: one line of what the program is for. helps: every verb with its --help.
std::string manual_page(const std::string& summary, const std::vector<std::pair<std::string, std::string>>& helps);

}  // namespace boresight::app
