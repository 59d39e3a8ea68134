// Names that other programs wrote end in mechanism files, which are UTF-8: what is not cannot be taken over.
#pragma once

#include <string>

namespace boresight::app {

// Where the first byte of a text is that UTF-8 has not in its place; npos where all of it is UTF-8.
std::size_t first_byte_not_utf8(const std::string& text);

// "the byte 0xEF".
std::string byte_in_words(char byte);

}  // namespace boresight::app
