// Sentences with numbers in them.
#pragma once

#include <cstdio>
#include <string>

namespace boresight {

// printf into a string; at most 700 characters.
template <typename... Arguments>
std::string text(const char* format, Arguments... arguments) {
  char buffer[700];
  std::snprintf(buffer, sizeof buffer, format, arguments...);
  return buffer;
}

}  // namespace boresight
