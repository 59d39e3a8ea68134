// Play of the other kinds for a mechanism: guides, balls, crosses, pads and bearing pairs in joints that have none.
#pragma once

#include <cstdint>
#include <string>

namespace boresight::gauntlet {

// The file's text with [[clearance]] tables added; which ones hangs on the text alone. corners: some of its pads are rectangular.
std::string with_plays(const std::string& toml, bool corners = false);

// From this one on the pads of a seed may be: older seeds stay what they were.
inline constexpr std::uint64_t kFirstSeedWithCorners = 200'001;

}  // namespace boresight::gauntlet
