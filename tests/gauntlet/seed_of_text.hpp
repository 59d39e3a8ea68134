// A seed that is the same wherever the text is.
#pragma once

#include <cstdint>
#include <string>

namespace boresight::gauntlet {

inline std::uint64_t seed_of_text(const std::string& text) {  // FNV-1a
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

}  // namespace boresight::gauntlet
