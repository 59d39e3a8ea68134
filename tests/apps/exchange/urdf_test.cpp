#include "boresight/io/expression.hpp"
#include "imported.hpp"

namespace boresight::app {
namespace urdf_test {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kPi = EIGEN_PI;

// A mast that is turned by 90 degrees about z in the base, and a head on it that is turned by 90 degrees about x in the mast.
const std::string kTurned = R"(<?xml version="1.0"?>
<robot name="turned">
  <link name="base"/>
  <link name="mast"><inertial><origin xyz="0.1 0 0"/><mass value="2"/>
    <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.025"/></inertial></link>
  <link name="head"><inertial><origin xyz="0 0.3 0" rpy="0 0 1.5707963267948966"/><mass value="1"/>
    <inertia ixx="0.001" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.0025"/></inertial></link>
  <joint name="pan" type="continuous"><parent link="base"/><child link="mast"/>
    <origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/><axis xyz="0 0 2"/></joint>
  <joint name="lift" type="prismatic"><parent link="mast"/><child link="head"/>
    <origin xyz="0.5 0 0.2" rpy="1.5707963267948966 0 0"/><axis xyz="0 1 0"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>
</robot>
)";

TEST(Urdf, LinksStandWhereTheirJointsPutThem) {
  const MechanismDescription m = imported(read_urdf(kTurned, "turned.urdf"));
  ASSERT_EQ(m.bodies.size(), 2u);
  const BodyDescription &mast = m.bodies[index_of(m.bodies, "mast")], &head = m.bodies[index_of(m.bodies, "head")];
  // The mast's x is the world's y; the head's y is the mast's z, the world's z.
  expect_near(mast.center_of_mass, Vec3(1.0, 0.1, 0.0), 1e-12);
  expect_near(head.center_of_mass, Vec3(1.0, 0.5, 0.5), 1e-12);
  expect_near(inertia_in_world(mast), Vec3(0.02, 0.01, 0.025).asDiagonal().toDenseMatrix(), 1e-12);
  // The inertial frame is turned about the head's z once more: its x is the head's y, the world's z; its y is minus the head's x,
  // minus the world's y; its z is the head's z, the world's x.
  expect_near(inertia_in_world(head), Vec3(0.0025, 0.002, 0.001).asDiagonal().toDenseMatrix(), 1e-12);
  const JointDescription &pan = joint_called(m, "pan"), &lift = joint_called(m, "lift");
  expect_near(pan.point, Vec3(1.0, 0.0, 0.0), 1e-12);
  expect_near(pan.axis, Vec3(0.0, 0.0, 1.0), 1e-12);
  expect_near(lift.point, Vec3(1.0, 0.5, 0.2), 1e-12);
  expect_near(lift.axis, Vec3(0.0, 0.0, 1.0), 1e-12);
  EXPECT_EQ(pan.type, JointType::revolute);
  EXPECT_EQ(lift.type, JointType::prismatic);
  EXPECT_EQ(pan.first, kGround);
}

TEST(Urdf, LinksThatAreFixedToEachOtherAreOneBody) {
  const MechanismDescription m = imported(read_urdf(R"(<robot name="r"><link name="base"/>
    <link name="a"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1"/></inertial></link>
    <link name="b"><inertial><mass value="3"/><inertia ixx="2" iyy="2" izz="2"/></inertial></link>
    <joint name="j" type="revolute"><parent link="base"/><child link="a"/><limit effort="1" velocity="1"/></joint>
    <joint name="k" type="fixed"><parent link="a"/><child link="b"/><origin xyz="0 0 4"/></joint></robot>)",
                                                    "r.urdf"));
  ASSERT_EQ(m.bodies.size(), 1u);
  EXPECT_EQ(m.bodies[0].name, "a");
  EXPECT_DOUBLE_EQ(m.bodies[0].mass, 4.0);
  expect_near(m.bodies[0].center_of_mass, Vec3(0.0, 0.0, 3.0), 1e-12);
  // Steiner: 1 kg in 3 m and 3 kg in 1 m from the common centre of mass.
  expect_near(inertia_in_world(m.bodies[0]), Vec3(15.0, 15.0, 3.0).asDiagonal().toDenseMatrix(), 1e-11);
}

TEST(Urdf, AJointThatMimicsAnotherFollowsItsCourse) {
  const std::string text = R"(<robot name="r"><link name="base"/><link name="a"/><link name="b"/>
    <joint name="j" type="continuous"><parent link="base"/><child link="a"/></joint>
    <joint name="k" type="continuous"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/>
      <mimic joint="j" multiplier="-2" offset="0.5"/></joint></robot>)";
  ImportChoices choices;
  choices.drives_given = true;
  choices.drives["j"] = "sin(t)";
  const MechanismDescription m = imported(read_urdf(text, "r.urdf"), choices);
  EXPECT_TRUE(joint_called(m, "k").driven);
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (m.joints[j].name == "k") {
      EXPECT_NEAR(m.motion.drives.at(static_cast<int>(j))->at(1.0).value, 0.5 - 2.0 * std::sin(1.0), 1e-12);
    }
}

TEST(Urdf, AJointIsDrivenOnceWhicheverOfItsNamesSaysSo) {
  ImportChoices choices;
  choices.drives_given = true;
  choices.drives = {{"pan.1", "t"}, {"pan_1", "2*t"}};  // in a mechanism file, names hold no dots
  try {
    assembled(read_urdf(R"(<robot name="r"><link name="base"/><link name="a"/>
    <joint name="pan.1" type="continuous"><parent link="base"/><child link="a"/></joint></robot>)",
                        "r.urdf"),
              choices);
    FAIL() << "expected a fault";
  } catch (const InputError& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("--drive: found \"pan_1\" twice, expected each joint once"));
  }
}

// Whichever name comes first.
TEST(Urdf, AJointMayFollowOneThatFollows) {
  for (const char* last : {"a", "z"}) {
    const std::string name = last;
    ImportChoices choices;
    choices.drives_given = true;
    choices.drives["j"] = "sin(t)";
    const Assembly a =
        assembled(read_urdf(R"(<robot name="r"><link name="base"/><link name="l1"/><link name="l2"/><link name="l3"/>
    <joint name="j" type="continuous"><parent link="base"/><child link="l1"/></joint>
    <joint name="k" type="continuous"><parent link="l1"/><child link="l2"/><mimic joint="j" multiplier="2"/></joint>
    <joint name=")" + name + R"(" type="continuous"><parent link="l2"/><child link="l3"/>
      <mimic joint="k" multiplier="3" offset="0.5"/></joint></robot>)",
                            "r.urdf"),
                  choices);
    ASSERT_EQ(a.drives.count(name), 1u) << name;
    EXPECT_NEAR(parse_expression(a.drives.at(name))->at(1.0).value, 0.5 + 6.0 * std::sin(1.0), 1e-12) << name;
  }
}

TEST(Urdf, WhatIsMeasuredAndNotCommandedIsFree) {
  const Assembly a = assembled(read_urdf(R"(<robot name="r"><link name="base"/><link name="cart"/><link name="pole"/>
    <joint name="slide" type="prismatic"><parent link="base"/><child link="cart"/></joint>
    <joint name="swing" type="continuous"><parent link="cart"/><child link="pole"/></joint>
    <ros2_control name="c" type="system"><joint name="slide"><command_interface name="position"/></joint>
    <joint name="swing"><state_interface name="position"/></joint></ros2_control></robot>)",
                                         "r.urdf"),
                               {});
  EXPECT_TRUE(joint_called(a.mechanism, "slide").driven);
  EXPECT_FALSE(joint_called(a.mechanism, "swing").driven);
}

TEST(Urdf, AJointThatMimicsAFreeOneIsFree) {
  ImportChoices choices;
  choices.drives_given = true;
  const Assembly a = assembled(read_urdf(R"(<robot name="r"><link name="base"/><link name="a"/><link name="b"/>
    <joint name="j" type="continuous"><parent link="base"/><child link="a"/></joint>
    <joint name="k" type="continuous"><parent link="a"/><child link="b"/><mimic joint="j"/></joint></robot>)",
                                         "r.urdf"),
                               choices);
  EXPECT_TRUE(a.drives.empty());
  for (const JointDescription& joint : a.mechanism.joints) EXPECT_FALSE(joint.driven) << joint.name;
  EXPECT_THAT(grouped(a.left_out), testing::Contains(HasSubstr("k moving with j, which is not driven")));
}

// Base, a, b and c; the joints j, k and l between them, with what each holds.
Drawing chain_of_three(const std::string& j, const std::string& k, const std::string& l) {
  return read_urdf(
      R"(<robot name="r"><link name="base"/><link name="a"/><link name="b"/><link name="c"/>
    <joint name="j" type="continuous"><parent link="base"/><child link="a"/>)" +
          j + R"(</joint>
    <joint name="k" type="continuous"><parent link="a"/><child link="b"/>)" +
          k + R"(</joint>
    <joint name="l" type="continuous"><parent link="b"/><child link="c"/>)" +
          l + R"(</joint></robot>)",
      "r.urdf");
}

TEST(Urdf, MimicsInACircleAreLeftOutAndNamed) {
  const Assembly pair =
      assembled(chain_of_three("<mimic joint='k' multiplier='2'/>", "<mimic joint='j'/>", "<mimic joint='k'/>"), {});
  EXPECT_THAT(grouped(pair.left_out), testing::Contains(HasSubstr("j moving with k: mimics in a circle (j, k, j)")));
  EXPECT_THAT(grouped(pair.left_out), testing::Contains(HasSubstr("k moving with j: mimics in a circle (k, j, k)")));
  // One that follows the circle is none of it.
  EXPECT_THAT(grouped(pair.left_out), testing::Not(testing::Contains(HasSubstr("l moving"))));
  const Assembly own = assembled(chain_of_three("<mimic joint='j'/>", "", ""), {});
  EXPECT_THAT(grouped(own.left_out), testing::Contains(HasSubstr("j moving with j: mimics in a circle (j, j)")));
}

TEST(Urdf, MimicsInACircleFollowTheOneThatTheUserMoves) {
  ImportChoices choices;
  choices.drives_given = true;
  choices.drives["k"] = "sin(t)";
  const Assembly a = assembled(
      chain_of_three("<mimic joint='k' multiplier='2'/>", "<mimic joint='l'/>", "<mimic joint='j'/>"), choices);
  EXPECT_THAT(grouped(a.left_out), testing::Not(testing::Contains(HasSubstr("circle"))));
  ASSERT_EQ(a.drives.count("l"), 1u);
  EXPECT_EQ(a.drives.at("k"), "sin(t)");
  EXPECT_NEAR(parse_expression(a.drives.at("l"))->at(1.0).value, 2.0 * std::sin(1.0), 1e-12);
}

TEST(Urdf, TheUsersOwnCourseOfAJointStandsAgainstItsMimic) {
  ImportChoices choices;
  choices.drives_given = true;
  choices.drives = {{"j", "sin(t)"}, {"k", "3*t"}};
  const Assembly a = assembled(read_urdf(R"(<robot name="r"><link name="base"/><link name="a"/><link name="b"/>
    <joint name="j" type="continuous"><parent link="base"/><child link="a"/></joint>
    <joint name="k" type="continuous"><parent link="a"/><child link="b"/><mimic joint="j"/></joint></robot>)",
                                         "r.urdf"),
                               choices);
  EXPECT_EQ(a.drives.at("k"), "3*t");
}

TEST(Urdf, ALongNameIsCutBetweenTwoLettersOfUtf8) {
  // 59 two-byte letters after one of one byte: the 90th byte lies within a letter.
  std::string name = "x";
  for (int i = 0; i < 59; ++i) name += "\u00e9";
  const Assembly a = assembled(read_urdf("<robot name=\"r\"><link name=\"base\"/><link name=\"" + name + R"("/>
    <joint name="j" type="continuous"><parent link="base"/><child link=")" +
                                             name + R"("/></joint></robot>)",
                                         "r.urdf"),
                               {});
  ASSERT_EQ(a.mechanism.bodies.size(), 1u);
  const std::string& cut = a.mechanism.bodies[0].name;
  EXPECT_EQ(cut.size(), 89u);
  EXPECT_EQ(cut, name.substr(0, 89));
}

TEST(Urdf, MoreLinksThanAnyMechanismHasAreRefusedAtOnce) {
  std::string text = "<robot name=\"r\">\n";
  for (int i = 0; i < 1001; ++i) text += "<link name=\"l" + std::to_string(i) + "\"/>\n";
  try {
    read_urdf(text + "</robot>", "r.urdf");
    FAIL() << "expected a fault";
  } catch (const InputError& fault) {
    EXPECT_THAT(fault.what(), AllOf(HasSubstr("r.urdf:1002"), HasSubstr("more than 1000 links")));
  }
}

TEST(Urdf, LinksWithoutMassGetSoLittleThatNothingChanges) {
  const Assembly a = assembled(read_urdf(R"(<robot name="r"><link name="base"/><link name="cross"/>
    <link name="b"><inertial><mass value="3"/><inertia ixx="2" iyy="2" izz="2"/></inertial></link>
    <joint name="j" type="continuous"><parent link="base"/><child link="cross"/></joint>
    <joint name="k" type="continuous"><parent link="cross"/><child link="b"/><axis xyz="0 1 0"/></joint></robot>)",
                                         "r.urdf"),
                               {});
  ASSERT_EQ(a.mechanism.bodies.size(), 2u);
  EXPECT_NEAR(a.mechanism.bodies[0].mass, 3e-9, 1e-20);
  EXPECT_THAT(grouped(a.assumed), testing::Contains(HasSubstr("cross has no mass")));
}

TEST(Urdf, TheBoresightIsTheAxisThatWasAskedFor) {
  ImportChoices choices;
  choices.boresight_part = "head";
  choices.boresight_axis = -Vec3::UnitZ();
  const MechanismDescription m = imported(read_urdf(kTurned, "turned.urdf"), choices);
  const BodyDescription& head = m.bodies[index_of(m.bodies, "head")];
  ASSERT_TRUE(head.boresight.has_value());
  expect_near(*head.boresight, Vec3(-1.0, 0.0, 0.0), 1e-12);
}

// What is wrong, in one line with the line of the file.
struct Fault {
  const char *text, *line, *found;
};
void PrintTo(const Fault& fault, std::ostream* out) { *out << "line " << fault.line << ", " << fault.found; }

class UrdfFault : public testing::TestWithParam<Fault> {};

TEST_P(UrdfFault, IsNamedWithItsLine) {
  try {
    assembled(read_urdf(GetParam().text, "r.urdf"), {});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(std::string("r.urdf:") + GetParam().line), HasSubstr(GetParam().found)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, UrdfFault,
    testing::Values(
        Fault{"<robot name='r'>\n<link name='a'>\n</robot>", "2", "no XML"},
        Fault{"<?xml version='1.0' encoding='ISO-8859-1'?>\n<robot name='m\xEF'><link name='a'/></robot>", "2",
              "robot.name: found the byte 0xEF (the file declares ISO-8859-1), expected UTF-8"},
        Fault{"<robot name='r'>\n<link name='a\xF6'/></robot>", "2",
              "link.name: found the byte 0xF6 (the file declares no encoding), expected UTF-8"},
        Fault{"\xFF\xFE<", "1", "found a text in UTF-16, expected one in UTF-8"},
        Fault{"<robot name='r'>\n</robot>", "1", "no <link>"},
        Fault{"<robot name='r'>\n<link name='a'/>\n<link name='a'/></robot>", "3", "a second time"},
        Fault{"<robot name='r'>\n<link name='a'/>\n<link name='b'/></robot>", "3", "which no joint connects"},
        Fault{"<robot name='r'><link name='a'/><link name='b'/>\n<joint name='j' type='hinge'><parent link='a'/><child "
              "link='b'/></joint></robot>",
              "2", "\"hinge\""},
        Fault{"<robot name='r'><link name='a'/><link name='bolt'/>\n<joint name='j' type='fixed'><parent "
              "link='a'/>\n<child link='blot'/></joint></robot>",
              "3", "did you mean bolt?"},
        Fault{"<robot name='r'><link name='a'/><link name='b'/>\n<joint name='j' type='continuous'><parent "
              "link='a'/><child link='b'/>\n<axis xyz='0 0'/></joint></robot>",
              "3", "three numbers"},
        Fault{"<robot name='r'><link name='a'/><link name='b'/>\n<joint name='j' type='continuous'><parent "
              "link='a'/><child link='b'/>\n<axis xyz='0 0 nan'/></joint></robot>",
              "3", "finite"},
        Fault{"<robot name='r'><link name='a'/><link name='b'/>\n<joint name='j' type='continuous'><parent "
              "link='a'/><child link='b'/>\n<axis xyz='0 0 0'/></joint></robot>",
              "3", "length zero"},
        Fault{"<robot name='r'><link name='a'/>\n<link name='b'><inertial>\n<mass value='-1'/><inertia ixx='1' iyy='1' "
              "izz='1'/></inertial></link>\n<joint name='j' type='continuous'><parent link='a'/><child "
              "link='b'/></joint></robot>",
              "2", "-1 kg"},
        Fault{"<robot name='r'><link name='a'/>\n<link name='b'><inertial>\n<mass value='1'/><inertia ixx='1' iyy='1' "
              "izz='3'/></inertial></link>\n<joint name='j' type='continuous'><parent link='a'/><child "
              "link='b'/></joint></robot>",
              "2", "larger than the sum"},
        Fault{"<robot name='r'><link name='a'/><link name='b'/>\n<joint name='j' type='fixed'><parent link='b'/><child "
              "link='a'/></joint>\n<joint name='k' type='fixed'><parent link='a'/><child link='b'/></joint></robot>",
              "1", "circle"},
        Fault{"<robot name='r' xmlns:xacro='x'>\n<xacro:include filename='a'/></robot>", "2", "xacro"}));

TEST(Urdf, AnotherEncodingIsNoFaultWhereNothingIsTakenOver) {
  const MechanismDescription m =
      imported(read_urdf("<?xml version='1.0' encoding='ISO-8859-1'?>\n<!-- \xA9 M\xFCller -->\n"
                         "<robot name='r'><link name='base'/><link name='a'/><joint name='j' type='continuous'>"
                         "<parent link='base'/><child link='a'/></joint></robot>",
                         "r.urdf"));
  EXPECT_EQ(m.joints.size(), 1u);
}

TEST(Urdf, NothingThatMovesIsNoMechanism) {
  EXPECT_THROW(assembled(read_urdf("<robot name='r'><link name='a'/></robot>", "r.urdf"), {}), InputError);
}

}  // namespace urdf_test
}  // namespace boresight::app
