#include "boresight/keys/letters.hpp"

namespace boresight {

Letter letter_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned char first = byte(at);
  const std::size_t size = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  if (size == 0 || at + size > text.size()) return {};
  std::uint32_t number = size == 1 ? first : first & (0x7fu >> size);
  for (std::size_t k = at + 1; k < at + size; ++k) {
    if (byte(k) >> 6 != 2) return {};
    number = number << 6 | (byte(k) & 0x3fu);
  }
  return {size, number};
}

std::size_t letters_in(std::string_view text) {
  std::size_t letters = 0;
  for (std::size_t at = 0; at < text.size(); at += letter_at(text, at).size) ++letters;
  return letters;
}

std::string first_letters(std::string_view text, std::size_t count) {
  std::size_t at = 0;
  for (; count > 0 && at < text.size(); --count) at += letter_at(text, at).size;
  return std::string(text.substr(0, at));
}

std::string shortened(std::string_view text, std::size_t most, std::size_t shown, std::string_view mark) {
  if (letters_in(text) <= most) return std::string(text);
  return first_letters(text, shown).append(mark);
}

}  // namespace boresight
