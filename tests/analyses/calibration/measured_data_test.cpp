// Tables of measured data: units, gaps, and what is refused.
#include "boresight_analyses/calibration/measured_data.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

class MeasuredDataTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  MeasuredData read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_measured_data(file_);
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

TEST_F(MeasuredDataTest, WithoutAUnitOrTwiceTheSameColumnAreRefused) {
  EXPECT_THROW(read("t, dx [um]\n0, 1\n"), InputError);
  EXPECT_THROW(read("t [s], dx [um\n0, 1\n"), InputError);
  EXPECT_THROW(read("t [s], dx [u]\n0, 1\n"), InputError);
  EXPECT_THROW(read("t [s], dx [um], dx [mm]\n0, 1, 2\n"), InputError);
}

}  // namespace
}  // namespace boresight
