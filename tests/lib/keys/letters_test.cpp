// Texts counted and cut by letters.
#include "boresight/keys/letters.hpp"

#include <gtest/gtest.h>

namespace boresight {
namespace letters_test {

TEST(Letters, AreCountedAndNotTheirBytes) {
  EXPECT_EQ(letters_in(""), 0u);
  EXPECT_EQ(letters_in("Lager"), 5u);
  EXPECT_EQ(letters_in("Träger φ1 €"), 11u);
  EXPECT_EQ(letters_in("\U0001f52d"), 1u);  // four bytes
  EXPECT_EQ(letters_in("a\xff\x80z"), 4u);  // what is no UTF-8 counts byte by byte
}

TEST(Letters, AreNeverCutInTheMiddle) {
  const std::string text = "äφ€\U0001f52dz";
  const char* const begun[] = {"", "ä", "äφ", "äφ€", "äφ€\U0001f52d", "äφ€\U0001f52dz", "äφ€\U0001f52dz"};
  for (std::size_t count = 0; count < 7; ++count) EXPECT_EQ(first_letters(text, count), begun[count]) << count;
  EXPECT_EQ(shortened(text, 5, 2), text);
  EXPECT_EQ(shortened(text, 4, 2), "äφ...");
  EXPECT_EQ(shortened(text, 4, 4, " ..."), "äφ€\U0001f52d ...");
}

TEST(Letters, HaveTheirNumbers) {
  EXPECT_EQ(letter_at("µ", 0).number, 0xb5u);
  EXPECT_EQ(letter_at("\U0001f52d", 0).size, 4u);
  EXPECT_EQ(letter_at("\xc2", 0).number, kNoLetter);
  EXPECT_EQ(letter_at("\xc2", 0).size, 1u);
}

}  // namespace letters_test
}  // namespace boresight
