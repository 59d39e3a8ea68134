// A column of numbers from a CSV file, whichever of the two marks its program writes.
#include "boresight_analyses/random/csv_column.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace boresight {
namespace csv_column_test {

// Tests of other processes have files of their own.
std::string file_of(const std::string& text) {
  const std::string name = testing::TempDir() + "column." + std::to_string(::getpid()) + ".csv";
  std::ofstream(name) << text;
  return name;
}

std::string refusal(const std::string& text) {
  try {
    read_csv_column(file_of(text), "b");
  } catch (const ColumnFault& fault) {
    return fault.found + ", expected " + fault.expected;
  }
  return "no refusal";
}

TEST(CsvColumn, IsReadWithCommasOrSemicolonsAndEitherDecimalMark) {
  const std::vector<double> expected = {0.5, 1e-3};
  EXPECT_EQ(read_csv_column(file_of("a,b\n1,0.5\n2,1e-3\n"), "b"), expected);
  EXPECT_EQ(read_csv_column(file_of("a; b\n1,5; 0,5\n2,5; 1e-3\n"), "b"), expected);
  EXPECT_EQ(read_csv_column(file_of("a; b\n1.5; 0.5\n2.5; 1e-3\n"), "b"), expected);
}

TEST(CsvColumn, IsFoundBesideNamesWithTheOtherMark) {
  const std::vector<double> expected = {0.5, 1e-3};
  EXPECT_EQ(read_csv_column(file_of("a; in mm,c,b\n1,2,0.5\n2,2,1e-3\n"), "b"), expected);
  EXPECT_EQ(read_csv_column(file_of("\"a;c;d\",b\n1,0.5\n2,1e-3\n"), "b"), expected);
  EXPECT_EQ(read_csv_column(file_of("a, in mm;c;b\n1,5;2;0,5\n2;2;1e-3\n"), "b"), expected);
  EXPECT_EQ(read_csv_column(file_of("b\n0.5\n1e-3\n"), "b"), expected);
  EXPECT_EQ(read_csv_column(file_of("a, in mm\tc\tb\n1,5\t2\t0,5\n2\t2\t1e-3\n"), "b"), expected);
}

TEST(CsvColumn, DoesNotMixDecimalMarks) {
  EXPECT_NE(refusal("a;b\n1;0,5\n2;0.5\n").find("\"0.5\" in line 3"), std::string::npos);
  EXPECT_NE(refusal("a;b\n1;0,5\n2;0.5\n").find("expected a decimal comma, as in the numbers before"),
            std::string::npos);
  EXPECT_NE(refusal("a;b\n1;0.5\n2;1,000.5\n").find("expected a decimal point"), std::string::npos);
  EXPECT_NE(refusal("a;b\n1;1.000,5\n").find("expected a finite number"), std::string::npos);
  EXPECT_NE(refusal("a,b\n1,\"0,5\"\n").find("expected a finite number"), std::string::npos);
}

TEST(CsvColumn, OfAFileWithOneColumnMayHaveDecimalCommas) {
  const std::vector<double> expected = {12.5, 13.1};
  EXPECT_EQ(read_csv_column(file_of("b\n12,5\n13,1\n"), "b"), expected);
  EXPECT_EQ(read_csv_column(file_of("b\n12.5\n13.1\n"), "b"), expected);
  EXPECT_NE(refusal("b\n12,5\n13.1\n").find("expected a decimal comma"), std::string::npos);
}

TEST(CsvColumn, IsRefusedWhereARowHasMoreFieldsThanTheHeader) {
  EXPECT_NE(refusal("a,b\n1,5,0,5\n").find("4 fields in line 2"), std::string::npos);
  EXPECT_NE(refusal("a,b\n1,5,0,5\n").find("expected 2, as in the header"), std::string::npos);
  EXPECT_EQ(read_csv_column(file_of("a,b\n1,0.5,\n2,1e-3, ,\n"), "b"), (std::vector<double>{0.5, 1e-3}));
}

TEST(CsvColumn, IsRefusedWhereTheFileNamesItTwice) {
  EXPECT_NE(refusal("b,a,b\n1,2,3\n").find("\"b\" as column 1 and column 3 in line 1 of \""), std::string::npos);
  EXPECT_NE(refusal("b,a,b\n1,2,3\n").find("expected each column once"), std::string::npos);
  EXPECT_EQ(read_csv_column(file_of("a,b,a\n1,0.5,3\n"), "b"), std::vector<double>{0.5});  // what nobody asks for
}

// Its unit is for people: values are taken as the study says, so a name without it is none of the file's.
TEST(CsvColumn, IsSuggestedWithItsUnit) {
  try {
    read_csv_column(file_of("a [s],b [Hz]\n1,0.5\n"), "b");
    ADD_FAILURE() << "no refusal";
  } catch (const ColumnFault& fault) {
    EXPECT_EQ(fault.nearest, "b [Hz]");
  }
}

}  // namespace csv_column_test
}  // namespace boresight
