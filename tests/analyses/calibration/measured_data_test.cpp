// Tables of measured data: units, gaps, and what is refused.
#include "boresight_analyses/calibration/measured_data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace measured_data_test {

class MeasuredDataTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  MeasuredData read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_measured_data(file_);
  }
  std::string refusal(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  const std::string file_ =
      testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + std::string(".csv");
};

TEST_F(MeasuredDataTest, AreReadInTheUnitOfEachColumn) {
  const MeasuredData data = read(
      "# a rig\n\"t [ms]\", dx [um], ry [ mrad ], boresight_error [arcsec]\n"
      "0, 3.5, , 4\n"
      "\n2.5, nan, -0.2, NA\n");
  ASSERT_EQ(data.time, (std::vector<double>{0.0, 2.5e-3}));
  ASSERT_EQ(data.channels.size(), 3u);
  EXPECT_STREQ(channel_names()[static_cast<std::size_t>(data.channels[1])].name, "ry");
  EXPECT_NEAR(data.value(0, 0), 3.5e-6, 1e-18);
  EXPECT_TRUE(std::isnan(data.value(0, 1)));
  EXPECT_NEAR(data.value(0, 2), 4.0 * M_PI / 180.0 / 3600.0, 1e-15);
  EXPECT_TRUE(std::isnan(data.value(1, 0)));
  EXPECT_NEAR(data.value(1, 1), -2e-4, 1e-16);
  EXPECT_TRUE(std::isnan(data.value(1, 2)));
  EXPECT_EQ(data.line, (std::vector<int>{3, 5}));
}

TEST_F(MeasuredDataTest, ThatDifferByTheLastBitAreOtherData) {
  const MeasuredData data = read("t [s], dx [um], rz [urad]\n0, 3.5, \n0.001, 2, 4\n");
  const std::string text = exact_text_of(data);
  EXPECT_EQ(exact_text_of(read("# again\nt [s]; dx [um]; rz [urad]\n0; 3,50; nan\n0,0010; 2,0; 4\n")), text);
  MeasuredData other = data;
  other.value(1, 0) = std::nextafter(data.value(1, 0), 1.0);
  EXPECT_NE(exact_text_of(other), text);
  other = data;
  other.time[1] = std::nextafter(data.time[1], 1.0);
  EXPECT_NE(exact_text_of(other), text);
  other = data;
  other.channels[1] = 3;
  EXPECT_NE(exact_text_of(other), text);
  EXPECT_NE(exact_text_of(read("t [s], dx [um], rz [urad]\n0, 3.5, \n0.001, 2.00004, 4\n")), text);
}

TEST_F(MeasuredDataTest, WithoutAUnitOrTwiceTheSameColumnAreRefused) {
  EXPECT_THROW(read("t, dx [um]\n0, 1\n"), InputError);
  EXPECT_THROW(read("t [s], dx [um\n0, 1\n"), InputError);
  EXPECT_THROW(read("t [s], dx [u]\n0, 1\n"), InputError);
  EXPECT_THROW(read("t [s], dx [um], dx [mm]\n0, 1, 2\n"), InputError);
}

TEST_F(MeasuredDataTest, SayWhereAColumnStandsTwice) {
  EXPECT_NE(refusal("t [s], dx [um], dy [um], dx [mm]\n0, 1, 2, 3\n")
                .find(":1: header: found the column \"dx\" twice, as column 2 and column 4, expected each column once"),
            std::string::npos);
}

TEST_F(MeasuredDataTest, MayBeginWithTheMarkThatSpreadsheetsSet) {
  const MeasuredData data = read("\xEF\xBB\xBFt [s], dx [um]\n0, 3.5\n");
  EXPECT_EQ(data.time, (std::vector<double>{0.0}));
  EXPECT_NEAR(data.value(0, 0), 3.5e-6, 1e-18);
}

TEST_F(MeasuredDataTest, WithoutAnyValueOrWithAbsurdOnesAreRefusedWithTheirLine) {
  EXPECT_NE(refusal("t [s], dx [um]\n0, \n1, NA\n").find(".csv:2: data: found no value in any of 2 rows"),
            std::string::npos);
  EXPECT_NE(refusal("t [s], dx [um]\n0, 1\n1, 1e300\n").find(".csv:3: dx: found \"1e300\""), std::string::npos);
  EXPECT_NE(refusal("t [s], ry [rad]\n0, -1e7\n").find(".csv:2: ry"), std::string::npos);
  EXPECT_EQ(refusal("t [s], dx [m]\n0, 1e5\n"), "");
}

TEST_F(MeasuredDataTest, MayHaveSemicolonsAndDecimalCommas) {
  const MeasuredData data = read("t [s]; dx [um]; ry [mrad]\n0; 3,5;\n0,0025; ; -0,2\n1; 1e1; 4\n");
  EXPECT_EQ(data.time, (std::vector<double>{0.0, 2.5e-3, 1.0}));
  EXPECT_NEAR(data.value(0, 0), 3.5e-6, 1e-18);
  EXPECT_TRUE(std::isnan(data.value(0, 1)));
  EXPECT_NEAR(data.value(1, 1), -2e-4, 1e-16);
  EXPECT_NEAR(data.value(2, 0), 1e-5, 1e-17);
  // The same numbers with points.
  EXPECT_EQ(read("t [s]; dx [um]\n0; 3.5\n0.0025; -2\n").time.back(), 2.5e-3);
}

TEST_F(MeasuredDataTest, WithBothKindsOfDecimalMarksAreRefused) {
  EXPECT_NE(refusal("t [s]; dx [um]\n0,1; 3\n0.2; 4\n").find("a decimal comma, as in the numbers before"),
            std::string::npos);
  EXPECT_NE(refusal("t [s]; dx [um]\n0.1; 3\n0.2; 1,234\n").find("a decimal point, as in the numbers before"),
            std::string::npos);
  EXPECT_NE(refusal("t [s]; dx [um]\n0; 1.234,5\n").find("finite number"), std::string::npos);
  EXPECT_NE(refusal("t [s], dx [um]\n0, \"3,5\"\n").find("finite number"), std::string::npos);
}

}  // namespace measured_data_test
}  // namespace boresight
