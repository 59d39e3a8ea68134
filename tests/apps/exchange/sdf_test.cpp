#include "imported.hpp"

namespace boresight::app {
namespace sdf_test {

using testing::AllOf;
using testing::HasSubstr;

std::string inertial(double mass) {
  return "<inertial><mass>" + std::to_string(mass) +
         "</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>";
}

// A model at (1, 2, 3), turned by 90 degrees about z, with a link that is turned by 90 degrees about x, and a joint along x of ...
std::string turned(const std::string& version, const std::string& axis) {
  return "<sdf version='" + version +
         "'>\n<model name='m'><pose>1 2 3 0 0 1.5707963267948966</pose>\n<link name='a'><pose>0.5 0 0 "
         "1.5707963267948966 0 0</pose>" +
         inertial(2.0) + "</link>\n<joint name='j' type='revolute'><parent>world</parent><child>a</child>" + axis +
         "</joint></model></sdf>";
}

Vec3 axis_of(const std::string& version, const std::string& axis) {
  return imported(read_sdf(turned(version, axis), "m.sdf")).joints.at(0).axis;
}

TEST(Sdf, AxesAreInTheFrameThatTheirVersionSays) {
  const std::string y = "<axis><xyz>0 1 0</xyz></axis>";
  // Of the model: its y is minus the world's x. Of the joint, which stands as the link does: its y is the model's z.
  expect_near(axis_of("1.4", y), Vec3(-1.0, 0.0, 0.0), 1e-12);
  expect_near(axis_of("1.6", y), Vec3(0.0, 0.0, 1.0), 1e-12);
  expect_near(axis_of("1.9", y), Vec3(0.0, 0.0, 1.0), 1e-12);
  expect_near(axis_of("1.6", "<axis><xyz>0 1 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis>"),
              Vec3(-1.0, 0.0, 0.0), 1e-12);
  expect_near(axis_of("1.9", "<axis><xyz expressed_in='__model__'>0 1 0</xyz></axis>"), Vec3(-1.0, 0.0, 0.0), 1e-12);
}

TEST(Sdf, AJointStandsInItsChildUnlessItSaysOtherwise) {
  const auto point = [](const std::string& pose) {
    return imported(read_sdf(turned("1.9", pose + "<axis><xyz>0 0 1</xyz></axis>"), "m.sdf")).joints.at(0).point;
  };
  expect_near(point(""), Vec3(1.0, 2.5, 3.0), 1e-12);
  expect_near(point("<pose>0 0.2 0 0 0 0</pose>"), Vec3(1.0, 2.5, 3.2), 1e-12);  // the link's y is up
  expect_near(point("<pose relative_to='__model__'>0 0.2 0 0 0 0</pose>"), Vec3(0.8, 2.0, 3.0), 1e-12);
  expect_near(point("<pose degrees='true' relative_to='__model__'>0 0.2 0 90 0 0</pose>"), Vec3(0.8, 2.0, 3.0), 1e-12);
}

TEST(Sdf, AJointThatMimicsAnotherMovesWithIt) {
  const std::string link = inertial(1.0) + "</link>";
  const Assembly made = assembled(
      read_sdf("<sdf version='1.11'><model name='m'><link name='a'>" + link + "<link name='b'>" + link +
                   "<joint name='left' type='revolute'><parent>world</parent><child>a</child><axis><xyz>0 0 1</xyz>"
                   "</axis></joint><joint name='right' type='revolute'><parent>world</parent><child>b</child>"
                   "<axis><xyz>0 0 1</xyz><mimic joint='left'><multiplier>-2</multiplier><offset>0.1</offset>"
                   "<reference>0.3</reference></mimic></axis></joint>"
                   "<plugin name='JointPositionController'><joint_name>left</joint_name></plugin></model></sdf>",
               "m.sdf"),
      {});
  EXPECT_EQ(made.drives.count("right"), 1u);
  EXPECT_NEAR(std::stod(made.drives.at("right")), 0.1 + 2.0 * 0.3, 1e-12);  // left stands still at 0
}

TEST(Sdf, SaysEachMassAndMomentThatItAssumes) {
  const auto assumed = [](const std::string& inertial) {
    std::string all;
    for (const Remark& remark : read_sdf("<sdf version='1.9'><model name='m'><link name='a'>" + inertial +
                                             "</link><joint name='j' type='revolute'><parent>world</parent>"
                                             "<child>a</child><axis><xyz>0 0 1</xyz></axis></joint></model></sdf>",
                                         "m.sdf")
                                    .assumed)
      all += remark.text + "; ";
    return all;
  };
  EXPECT_THAT(assumed("<inertial><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>"),
              HasSubstr("a has 1 kg, SDF's default"));
  EXPECT_THAT(assumed("<inertial><mass>2</mass><inertia><ixx>1</ixx></inertia></inertial>"),
              HasSubstr("a has iyy, izz of 1 kg m^2, SDF's default"));
}

TEST(Sdf, FramesHangInFrames) {
  const MechanismDescription m =
      imported(read_sdf("<sdf version='1.9'><world name='w'><gravity>0 0 -1.62</gravity><model name='m'>"
                        "<frame name='f' attached_to='a'><pose>0 0 1 0 0 0</pose></frame>"
                        "<frame name='g'><pose relative_to='f'>1 0 0 0 0 0.5</pose></frame>"
                        "<link name='a'><pose>0 5 0 0 0 0</pose>" +
                            inertial(1.0) +
                            "</link>"
                            "<link name='b'><pose relative_to='g' rotation_format='quat_xyzw'>0 0 0 0 0 0 1</pose>" +
                            inertial(1.0) +
                            "</link>"
                            "<joint name='j' type='ball'><parent>world</parent><child>a</child></joint>"
                            "<joint name='k' type='universal'><parent>f</parent><child>b</child><axis><xyz>1 0 "
                            "0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>"
                            "</model></world></sdf>",
                        "m.sdf"));
  expect_near(m.gravity, Vec3(0.0, 0.0, -1.62), 1e-12);
  expect_near(m.bodies[index_of(m.bodies, "b")].center_of_mass, Vec3(1.0, 5.0, 1.0), 1e-12);
  const JointDescription& k = joint_called(m, "k");
  EXPECT_EQ(k.type, JointType::universal);
  EXPECT_EQ(k.first, index_of(m.bodies, "a"));  // the link that the frame is attached to
  expect_near(k.axis, Vec3(std::cos(0.5), std::sin(0.5), 0.0), 1e-12);
  expect_near(k.second_axis, Vec3(-std::sin(0.5), std::cos(0.5), 0.0), 1e-12);
}

// The link that a joint moves whose child is `frame`, in a model with these attributes that holds a model with those.
std::string link_moved(const std::string& frame, const std::string& attributes = "", const std::string& inner = "") {
  const auto link = [](const std::string& name) { return "<link name='" + name + "'>" + inertial(1.0) + "</link>"; };
  const MechanismDescription m =
      imported(read_sdf("<sdf version='1.9'><model name='m'" + attributes +
                            "><frame name='f'/><frame name='g' attached_to='f'/>"
                            "<frame name='posed'><pose relative_to='a'>0 0 1 0 0 0</pose></frame>"
                            "<frame name='of_b' attached_to='b'/>" +
                            link("a") + link("b") + "<model name='in'" + inner + "><frame name='f'/>" + link("c") +
                            link("d") + "</model><joint name='j' type='revolute'><parent>world</parent><child>" +
                            frame + "</child><axis><xyz>0 0 1</xyz></axis></joint></model></sdf>",
                        "m.sdf"));
  return m.bodies.at(0).name;  // nothing holds the others
}

TEST(Sdf, AFrameThatIsAttachedToNothingMovesWithTheCanonicalLink) {
  for (const char* frame : {"f", "g", "posed", "__model__"}) {
    EXPECT_EQ(link_moved(frame), "a") << frame;  // the first
    EXPECT_EQ(link_moved(frame, " canonical_link='b'"), "b") << frame;
    EXPECT_EQ(link_moved(frame, " canonical_link='in::d'"), "in::d") << frame;
  }
  EXPECT_EQ(link_moved("of_b", " canonical_link='a'"), "b");
}

TEST(Sdf, AModelInAModelHasACanonicalLinkOfItsOwn) {
  for (const char* frame : {"in", "in::f", "in::__model__"}) {
    EXPECT_EQ(link_moved(frame, " canonical_link='b'"), "in::c") << frame;
    EXPECT_EQ(link_moved(frame, " canonical_link='b'", " canonical_link='d'"), "in::d") << frame;
  }
}

TEST(Sdf, ModelsInModelsKeepTheirNames) {
  const MechanismDescription m =
      imported(read_sdf("<sdf version='1.9'><model name='m'><link name='a'>" + inertial(1.0) +
                            "</link>"
                            "<model name='in'><pose>0 0 2 0 0 0</pose><link name='a'><pose>1 0 0 0 0 0</pose>" +
                            inertial(1.0) +
                            "</link></model>"
                            "<joint name='j' type='fixed'><parent>world</parent><child>a</child></joint>"
                            "<joint name='k' type='prismatic'><parent>a</parent><child>in::a</child><axis><xyz>0 1 "
                            "0</xyz></axis></joint></model></sdf>",
                        "m.sdf"));
  ASSERT_EQ(m.bodies.size(), 1u);
  EXPECT_EQ(m.bodies[0].name, "in::a");
  expect_near(m.bodies[0].center_of_mass, Vec3(1.0, 0.0, 2.0), 1e-12);
}

// Links stand before the models that hold what their poses are given in.
TEST(Sdf, PosesHangInWhatModelsInModelsHold) {
  const MechanismDescription m = imported(read_sdf(
      "<sdf version='1.9'><model name='m'>"
      "<link name='b'><pose relative_to='jb'>0 0 1 0 0 0</pose>" +
          inertial(1.0) + "</link><link name='c'><pose relative_to='in::tip'>0 0 0.5 0 0 0</pose>" + inertial(1.0) +
          "</link><model name='in'><pose>1 0 0 0 0 0</pose><link name='head'/>"
          "<frame name='tip' attached_to='head'><pose>0 2 0 0 0 0</pose></frame></model>"
          "<joint name='jb' type='revolute'><parent>world</parent><child>in::head</child>"
          "<axis><xyz>0 0 1</xyz></axis></joint>"
          "<joint name='j2' type='revolute'><parent>in::head</parent><child>b</child>"
          "<axis><xyz>0 0 1</xyz></axis></joint>"
          "<joint name='j3' type='revolute'><parent>in::head</parent><child>c</child>"
          "<axis><xyz>0 0 1</xyz></axis></joint></model></sdf>",
      "m.sdf"));
  expect_near(m.bodies[index_of(m.bodies, "b")].center_of_mass, Vec3(1.0, 0.0, 1.0), 1e-12);
  expect_near(m.bodies[index_of(m.bodies, "c")].center_of_mass, Vec3(1.0, 2.0, 0.5), 1e-12);
}

TEST(Sdf, LoopsStayLoops) {
  std::string text = "<sdf version='1.9'><model name='four-bar'>";
  const char* const names[] = {"crank", "coupler", "rocker"};
  for (int i = 0; i < 3; ++i)
    text += "<link name='" + std::string(names[i]) + "'><pose>" + std::to_string(i) + " 0 1 0 0 0</pose>" +
            inertial(1.0) + "</link>";
  const char* const parents[] = {"world", "crank", "coupler", "rocker"};
  const char* const children[] = {"crank", "coupler", "rocker", "world"};
  const char* const points[] = {"0 0 0", "0.5 0 1.5", "1.5 0 1.4", "2 0 0"};
  for (int i = 0; i < 4; ++i)
    text += "<joint name='j" + std::to_string(i) + "' type='revolute'><pose relative_to='__model__'>" + points[i] +
            " 0 0 0</pose><parent>" + parents[i] + "</parent><child>" + children[i] +
            "</child><axis><xyz expressed_in='__model__'>0 1 0</xyz></axis></joint>";
  const MechanismDescription m = imported(read_sdf(text + "</model></sdf>", "m.sdf"));
  EXPECT_EQ(m.bodies.size(), 3u);
  ASSERT_EQ(m.joints.size(), 4u);
  EXPECT_EQ(m.joints[3].second, kGround);
  expect_near(m.joints[2].point, Vec3(1.5, 0.0, 1.4), 1e-12);
}

struct SdfFault {
  const char *inside, *line, *found;
};
void PrintTo(const SdfFault& fault, std::ostream* out) { *out << "line " << fault.line << ", " << fault.found; }

class SdfFaults : public testing::TestWithParam<SdfFault> {};

TEST_P(SdfFaults, AreNamedWithTheirLine) {
  const std::string text = "<sdf version='1.9'><model name='m'><link name='a'/><link name='b'/>\n" +
                           std::string(GetParam().inside) + "</model></sdf>";
  try {
    assembled(read_sdf(text, "m.sdf"), {});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr(std::string("m.sdf:") + GetParam().line), HasSubstr(GetParam().found)));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, SdfFaults,
    testing::Values(SdfFault{"<joint name='j' type='screw'><parent>a</parent><child>b</child></joint>", "2",
                             "\"screw\""},
                    SdfFault{"<joint name='j' type='ball'><parent>a</parent>\n<child>c</child></joint>", "3", "\"c\""},
                    SdfFault{"<joint name='j' type='ball'><parent>a</parent></joint>", "2", "no <child>"},
                    SdfFault{"<model name='in' canonical_link='tpi'><link name='tip'/></model>", "2",
                             "model.canonical_link: found \"tpi\", expected the name of a link; did you mean tip?"},
                    SdfFault{"<model name='in' canonical_link='f'><link name='tip'/><frame name='f'/></model>", "2",
                             "model.canonical_link: found \"f\""},
                    SdfFault{"<frame name='f' attached_to='g'/><frame name='g' attached_to='f'/>\n<joint name='j' "
                             "type='ball'><parent>f</parent><child>a</child></joint>",
                             "3", "joint.parent: found \"f\""},
                    SdfFault{"<frame name='f'><pose relative_to='g'/></frame>\n<frame name='g'><pose "
                             "relative_to='f'/></frame><link name='c'><pose relative_to='f'/></link>",
                             "", "circle"},
                    SdfFault{"<link name='c'>\n<pose>0 0 0</pose></link>", "3", "six numbers"},
                    SdfFault{"<joint name='j' type='universal'><parent>a</parent><child>b</child>\n<axis><xyz>1 0 "
                             "0</xyz></axis><axis2><xyz>1 1 0</xyz></axis2></joint>",
                             "2", "not perpendicular"},
                    SdfFault{"<link name='c'><inertial>\n<mass>heavy</mass></inertial></link>", "3", "\"heavy\""}));

TEST(Sdf, AnotherVersionIsRefused) {
  EXPECT_THROW(read_sdf("<sdf version='2.0'><model name='m'/></sdf>", "m.sdf"), InputError);
  EXPECT_THROW(read_sdf("<sdf version='new'><model name='m'/></sdf>", "m.sdf"), InputError);
}

}  // namespace sdf_test
}  // namespace boresight::app
