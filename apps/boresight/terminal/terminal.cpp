#include "terminal/terminal.hpp"

#include <algorithm>
#include <cstdint>

namespace boresight::app {
namespace {

// How many bytes the UTF-8 character at `at` has, and its number; 0 bytes where there is none.
std::size_t character(const std::string& text, std::size_t at, std::uint32_t& number) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(at);
  const std::size_t size = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  if (size == 0 || at + size > text.size()) return 0;
  number = size == 1 ? first : first & (0x7fu >> size);
  for (std::size_t k = at + 1; k < at + size; ++k) {
    if (byte(k) >> 6 != 2) return 0;
    number = number << 6 | (byte(k) & 0x3fu);
  }
  return size;
}

bool steers(std::uint32_t c) {
  const bool control = (c < 0x20 && c != '\n' && c != '\t') || (c >= 0x7f && c < 0xa0);
  const bool direction =
      c == 0x061c || (c >= 0x200e && c <= 0x200f) || (c >= 0x202a && c <= 0x202e) || (c >= 0x2066 && c <= 0x2069);
  return control || direction;
}

}  // namespace

std::string printable(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::uint32_t number = 0;
    const std::size_t size = character(text, at, number);
    if (size == 0) {
      out += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[at++]));
      continue;
    }
    if (steers(number))
      out += number < 0x80 ? fmt::format("\\x{:02x}", number) : fmt::format("\\u{:04x}", number);
    else
      out.append(text, at, size);
    at += size;
  }
  return out;
}

std::string shell_word(const std::string& text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string("_-./:=,+%@").find(c) != std::string::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace boresight::app
