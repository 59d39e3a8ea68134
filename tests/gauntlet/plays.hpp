// Play of the other kinds for a mechanism: guides, balls, crosses, pads and bearing pairs in joints that have none.
#pragma once

#include <string>

namespace boresight::gauntlet {

// The file's text with [[clearance]] tables added; which ones hangs on the text alone.
std::string with_plays(const std::string& toml);

}  // namespace boresight::gauntlet
