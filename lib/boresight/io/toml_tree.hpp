// TOML text into a tree of `Node`s: the only place that knows which TOML library is used.
#pragma once

#include <string>
#include <string_view>

#include "boresight/io/document.hpp"

namespace boresight {

// Throws InputError with the line of the first fault in the TOML.
Node parse_toml(std::string_view text, const std::string& filename);

}  // namespace boresight
