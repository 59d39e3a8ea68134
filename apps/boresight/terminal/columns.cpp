#include "terminal/columns.hpp"

#include "boresight/keys/letters.hpp"

namespace boresight::app {
namespace {

struct LetterRange {
  std::uint32_t first, last;
};

// Combining marks, joiners and selectors of a letter's shape.
constexpr LetterRange kNoColumn[] = {{0x300, 0x36f}, {0x200b, 0x200d}, {0x20d0, 0x20ff}, {0xfe00, 0xfe0f}};
// Unicode Standard Annex 11: wide and full width.
constexpr LetterRange kTwoColumns[] = {{0x1100, 0x115f},   {0x2329, 0x232a},  {0x2e80, 0x303e},   {0x3040, 0xa4cf},
                                       {0xac00, 0xd7a3},   {0xf900, 0xfaff},  {0xfe10, 0xfe19},   {0xfe30, 0xfe6f},
                                       {0xff00, 0xff60},   {0xffe0, 0xffe6},  {0x1f300, 0x1f64f}, {0x1f900, 0x1f9ff},
                                       {0x20000, 0x2fffd}, {0x30000, 0x3fffd}};

template <std::size_t N>
bool lies_in(const LetterRange (&ranges)[N], std::uint32_t letter) {
  for (const LetterRange& range : ranges)
    if (letter >= range.first && letter <= range.last) return true;
  return false;
}

std::size_t columns_of_letter(std::uint32_t letter) {
  return lies_in(kNoColumn, letter) ? 0 : lies_in(kTwoColumns, letter) ? 2 : 1;
}

}  // namespace

std::size_t columns_in(std::string_view text) {
  std::size_t columns = 0;
  for (std::size_t at = 0; at < text.size();) {
    const Letter letter = letter_at(text, at);
    columns += columns_of_letter(letter.number);
    at += letter.size;
  }
  return columns;
}

std::string padded(std::string_view text, std::size_t columns) {
  const std::size_t own = columns_in(text);
  return std::string(text).append(own < columns ? columns - own : 0, ' ');
}

std::string first_columns(std::string_view text, std::size_t columns) {
  std::size_t at = 0;
  while (at < text.size()) {
    const Letter letter = letter_at(text, at);
    const std::size_t taken = columns_of_letter(letter.number);
    if (taken > columns) break;
    columns -= taken;
    at += letter.size;
  }
  return std::string(text.substr(0, at));
}

}  // namespace boresight::app
