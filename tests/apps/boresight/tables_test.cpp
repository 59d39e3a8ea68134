#include "results/tables.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "boresight/io/mechanism_file.hpp"

namespace boresight::app {
namespace tables_test {

class TablesTest : public testing::Test {
 protected:
  static RunResult result() {
    RunResult r;
    r.time = {0.0, 1e-3, 2e-3};
    r.boresight.samples.resize(3);
    r.boresight.samples[1].error.displacement = Vec3(1.0 / 3.0, 0.1, -2e-300);
    r.clearances = {std::vector<ClearanceSample>(3)};
    r.clearances[0][1] = {Vec3(1e-5, 2e-5, 3e-5), 4e-6, 5.5, 3};
    r.others = {{0, "rod1", std::vector<PoseSample>(3)}};
    r.events = {{0, ContactPlace::axial_minus, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6}};
    return r;
  }
  std::vector<std::string> timeseries(std::size_t every = 1) const {
    std::ostringstream out;
    write_timeseries(out, mechanism_, result(), every);
    return lines(out.str());
  }
  static std::vector<std::string> lines(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  }
  const Mechanism mechanism_{read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml")};
};

TEST_F(TablesTest, TheTimeSeriesHasTheColumnsOfTheInterface) {
  EXPECT_EQ(timeseries()[0],
            "t,dx,dy,dz,rx,ry,rz,x,y,z,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz,ax,ay,az,"
            "F1.offset_x,F1.offset_y,F1.offset_z,F1.penetration,F1.normal_force,F1.contact,"
            "rod1.dx,rod1.dy,rod1.dz,rod1.rx,rod1.ry,rod1.rz,rod1.x,rod1.y,rod1.z,rod1.qw,rod1.qx,rod1.qy,rod1.qz,"
            "rod1.vx,rod1.vy,rod1.vz,rod1.wx,rod1.wy,rod1.wz,rod1.ax,rod1.ay,rod1.az");
}

TEST_F(TablesTest, EveryRowHasEveryColumn) {
  for (const std::string& line : timeseries()) EXPECT_EQ(std::count(line.begin(), line.end(), ','), 50);
}

TEST_F(TablesTest, NumbersComeBackBitForBit) {
  const std::string row = timeseries()[2];
  std::istringstream in(row);
  std::string field;
  std::vector<double> values;
  while (std::getline(in, field, ',')) values.push_back(std::stod(field));
  EXPECT_EQ(values[0], 1e-3);
  EXPECT_EQ(values[1], 1.0 / 3.0);
  EXPECT_EQ(values[2], 0.1);
  EXPECT_EQ(values[3], -2e-300);
  EXPECT_EQ(values[27], 5.5);
  EXPECT_EQ(values[28], 3.0);
}

TEST_F(TablesTest, EverySecondSampleAndTheLast) {
  EXPECT_EQ(timeseries(2).size(), 3u);   // header, 0, 2
  EXPECT_EQ(timeseries(10).size(), 3u);  // header, 0, 2
}

TEST_F(TablesTest, EventsHaveTheColumnsOfTheInterface) {
  std::ostringstream out;
  write_events(out, mechanism_, result());
  EXPECT_EQ(out.str(),
            "joint,contact,start,start_speed,duration,max_penetration,max_force,end_speed\n"
            "F1,axial-,0.10000000000000001,0.20000000000000001,0.29999999999999999,0.40000000000000002,0.5,0."
            "59999999999999998\n");
}

TEST(Exact, LeavesWhatIsNotANumberEmpty) { EXPECT_EQ(exact(std::nan("")), ""); }
TEST(CsvField, QuotesWhatNeedsIt) { EXPECT_EQ(csv_field("a,\"b\""), "\"a,\"\"b\"\"\""); }

}  // namespace tables_test
}  // namespace boresight::app
