// Texts of UTF-8 by their letters, which may take several bytes: how long a text is, and where it may be cut.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace boresight {

// What stands at a byte that begins no letter of UTF-8: it counts as one.
inline constexpr std::uint32_t kNoLetter = 0xffffffff;
struct Letter {
  std::size_t size = 1;  // in bytes
  std::uint32_t number = kNoLetter;
};
Letter letter_at(std::string_view text, std::size_t at);

std::size_t letters_in(std::string_view text);
// All of a text that has no more.
std::string first_letters(std::string_view text, std::size_t count);
// As it is up to `most` letters; a longer one by its first `shown` and the mark.
std::string shortened(std::string_view text, std::size_t most, std::size_t shown, std::string_view mark = "...");

}  // namespace boresight
