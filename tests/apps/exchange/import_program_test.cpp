#include <fstream>

#include "apps/boresight/program.hpp"

namespace boresight::app {
namespace import_program_test {

using testing::HasSubstr;
using testing::Not;

const char kGimbal[] = R"(<robot name="gimbal">
  <link name="base"/>
  <link name="yoke"><inertial><origin xyz="0 0 0.06"/><mass value="0.8"/><inertia ixx="0.0021" iyy="0.0016" izz="0.0019"/></inertial></link>
  <link name="camera"><inertial><origin xyz="0.02 0 0"/><mass value="1.2"/><inertia ixx="0.0018" iyy="0.0026" izz="0.0027"/></inertial>
    <visual><geometry><box size="1 1 1"/></geometry></visual></link>
  <joint name="pan" type="continuous"><parent link="base"/><child link="yoke"/><origin xyz="0 0 0.1"/><axis xyz="0 0 1"/></joint>
  <joint name="tilt" type="continuous"><parent link="yoke"/><child link="camera"/><origin xyz="0 0 0.12"/><axis xyz="0 1 0"/></joint>
</robot>
)";

class ImportProgram : public Program {};

TEST_F(ImportProgram, WritesAMechanismThatChecksAndRuns) {
  write("gimbal.urdf", kGimbal);
  const Ended import =
      call({"import", "gimbal.urdf", "--boresight", "camera:x", "--drive", "pan=0.3*sin(t); tilt=0.1*t"});
  ASSERT_EQ(import.status, 0) << import.err;
  EXPECT_THAT(import.out, HasSubstr("gimbal.toml: 2 bodies of 2 kg together, 2 joints, 2 of them driven"));
  EXPECT_THAT(import.out, HasSubstr("line 5: shapes"));
  EXPECT_EQ(call({"check", "gimbal.toml"}).status, 0);
  const Ended run = call({"run", "gimbal.toml", "--quiet", "--out", "run"});
  ASSERT_EQ(run.status, 0) << run.err;
  // Without play, and without errors, nothing errs.
  EXPECT_EQ(json("run/summary.json")["index"]["boresight_error"]["max"], 0.0);
}

TEST_F(ImportProgram, ThePlayThatItsFileProposesIsPlay) {
  write("gimbal.urdf", kGimbal);
  ASSERT_EQ(call({"import", "gimbal.urdf", "--quiet"}).status, 0);
  std::string with_play;
  bool in_play = false;
  std::istringstream lines(text("gimbal.toml"));
  for (std::string line; std::getline(lines, line);) {
    in_play = in_play || line == "# [[clearance]]";
    with_play += (in_play && line.starts_with("# ") ? line.substr(2) : line) + "\n";
  }
  ASSERT_TRUE(in_play);
  write("play.toml", with_play);
  const Ended run = call({"run", "play.toml", "--quiet", "--rung", "quasistatic", "--out", "run"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_GT(json("run/summary.json")["index"]["position_error"]["max"], 1e-6);
}

TEST_F(ImportProgram, OverwritesNothing) {
  write("gimbal.urdf", kGimbal);
  write("gimbal.toml", "mine");
  const Ended import = call({"import", "gimbal.urdf"});
  EXPECT_EQ(import.status, 2);
  EXPECT_TRUE(is_one_line(import.err)) << import.err;
  EXPECT_EQ(text("gimbal.toml"), "mine");
  EXPECT_EQ(call({"import", "gimbal.urdf", "--to", "other.toml"}).status, 0);
  write("there.sdf", "mine");
  EXPECT_EQ(call({"convert", "other.toml", "--to", "there.sdf"}).status, 2);
  EXPECT_EQ(text("there.sdf"), "mine");
}

TEST_F(ImportProgram, WhatIsWrongWithAnOptionIsOneLine) {
  write("gimbal.urdf", kGimbal);
  const std::vector<std::vector<std::string>> wrong = {
      {"--boresight", "camra:x"},    {"--boresight", "base:x"}, {"--ground", "bse"},
      {"--drive", "pn=1"},           {"--drive", "pan=sin("},   {"--drive", "pan=; tilt"},
      {"--drive", "pan=t; pan=2*t"}, {"--duration", "1 kg"},    {"--duration", "-1 s"}};
  for (const std::vector<std::string>& options : wrong) {
    std::vector<std::string> command = {"import", "gimbal.urdf", "--to", "out.toml"};
    command.insert(command.end(), options.begin(), options.end());
    const Ended import = call(command);
    EXPECT_EQ(import.status, 2) << options[0] << " " << options[1];
    EXPECT_TRUE(is_one_line(import.err)) << import.err;
    EXPECT_THAT(import.err, HasSubstr(options[0]));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.toml"));
  }
}

TEST_F(ImportProgram, AJointThatIsDrivenTwiceIsNamed) {
  write("gimbal.urdf", kGimbal);
  const Ended import = call({"import", "gimbal.urdf", "--to", "out.toml", "--drive", "pan=1*t; pan=2*t"});
  EXPECT_EQ(import.status, 2);
  EXPECT_THAT(import.err, HasSubstr("--drive: found \"pan\" twice, expected each joint once"));
}

TEST_F(ImportProgram, AFileWhoseNameIsNotUtf8IsReadAsAnyOther) {
  write("gimbal\xE9.urdf", kGimbal);
  const Ended import = call({"import", "gimbal\xE9.urdf", "--to", "out.toml"});
  ASSERT_EQ(import.status, 0) << import.err;
  EXPECT_THAT(text("out.toml"), HasSubstr("imported from gimbal\\xe9.urdf (URDF)"));
}

TEST_F(ImportProgram, AnAxisThatIsNoneIsNamed) {
  write("gimbal.urdf", kGimbal);
  const Ended import = call({"import", "gimbal.urdf", "--to", "out.toml", "--boresight", "camera:q"});
  EXPECT_EQ(import.status, 2);
  EXPECT_THAT(import.err, HasSubstr("\"q\" as the axis of camera, expected x, y, z"));
}

TEST_F(ImportProgram, ALinkHeldAtTheEndLeavesALoop) {
  write("gimbal.urdf", kGimbal);
  const Ended import = call({"import", "gimbal.urdf", "--ground", "camera", "--drive", "none"});
  ASSERT_EQ(import.status, 0) << import.err;
  EXPECT_THAT(import.out, HasSubstr("1 body of 0.8 kg together, 2 joints, 0 of them driven"));
}

TEST_F(ImportProgram, RefusesWhatIsNoMechanism) {
  EXPECT_EQ(call({"import", "/dev/zero"}).status, 2);
  EXPECT_EQ(call({"import", "not-there.urdf"}).status, 2);
  EXPECT_EQ(call({"import", mechanism_}).status, 2);
  write(
      "deep.sdf", "<sdf version='1.9'>" + [] {
        std::string deep;
        for (int i = 0; i < 100000; ++i) deep += "<a>";
        return deep;
      }());
  const Ended deep = call({"import", "deep.sdf"});
  EXPECT_EQ(deep.status, 2);
  EXPECT_TRUE(is_one_line(deep.err)) << deep.err;
  write("escape.urdf", "<robot name='\x1b[31m'><link name='a'/></robot>");
  EXPECT_THAT(call({"import", "escape.urdf"}).err, Not(HasSubstr("\x1b[31m")));
}

TEST_F(ImportProgram, ConvertsWhereverAFileIsNamed) {
  for (const char* to : {"out.sdf", "out.xml", "out.mjcf"}) {
    const Ended convert = call({"convert", mechanism_, "--to", to});
    EXPECT_EQ(convert.status, 0) << convert.err;
    EXPECT_THAT(convert.out, HasSubstr("play: joints are ideal"));
  }
  EXPECT_THAT(text("out.xml"), HasSubstr("<mujoco"));
  EXPECT_THAT(text("out.sdf"), HasSubstr("<sdf"));
  EXPECT_EQ(call({"convert", mechanism_, "--to", "out.stl"}).status, 2);
}

}  // namespace import_program_test
}  // namespace boresight::app
