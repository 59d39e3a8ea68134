#include "exchange/utf8.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace boresight::app {

std::size_t first_byte_not_utf8(const std::string& text) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  for (std::size_t at = 0; at < text.size();) {
    const unsigned char first = byte(at);
    const std::size_t size = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
    if (size == 0 || at + size > text.size()) return at;
    std::uint32_t number = size == 1 ? first : first & (0x7fu >> size);
    for (std::size_t k = at + 1; k < at + size; ++k) {
      if (byte(k) >> 6 != 2) return at;
      number = number << 6 | (byte(k) & 0x3fu);
    }
    // Not a number that fewer bytes hold, not half a letter of UTF-16, nothing beyond the last letter of Unicode.
    constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
    if (number < kLeast[size] || (number >= 0xd800 && number < 0xe000) || number > 0x10ffff) return at;
    at += size;
  }
  return std::string::npos;
}

std::string byte_in_words(char byte) { return fmt::format("the byte 0x{:02X}", static_cast<unsigned char>(byte)); }

}  // namespace boresight::app
