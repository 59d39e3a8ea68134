// A reader that asks for what its table of keys does not have is at fault itself.
#include "boresight/keys/key.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "boresight/io/cursor.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace key_test {

const KeyTable& some_keys() {
  using namespace keys;
  static const KeyTable table_of_keys{
      .name = "some",
      .says = "A table.",
      .keys = {
          quantity("length", kSizeRange).above(0.0, "a length above zero").otherwise(0.002, "mm").says("A length."),
          number("share").share().says("A share."), number("late").usually("that of share").says("Another one."),
          choice("word", std::vector<std::string>{"first", "second"}).otherwise("first").says("A word.")}};
  return table_of_keys;
}

Document document(const std::string& text = "share = 0.5") { return Document::from_text(text, "f.toml"); }

TEST(KeyTables, RefuseAReaderThatAsksForAKeyTheyLack) {
  Document d = document();
  Cursor cursor(d);
  cursor.only(some_keys());
  EXPECT_THROW(cursor.number("other"), std::logic_error);
  EXPECT_THROW(cursor.has("other"), std::logic_error);
  EXPECT_THROW(cursor.table("other"), std::logic_error);
  EXPECT_THROW(cursor.tables("other"), std::logic_error);
}

TEST(KeyTables, RefuseAReaderThatAsksForAnotherKindOrADefaultOfItsOwn) {
  Document d = document();
  Cursor cursor(d);
  cursor.only(some_keys());
  EXPECT_THROW(cursor.text("share"), std::logic_error);
  EXPECT_THROW(cursor.quantity("share"), std::logic_error);
  EXPECT_THROW(cursor.quantity("length", 0.001), std::logic_error);
  EXPECT_THROW(cursor.quantity("length", kLength), std::logic_error);
  EXPECT_THROW(cursor.choice("word", {"third"}, "third"), std::logic_error);
}

TEST(KeyTables, RefuseAReaderThatNamesNone) {
  Document d = document();
  Cursor cursor(d);
  EXPECT_THROW(cursor.number("share"), std::logic_error);
  EXPECT_THROW(cursor.finish(), std::logic_error);
}

TEST(KeyTables, GiveReadersTheirDefaults) {
  Document d = document();
  Cursor cursor(d);
  cursor.only(some_keys());
  EXPECT_EQ(cursor.quantity("length"), 0.002);
  EXPECT_EQ(cursor.number("share"), 0.5);
  EXPECT_EQ(cursor.number("late", 0.25), 0.25);
  EXPECT_EQ(cursor.choice("word"), "first");
}

TEST(KeyTables, GiveReadersTheirRanges) {
  const auto error_of = [](const std::string& text) -> std::string {
    Document d = document(text);
    Cursor cursor(d);
    try {
      cursor.only(some_keys());
      cursor.quantity("length");
      cursor.number("share");
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of("share = 1"), "f.toml:1: share: found the number 1, expected more than 0 and less than 1");
  EXPECT_EQ(error_of("length = \"0 m\""), "f.toml:1: length: found \"0 m\", expected a length above zero");
  EXPECT_EQ(error_of("length = \"1e9 km\""),
            "f.toml:1: length: found \"1e9 km\", expected a length from 1 pm to 10000 km");
  EXPECT_EQ(error_of("lenght = \"1 m\""),
            "f.toml:1: lenght: found an unknown key, expected one of length, share, late, word; did you mean length?");
}

TEST(KeyTables, SayDefaultsAndRangesAsFilesWriteThem) {
  const auto& keys = some_keys().keys;
  EXPECT_EQ(default_text(keys[0]), "\"2 mm\"");
  EXPECT_EQ(range_text(keys[0]), "1 pm to 10000 km");
  EXPECT_EQ(range_text(keys[1]), "above 0 and below 1");
  EXPECT_EQ(default_text(keys[1]), "");
  EXPECT_EQ(default_text(keys[3]), "\"first\"");
}

}  // namespace key_test
}  // namespace boresight
