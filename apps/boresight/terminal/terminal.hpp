// What is said on the terminal. Texts that came from a file or the command line (names, paths, messages) may hold anything: control
// characters in them are shown as their numbers, so that none of them moves the cursor, colours or clears what others wrote.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace boresight::app {

// The text with control characters, characters that turn the direction of writing, and bytes that are no UTF-8 shown as \x1b or
// \u202e. Ends of lines and tabs stay.
std::string printable(const std::string& text);

// fmt::print() to standard output, made printable.
template <typename... Arguments>
void tell(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  const std::string text = printable(fmt::format(format, std::forward<Arguments>(arguments)...));
  std::fwrite(text.data(), 1, text.size(), stdout);
}

// A word as a POSIX shell takes it: as it is where that is safe, in single quotes otherwise.
std::string shell_word(const std::string& text);

}  // namespace boresight::app
