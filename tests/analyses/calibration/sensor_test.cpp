// Tables as rigs write them, and several sensors of one run.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/sensor_plan.hpp"

namespace boresight {
namespace sensor_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class SensorTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  MeasuredData read(const std::string& text, const ReadAs& as) const {
    std::ofstream(file_) << text;
    return read_measured_table(file_, as);
  }
  PlannedSensor planned(const std::string& table) const {
    Document document =
        Document::from_text("[[sensor]]\ndata = \"a.csv\"\n" + table, testing::TempDir() + "study.toml");
    Cursor root(document);
    return read_sensor(root.tables("sensor").front(), testing::TempDir() + "study.toml");
  }
  template <typename Function>
  static std::string fault(const Function& reads) {
    try {
      reads();
    } catch (const InputError& error) {
      return error.what();
    }
    return "no fault";
  }
  const std::string file_ =
      testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name() + std::string(".csv");
};

TEST_F(SensorTest, TimeStampsAreThoseOfIso8601) {
  const auto at = [](const char* text) { return parse_time_stamp(text).value(); };
  EXPECT_EQ(at("1970-01-01T00:00:00Z").second, 0);
  EXPECT_EQ(at("2026-11-24T10:15:30.125Z").second, 1795515330);  // date -d 2026-11-24T10:15:30Z +%s
  EXPECT_EQ(at("2026-11-24 10:15:30,125").fraction, 0.125);
  EXPECT_EQ(at("2026-11-24T11:45:30+01:30").second, at("2026-11-24T10:15:30Z").second);
  EXPECT_EQ(at("2026-11-24T05:15:30-0500").second, at("2026-11-24T10:15:30Z").second);
  // A second's fraction keeps all its digits.
  EXPECT_NEAR(at("2026-11-24T10:15:31.000000250Z").since(at("2026-11-24T10:15:30.999999750Z")), 5e-7, 1e-15);
  for (const char* wrong :
       {"2026-02-30T00:00:00", "2026-11-24T24:00:00", "2026-11-24", "10:15:30", "2026-11-24T10:15:30.Z"})
    EXPECT_FALSE(parse_time_stamp(wrong)) << wrong;
}

TEST_F(SensorTest, ReadsWhatARigsSoftwareWrites) {
  const PlannedSensor sensor = planned(
      "header = 3\ntime = \"Timestamp\"\nstart = \"2026-11-24T10:15:30,100Z\"\n"
      "columns = { ry = \"Pitch (arcsec)\", rx = \"Yaw\" }\nfactors = { rx = -0.5 }\n");
  ReadAs as = sensor.as;
  as.duration = 0.05;
  const MeasuredData data = read(
      "Vision 4.2; export\n# Operator; M. Muster\n#No;Timestamp;Yaw (arcsec);Pitch (arcsec);Quality\n"
      "1;2026-11-24T10:15:30.080Z;9,9;9,9;good\n2;2026-11-24T10:15:30.110Z;2,5;;good\n"
      "3;2026-11-24T11:15:30.150+01:00;3,5;-1,0;bad\n4;2026-11-24T10:15:30.151Z;1;1;good\n",
      as);
  ASSERT_EQ(data.time.size(), 2u);
  EXPECT_NEAR(data.time[0], 0.01, 1e-12);
  EXPECT_NEAR(data.time[1], 0.05, 1e-12);
  EXPECT_EQ(data.line, (std::vector<int>{5, 6}));
  const double arcsec = M_PI / 180.0 / 3600.0;
  const auto of = [&](const char* name) {
    for (std::size_t c = 0; c < data.channels.size(); ++c)
      if (channel_names()[static_cast<std::size_t>(data.channels[c])].name == std::string(name))
        return data.value.col(static_cast<Eigen::Index>(c)).eval();
    return VecX().eval();
  };
  EXPECT_NEAR(of("rx")[0], -1.25 * arcsec, 1e-18);
  EXPECT_NEAR(of("rx")[1], -1.75 * arcsec, 1e-18);
  EXPECT_TRUE(std::isnan(of("ry")[0]));
  EXPECT_NEAR(of("ry")[1], -arcsec, 1e-18);
}

TEST_F(SensorTest, WithoutTimesReadsAtItsRate) {
  const PlannedSensor sensor =
      planned("rate = \"2 kHz\"\nstart = \"1 ms\"\ncolumns = { dx = \"X\" }\nunits = { dx = \"nm\" }\n");
  const MeasuredData data = read("X\tY\n1\t0\n2\t0\n3\t0\n4\t0\n", sensor.as);
  EXPECT_EQ(data.time, (std::vector<double>{-1e-3, -5e-4, 0.0, 5e-4}));
  EXPECT_NEAR(data.value(3, 0), 4e-9, 1e-21);
}

TEST_F(SensorTest, SaysWhatIsWrongWithTheLine) {
  const ReadAs as = planned("time = \"T\"\ncolumns = { dx = \"X\" }\n").as;
  EXPECT_THAT(fault([&] { read("T [s],X\n0,1\n", as); }), AllOf(HasSubstr(":1: "), HasSubstr("units = { dx = .. }")));
  EXPECT_THAT(fault([&] { read("T,X [um]\n0,1\n", as); }), HasSubstr("time_unit"));
  EXPECT_THAT(fault([&] { read("Time [s],X [um]\n0,1\n", as); }), HasSubstr("no column \"T\""));
  EXPECT_THAT(fault([&] { read("T [s],X [um],X (mm)\n0,1,1\n", as); }), HasSubstr("twice"));
  EXPECT_THAT(fault([&] { read("T [s],X [mrad]\n0,1\n", as); }), HasSubstr("mrad"));
  const ReadAs stamped = planned("time = \"T\"\nstart = \"2026-11-24T10:15:30Z\"\ncolumns = { dx = \"X\" }\n").as;
  EXPECT_THAT(fault([&] { read("T,X [um]\n0.5,1\n", stamped); }), HasSubstr("a time stamp"));
  EXPECT_THAT(fault([&] { read("T,X [um]\n2026-11-24T10:15:31,1\n", stamped); }), HasSubstr("with its zone"));
  ReadAs later = stamped;
  later.duration = 1.0;
  EXPECT_THAT(fault([&] { read("T,X [um]\n2026-11-24T10:15:32Z,1\n", later); }),
              HasSubstr("no reading during the motion"));
}

// A clock that counts from 1970 has not the digits for readings that come ten million times a second.
TEST_F(SensorTest, RefusesAStartSoFarAwayThatReadingsFallTogether) {
  const ReadAs as =
      planned("rate = \"10 MHz\"\nstart = \"1764000000 s\"\ncolumns = { dx = \"X\" }\nunits = { dx = \"nm\" }\n").as;
  EXPECT_THAT(fault([&] { read("X\n1\n2\n3\n4\n5\n", as); }), AllOf(HasSubstr("start"), HasSubstr("told apart")));
}

TEST_F(SensorTest, TablesOfAStudyThatContradictThemselvesAreRefused) {
  EXPECT_THAT(fault([&] { planned("rate = \"1 kHz\"\ntime = \"t\"\ncolumns = { dx = \"X\" }\n"); }), HasSubstr("rate"));
  EXPECT_THAT(fault([&] { planned("rate = \"1 kHz\"\nstart = \"2026-11-24T10:15:30Z\"\ncolumns = { dx = \"X\" }\n"); }),
              HasSubstr("a time stamp beside a rate"));
  EXPECT_THAT(fault([&] { planned("start = \"noon\"\ncolumns = { dx = \"X\" }\n"); }), HasSubstr("noon"));
  EXPECT_THAT(fault([&] { planned("columns = { dx = \"X\" }\nunits = { dy = \"um\" }\n"); }),
              HasSubstr("a channel of columns"));
  EXPECT_THAT(fault([&] { planned("columns = { dq = \"X\" }\n"); }), HasSubstr("dq"));
  EXPECT_THAT(fault([&] { planned("columns = { dx = \"X\" }\nfactors = { dx = 0 }\n"); }), HasSubstr("not 0"));
}

TEST_F(SensorTest, SensorsOfUnlikeRatesAreOneTableWithGaps) {
  MeasuredData slow{
      .file = "slow.csv", .channels = {0}, .time = {0.0, 0.2, 0.4}, .value = MatX(3, 1), .line = {2, 3, 4}};
  slow.value << 1.0, 2.0, 3.0;
  MeasuredData fast{.file = "fast.csv",
                    .channels = {3, 4},
                    .time = {0.1, 0.2, 0.3, 0.4},
                    .value = MatX(4, 2),
                    .line = {9, 10, 11, 12}};
  fast.value << 10.0, 20.0, 11.0, 21.0, 12.0, 22.0, 13.0, 23.0;
  const MeasuredData all = together({slow, fast});
  EXPECT_EQ(all.time, (std::vector<double>{0.0, 0.1, 0.2, 0.3, 0.4}));
  EXPECT_EQ(all.channels, (std::vector<int>{0, 3, 4}));
  EXPECT_EQ(all.value(2, 0), 2.0);
  EXPECT_TRUE(std::isnan(all.value(1, 0)));
  EXPECT_TRUE(std::isnan(all.value(0, 1)));
  EXPECT_EQ(all.value(4, 2), 23.0);
  EXPECT_EQ(all.origin(4, 0).file, "slow.csv");
  EXPECT_EQ(all.origin(4, 0).line, 4);
  EXPECT_EQ(all.origin(4, 2).file, "fast.csv");
  EXPECT_EQ(all.origin(4, 2).line, 12);
  EXPECT_THROW(together({slow, slow}), InputError);
}

TEST_F(SensorTest, WhatIsNotFoundIsSaidWithWhatThereIs) {
  ReadAs as;
  as.time = "Time";
  as.columns = {{0, "Q", "um", 1.0}};
  EXPECT_THAT(fault([&] { read("Time [s],X [um],Z [um]\n0,1,2\n", as); }),
              AllOf(HasSubstr("one of \"Time [s]\", \"X [um]\", \"Z [um]\""), Not(HasSubstr("did you mean"))));
  // A table of this project's own.
  EXPECT_THAT(fault([&] { read("t [s],BX [arcsec]\n0,1\n", {}); }), HasSubstr("did you mean bx?"));
  EXPECT_THAT(fault([&] { read("t [s],bx [asec]\n0,1\n", {}); }), HasSubstr("did you mean arcsec?"));
}

TEST_F(SensorTest, TimeStampsWithoutAStartAskForOne) {
  ReadAs as;
  as.time = "Time";
  as.columns = {{0, "X", "um", 1.0}};
  EXPECT_THAT(fault([&] { read("Time,X\n2026-11-24T10:00:00Z,1\n", as); }), HasSubstr("of time stamps, start"));
  as.time_unit = "s";
  EXPECT_THAT(fault([&] { read("Time,X\n2026-11-24T10:00:00Z,1\n", as); }), HasSubstr("of time stamps, start"));
}

}  // namespace sensor_test
}  // namespace boresight
