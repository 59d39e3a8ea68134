// Standing errors for a mechanism that has none: some lengths, axes and drives that are off, of a size that workshops make.
#pragma once

#include <string>

namespace boresight::gauntlet {

// The file's text with [[error]] tables added; which ones hangs on the text alone.
std::string with_errors(const std::string& toml);

}  // namespace boresight::gauntlet
