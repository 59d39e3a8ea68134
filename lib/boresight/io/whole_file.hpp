// A file of text, whole: bounded, so that an endless device or a picture does not fill the memory.
#pragma once

#include <cstdint>
#include <string>

namespace boresight {

inline constexpr std::uintmax_t kLargestText = 16u << 20;  // bytes

// Its bytes. Throws InputError, with no line: no such file, a folder, a file that cannot be opened or is too large.
std::string read_whole_file(const std::string& path);

}  // namespace boresight
