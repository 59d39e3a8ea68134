// What leaves by convert comes back by import: the examples, as SDF and as MJCF.
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "exchange/writers.hpp"
#include "imported.hpp"

namespace boresight::app {
namespace round_trip_test {

class RoundTrip : public testing::TestWithParam<const char*> {
 protected:
  const Mechanism mechanism_{read_mechanism(std::string(BORESIGHT_EXAMPLES "/") + GetParam())};
  const MechanismDescription& drawn_ = mechanism_.description();

  // Bodies by name with mass, place and inertia; what stands between joints is left out.
  void expect_bodies(const MechanismDescription& back) const {
    const std::vector<MassProperties> masses = mechanism_.mass_properties(mechanism_.parameters());
    const double size = mechanism_.characteristic_length();
    for (int b = 0; b < mechanism_.bodies(); ++b) {
      const BodyDescription &was = drawn_.bodies[b], &is = back.bodies[index_of(back.bodies, was.name)];
      EXPECT_NEAR(is.mass, masses[b].mass, 1e-5 * masses[b].mass) << was.name;
      expect_near(is.center_of_mass, was.center_of_mass + was.axes * masses[b].c, 1e-6 * size, was.name);
      expect_near(inertia_in_world(is), was.axes * masses[b].inertia * was.axes.transpose(),
                  1e-5 * (masses[b].inertia.norm() + masses[b].mass * 1e-2 * size * size), was.name);
    }
  }
  // Half of a bearing pair has a dot in its name, which no name in a file may have.
  static std::string without_dots(std::string name) {
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
  }
  // A joint between the same bodies through the same point and along the same axes.
  void expect_joint(const MechanismDescription& back, const JointDescription& was, const std::string& name) const {
    const JointDescription& is = joint_called(back, without_dots(name));
    const auto body = [](const MechanismDescription& m, int b) { return b == kGround ? "ground" : m.bodies[b].name; };
    EXPECT_EQ(is.type, was.type) << name;
    EXPECT_EQ(is.driven, was.driven) << name;
    const bool turned = body(back, is.first) != body(drawn_, was.first);
    EXPECT_EQ(body(back, turned ? is.second : is.first), body(drawn_, was.first)) << name;
    EXPECT_EQ(body(back, turned ? is.first : is.second), body(drawn_, was.second)) << name;
    expect_near(is.point, was.point, 1e-9, name);
    if (was.type == JointType::spherical) return;
    const double sign = turned && was.type != JointType::universal ? -1.0 : 1.0;
    const Vec3 axis = turned && was.type == JointType::universal ? is.second_axis : is.axis;
    if (was.type == JointType::revolute || was.type == JointType::prismatic)
      expect_near(sign * axis, was.axis, 1e-9, name);
    else  // of the others a turn the other way is the same joint
      EXPECT_NEAR(std::abs(axis.dot(was.axis)), 1.0, 1e-9) << name;
  }
};

TEST_P(RoundTrip, BySdfLeavesBodiesAndJoints) {
  const MechanismDescription back = imported(read_sdf(sdf_of(mechanism_).text, "out.sdf"));
  expect_bodies(back);
  std::size_t more = 0;
  for (const JointDescription& joint : drawn_.joints) {
    if (joint.type == JointType::cylindrical)
      more += 1;
    else if (joint.type == JointType::planar)
      more += 2;
    else
      expect_joint(back, joint, joint.name);
  }
  EXPECT_EQ(back.joints.size(), drawn_.joints.size() + more);
  EXPECT_EQ(back.bodies.size(), drawn_.bodies.size() + more);
  expect_near(back.gravity, drawn_.gravity, 1e-12);
}

#ifdef BORESIGHT_HAS_MUJOCO
TEST_P(RoundTrip, ByMjcfLeavesBodiesAndJoints) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) /
      (std::filesystem::path(GetParam()).stem().string() + "-" + std::to_string(::getpid()) + ".xml");
  std::ofstream(file) << mjcf_of(mechanism_).text;
  const MechanismDescription back = imported(read_mjcf(file.string()));
  std::filesystem::remove(file);
  expect_bodies(back);
  EXPECT_EQ(back.joints.size(), drawn_.joints.size());
  EXPECT_EQ(back.bodies.size(), drawn_.bodies.size());
  EXPECT_EQ(back.springs.size(), drawn_.springs.size());
  for (std::size_t s = 0; s < std::min(back.springs.size(), drawn_.springs.size()); ++s) {
    expect_near(back.springs[s].first_point, drawn_.springs[s].first_point, 1e-9);
    expect_near(back.springs[s].second_point, drawn_.springs[s].second_point, 1e-9);
    EXPECT_DOUBLE_EQ(back.springs[s].parameters.stiffness, drawn_.springs[s].parameters.stiffness);
    EXPECT_DOUBLE_EQ(back.springs[s].parameters.damping, drawn_.springs[s].parameters.damping);
    EXPECT_NEAR(back.springs[s].parameters.free_length, drawn_.springs[s].parameters.free_length, 1e-9);
  }
  for (const JointDescription& joint : drawn_.joints) expect_joint(back, joint, joint.name);
}
#endif

INSTANTIATE_TEST_SUITE_P(OfExamples, RoundTrip,
                         testing::Values("3-rrcpr/3-rrcpr.toml", "3-rrr/3-rrr.toml", "2-us-pointing/2-us-pointing.toml",
                                         "hexapod/hexapod.toml", "andrews-squeezer/andrews-squeezer.toml",
                                         "bricard/bricard.toml", "crank-slider/crank-slider.toml",
                                         "flores-slider-crank/flores-slider-crank.toml",
                                         "spatial-double-crank/spatial-double-crank.toml",
                                         "spatial-slider-crank/spatial-slider-crank.toml", "bearing-pairs/gimbal.toml",
                                         "four-bar/four-bar.toml", "heavy-top/heavy-top.toml"),
                         [](const testing::TestParamInfo<const char*>& of) {
                           std::string name = std::filesystem::path(of.param).stem().string();
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

}  // namespace round_trip_test
}  // namespace boresight::app
