#include "boresight/io/tried_value.hpp"

#include <gtest/gtest.h>

namespace boresight {
namespace tried_value_test {

TEST(TriedValue, IsReadWithAllDigitsAndShownWithSix) {
  const TriedValue length(1.9499999987499999, "m"), share(0.1 + 0.2, "1");
  EXPECT_EQ(length.exact(), "1.9499999987499999 m");
  EXPECT_EQ(length.in_message("\"1.9499999987499999 m\""), "\"1.95 m\"");
  EXPECT_EQ(share.exact(), "0.30000000000000004");
  EXPECT_EQ(share.in_message("0.30000000000000004 of it"), "0.3 of it");
  EXPECT_EQ(length.in_message("nothing"), "nothing");
}

}  // namespace tried_value_test
}  // namespace boresight
