#include "exchange/utf8.hpp"

#include <gtest/gtest.h>

namespace boresight::app {
namespace utf8_test {

TEST(Utf8, LettersOfEveryLengthAreUtf8) {
  for (const char* text : {"", "abc", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x98\x80", "\xF4\x8F\xBF\xBF"})
    EXPECT_EQ(first_byte_not_utf8(text), std::string::npos) << text;
}

TEST(Utf8, TheFirstByteThatIsNotIsFound) {
  EXPECT_EQ(first_byte_not_utf8("M\xEF-i"), 1u);           // ISO-8859-1
  EXPECT_EQ(first_byte_not_utf8("\xC3\xA9\xE9"), 2u);      // one letter in UTF-8, one that is not
  EXPECT_EQ(first_byte_not_utf8("a\xE2\x82"), 1u);         // the end is missing
  EXPECT_EQ(first_byte_not_utf8("\xC0\xAF"), 0u);          // a slash, too long
  EXPECT_EQ(first_byte_not_utf8("\xED\xA0\x80"), 0u);      // half a letter of UTF-16
  EXPECT_EQ(first_byte_not_utf8("\xF4\x90\x80\x80"), 0u);  // beyond the last letter
  EXPECT_EQ(byte_in_words('\xEF'), "the byte 0xEF");
}

}  // namespace utf8_test
}  // namespace boresight::app
