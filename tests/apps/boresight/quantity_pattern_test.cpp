// The schemas' patterns of quantities against the reader of quantities, text by text.
#include "reference/quantity_pattern.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "boresight/keys/value_fault.hpp"
#include "reference/sections.hpp"

namespace boresight::app {
namespace quantity_pattern_test {

// Of every table of every file; each way of asking once.
std::vector<Key> quantity_keys() {
  std::vector<Key> keys;
  std::vector<std::string> patterns;
  for (const Section& section : sections())
    for (const Key& key : section.keys->keys) {
      const bool quantity = key.kind == KeyKind::quantity || key.kind == KeyKind::quantities ||
                            key.kind == KeyKind::vector || key.kind == KeyKind::points;
      if (!quantity || *key.range.unit.what == '\0') continue;
      const std::string pattern = quantity_pattern(key);
      if (std::find(patterns.begin(), patterns.end(), pattern) != patterns.end()) continue;
      patterns.push_back(pattern);
      keys.push_back(key);
    }
  return keys;
}

bool reader_takes(const Key& key, const std::string& text) {
  try {
    const double value = parse_quantity(text, key.range.unit);
    return holds(key.range, value) &&
           std::all_of(key.bounds.begin(), key.bounds.end(), [&](const KeyBound& bound) { return bound.holds(value); });
  } catch (const ValueFault&) {
    return false;
  }
}

const std::vector<std::string> kNumbers = {"0",
                                           "-0",
                                           "+0.0",
                                           "1",
                                           "-1",
                                           "+2.5",
                                           ".5",
                                           "7.",
                                           "99",
                                           "100",
                                           "101",
                                           "999.9",
                                           "1000",
                                           "12345",
                                           "1e3",
                                           "1e+7",
                                           "1E07",
                                           "9.99e9",
                                           "1e10",
                                           "-1e12",
                                           "1e15",
                                           "1e99",
                                           "1e-30",
                                           "0.001",
                                           "1e300",
                                           "-1e300",
                                           "1e100",
                                           "99999999999999",
                                           "10000000000000000000000000",
                                           "123456789e-6",
                                           "00012",
                                           "0e400"};

TEST(QuantityPattern, RefusesNothingThatTheReaderTakes) {
  // Common units, and others that UDUNITS knows, of all dimensions.
  std::vector<std::string> units = common_units(kLength, true);
  for (const std::string& other : common_units(kLength, false)) units.push_back(other);
  for (const char* odd :
       {"ym", "Gm",  "inch",      "parsec", "mil",   "lbf", "psi",   "m/s/s", "m.s^-2", "m s-1", "kg.m2", "turn",
        "sr", "day", "fortnight", "um^1",   "mm/mm", "ug",  "N.s/m", "1/um",  "µm",     "degF",  "decade"})
    units.push_back(odd);
  std::size_t taken = 0;
  for (const Key& key : quantity_keys()) {
    const std::regex pattern(quantity_pattern(key));
    for (const std::string& number : kNumbers)
      for (const std::string& unit : units)
        for (const char* between : {" ", ""}) {
          const std::string text = number + between + unit;
          if (!reader_takes(key, text)) continue;
          ++taken;
          EXPECT_TRUE(std::regex_search(text, pattern)) << key.name << ": " << text;
        }
  }
  EXPECT_GT(taken, 1000u);
}

TEST(QuantityPattern, KnowsTheCommonUnitsOfOtherDimensions) {
  for (const Key& key : quantity_keys()) {
    const std::regex pattern(quantity_pattern(key));
    const std::vector<std::string> others = common_units(key.range.unit, false);
    EXPECT_GT(others.size(), 40u);
    for (const std::string& unit : others)
      for (const std::string& text : {"1 " + unit, "1.5 " + unit + " ", "1." + unit}) {
        if (text.starts_with("1.1")) continue;  // "1.1/K" is another number
        EXPECT_FALSE(std::regex_search(text, pattern)) << key.name << ": " << text;
      }
  }
}

TEST(QuantityPattern, KnowsSizesBeyondTheLargestByThePowerOfTen) {
  const Key length = keys::quantity("width", kSizeRange).above(0.0, "more than 0");  // to 10000 km
  const std::regex of_length(quantity_pattern(length));
  for (const char* text : {"1e8 m", "100000000 m", "1.5E+011mm", "123456 km", "1e300 um"})
    EXPECT_FALSE(std::regex_search(text, of_length)) << text;
  for (const char* text : {"1e7 m", "10000000 m", "1e10 mm", "10000 km", "99999 km", "0.000001e9 m"})
    EXPECT_TRUE(std::regex_search(text, of_length)) << text;
  // Whatever the sign where a coordinate may have one; a bound above holds for positive numbers.
  const std::regex of_coordinate(quantity_pattern(keys::quantity("x", kCoordinateRange)));
  EXPECT_FALSE(std::regex_search("-1e8 m", of_coordinate));
  const std::regex of_share(
      quantity_pattern(keys::quantity("share", kRatio).inside_of(0.0, 1.0, "more than 0 % and less than 100 %")));
  EXPECT_FALSE(std::regex_search("1000 %", of_share));
  EXPECT_TRUE(std::regex_search("99 %", of_share));
}

}  // namespace quantity_pattern_test
}  // namespace boresight::app
