// Settings, parameter paths, patterns and the content hash.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "boresight/io/content_hash.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace settings_test {

MechanismDescription scene(const std::vector<Setting>& settings = {}) {
  return read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml", settings);
}

TEST(Setting, IsTakenApartAtTheFirstEqualsSign) {
  EXPECT_EQ(parse_setting("a.b=1=2").path, "a.b");
  EXPECT_EQ(parse_setting("a.b=1=2").value, "1=2");
  EXPECT_THROW(parse_setting("a.b"), InputError);
  EXPECT_THROW(parse_setting("=1"), InputError);
}

TEST(Setting, ReplacesAnyValueByItsPath) {
  const MechanismDescription m = scene({{"clearance.F1.radial", "0.2mm"},
                                        {"clearance.*.axial", "0.3 mm"},
                                        {"clearance.F1.contact.restitution", "0.5"},
                                        {"clearance.F1.contact.young", "200 GPa"},
                                        {"clearance.F1.contact.poisson.sleeve", "0.3"},
                                        {"clearance.F1.contact.stiffness_scale", "1.5"},
                                        {"clearance.F1.axes", "free"},
                                        {"payload.mass", "250 kg"},
                                        {"body.rod1.mass", "2 kg"},
                                        {"body.crank2.center_of_mass.z", "1 mm"},
                                        {"body.platform.inertia.zz", "0.7 kg m^2"},
                                        {"gravity.z", "0 m/s^2"},
                                        {"motion.duration", "0.5 s"},
                                        {"motion.angles.theta", "0.1*t"}});
  const ClearanceParameters& p = m.clearances[0].parameters;
  EXPECT_DOUBLE_EQ(p.radial, 2e-4);
  EXPECT_DOUBLE_EQ(p.axial, 3e-4);
  EXPECT_EQ(p.contact.restitution, 0.5);
  EXPECT_DOUBLE_EQ(p.contact.young[0], 200e9);
  EXPECT_DOUBLE_EQ(p.contact.young[1], 200e9);
  EXPECT_EQ(p.contact.poisson[0], 0.33);
  EXPECT_EQ(p.contact.poisson[1], 0.3);
  EXPECT_EQ(p.contact.stiffness_scale, 1.5);
  EXPECT_EQ(m.clearances[0].axes, JournalAxes::free);
  EXPECT_EQ(m.payload->mass, 250.0);
  EXPECT_EQ(m.gravity.z(), 0.0);
  EXPECT_EQ(m.motion.duration, 0.5);
  EXPECT_DOUBLE_EQ(m.motion.pose->angle[1]->at(0.5).value, 0.05);
  for (const BodyDescription& body : m.bodies) {
    if (body.name == "rod1") {
      EXPECT_EQ(body.mass, 2.0);
    }
    if (body.name == "rod2") {
      EXPECT_EQ(body.mass, 1.5);
    }
    if (body.name == "crank2") {
      EXPECT_DOUBLE_EQ(body.center_of_mass.z(), 1e-3);
    }
    if (body.name == "crank3") {
      EXPECT_DOUBLE_EQ(body.center_of_mass.z(), -0.06254571230937749);
    }
    if (body.name == "platform") {
      EXPECT_EQ(body.inertia(2, 2), 0.7);
    }
  }
}

TEST(Setting, TheLastOneOfAPathWins) {
  EXPECT_EQ(scene({{"payload.mass", "1 kg"}, {"payload.mass", "2 kg"}}).payload->mass, 2.0);
  // Of one element, and of all of them.
  EXPECT_DOUBLE_EQ(scene({{"clearance.F1.contact.young.journal", "200 GPa"}, {"clearance.F1.contact.young", "72 GPa"}})
                       .clearances[0]
                       .parameters.contact.young[0],
                   72e9);
  EXPECT_DOUBLE_EQ(scene({{"clearance.F1.contact.young", "72 GPa"}, {"clearance.F1.contact.young.journal", "200 GPa"}})
                       .clearances[0]
                       .parameters.contact.young[0],
                   200e9);
  EXPECT_DOUBLE_EQ(
      scene({{"clearance.F1.radial", "1 mm"}, {"clearance.*.radial", "2 mm"}}).clearances[0].parameters.radial, 2e-3);
}

TEST(Setting, MaySwitchADriveOffAfterThePatternWasCopied) {
  const MechanismDescription m = scene({{"joint.A1.driven", "false"}});
  for (const JointDescription& joint : m.joints) {
    if (joint.name == "A1") {
      EXPECT_FALSE(joint.driven);
    }
    if (joint.name == "A2") {
      EXPECT_TRUE(joint.driven);
    }
  }
}

TEST(Setting, OfAPathThatNamesNothingIsRefusedWithTheNearest) {
  for (const auto& [path, nearest] : {std::pair{"clearance.F2.radial", "clearance.F1.radial"},
                                      {"payload.mas", "payload.mass"},
                                      {"gravity", "gravity.x"},
                                      {"clearance.F1.contact.restitutoin", "clearance.F1.contact.restitution"}}) {
    try {
      scene({{path, "1 mm"}});
      ADD_FAILURE() << path;
    } catch (const InputError& error) {
      EXPECT_EQ(error.nearest, nearest);
      EXPECT_EQ(error.origin.line, 0);
    }
  }
}

const std::string kRing = R"toml(format = 1
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]
[[body]]
name = "hub"
mass = "1 kg"
center_of_mass = ["0 m", "0 m", "0 m"]
inertia = ["1 kg m^2", "1 kg m^2", "1 kg m^2"]
boresight = [0, 0, 5]
[[pattern]]
count = 4
axis = "z"
  [[pattern.body]]
  name = "arm{i}"
  mass = "1 kg"
  center_of_mass = ["1 m", "0 m", "2 m"]
  inertia = ["1 kg m^2", "2 kg m^2", "3 kg m^2"]
  [[pattern.joint]]
  name = "J{i}"
  type = "universal"
  connects = ["hub", "arm{i}"]
  point = ["1 m", "0 m", "0 m"]
  axis = [1, 0, 0.0001]
  second_axis = [0, 1, 0]
  [[pattern.joint]]
  name = "C{i}"
  type = "cylindrical"
  connects = ["ground", "arm{i}"]
  point = ["1 m", "0 m", "0 m"]
  axis = [0, 0, 1]
  [[pattern.clearance]]
  joint = "C{i}"
  journal = "arm{i}"
  radial = "0.1 mm"
  journal_radius = "5 mm"
  [[pattern.spring]]
  connects = ["hub", "arm{i}"]
  points = [["0 m", "0 m", "0 m"], ["1 m", "0 m", "0 m"]]
  stiffness = "{i} N/m"
  free_length = "1 m"
  [[pattern.load]]
  body = "arm{i}"
  point = ["1 m", "0 m", "0 m"]
  force = ["{i}*t", "0", "7"]
[motion]
duration = "2 s"
[initial]
rates = { C1.angle = "1 rad/s", "C1.displacement" = "2 mm/s" }
)toml";

TEST(Pattern, TurnsPointsAxesBodiesSpringsAndLoadsWithTheCopy) {
  const MechanismDescription m = read_mechanism_text(kRing, "ring.toml");
  ASSERT_EQ(m.bodies.size(), 5u);
  ASSERT_EQ(m.joints.size(), 8u);
  ASSERT_EQ(m.clearances.size(), 4u);
  ASSERT_EQ(m.springs.size(), 4u);
  ASSERT_EQ(m.loads.size(), 4u);
  EXPECT_EQ(*m.bodies[0].boresight, Vec3::UnitZ());
  const double e = 1e-15;
  EXPECT_EQ(m.bodies[2].name, "arm2");  // turned by 90 degrees
  EXPECT_LT((m.bodies[2].center_of_mass - Vec3(0, 1, 2)).norm(), e);
  EXPECT_LT((m.bodies[2].axes.col(0) - Vec3::UnitY()).norm(), e);  // no `axes`: the copy's body axes turn with it
  EXPECT_EQ(m.bodies[2].inertia(0, 0), 1.0);
  EXPECT_LT((m.joints[2].second_axis + Vec3::UnitX()).norm(), e);
  EXPECT_LT(std::abs(m.joints[2].axis.dot(m.joints[2].second_axis)), e);
  EXPECT_LT((m.springs[1].second_point - Vec3(0, 1, 0)).norm(), e);
  EXPECT_EQ(m.springs[3].parameters.stiffness, 4.0);
  EXPECT_NEAR(m.loads[1].force[1]->at(0.5).value, 1.0, e);  // 2 t along the copy's x, the world's y
  EXPECT_NEAR(m.loads[1].force[0]->at(0.5).value, 0.0, e);
  EXPECT_NEAR(m.loads[1].force[2]->at(0.5).value, 7.0, e);
  EXPECT_EQ(m.clearances[3].journal, 4);
  EXPECT_EQ(m.clearances[3].friction_law, "modified-coulomb");  // the tables were left out
  EXPECT_EQ(m.clearances[3].parameters.contact.restitution, 0.9);
  ASSERT_EQ(m.initial_rates.size(), 2u);
  EXPECT_EQ(m.initial_rates[0].freedom, InitialRateDescription::Freedom::angle);
  EXPECT_DOUBLE_EQ(m.initial_rates[1].rate, 2e-3);
}

TEST(Pattern, SettingsNameTheCopies) {
  const MechanismDescription m = read_mechanism_text(kRing, "ring.toml",
                                                     {{"spring.3.stiffness", "9 N/m"},
                                                      {"clearance.*.radial", "0.2 mm"},
                                                      {"joint.J2.point.x", "5 m"},
                                                      {"load.4.force.z", "8"},
                                                      {"initial.rates.C1.displacement", "0 m/s"}});
  EXPECT_EQ(m.springs[2].parameters.stiffness, 9.0);
  for (const auto& clearance : m.clearances) EXPECT_DOUBLE_EQ(clearance.parameters.radial, 2e-4);
  EXPECT_EQ(m.joints[2].point.x(), 5.0);
  EXPECT_NEAR(m.loads[3].force[2]->at(0).value, 8.0, 1e-15);
  EXPECT_EQ(m.initial_rates[1].rate, 0.0);
}

TEST(Motion, TakesAllTwelveEulerSequences) {
  for (const char* word : {"XYX", "XYZ", "XZX", "XZY", "YXY", "YXZ", "YZX", "YZY", "ZXY", "ZXZ", "ZYX", "ZYZ"}) {
    const auto sequence = scene({{"motion.angles.convention", word}}).motion.pose->sequence;
    for (int k = 0; k < 3; ++k) EXPECT_EQ(sequence[k], word[k] - 'X');
  }
  for (const char* word : {"ZZY", "ZYY", "zyz", "ZY", "ZYZY", ""}) {
    EXPECT_THROW(scene({{"motion.angles.convention", word}}), InputError) << word;
  }
}

TEST(Examples, AreAllReadable) {
  const std::string folder = BORESIGHT_EXAMPLES;
  const MechanismDescription slider = read_mechanism(folder + "/crank-slider/crank-slider.toml");
  EXPECT_EQ(slider.bodies.size(), 3u);
  const MechanismDescription four_bar = read_mechanism(folder + "/four-bar/four-bar.toml");
  EXPECT_EQ(four_bar.bodies.size(), 3u);
  EXPECT_EQ(four_bar.joints[four_bar.clearances[0].joint].first, kGround);
}

TEST(ContentHash, IsFnv1aOf128Bits) { EXPECT_EQ(ContentHash().hexadecimal(), "6c62272e07bb014262b821756295c58d"); }

TEST(ContentHash, IsTheSameForTheSameBytesAndSettingsOnly) {
  const std::string hash = scene().content_hash;
  EXPECT_EQ(scene().content_hash, hash);
  EXPECT_NE(scene({{"payload.mass", "0 kg"}}).content_hash, hash);
  EXPECT_EQ(scene({{"payload.mass", "0 kg"}}).content_hash, scene({{"payload.mass", "0 kg"}}).content_hash);
  EXPECT_NE(read_mechanism_text(kRing, "ring.toml").content_hash,
            read_mechanism_text(kRing + "\n", "ring.toml").content_hash);
  EXPECT_EQ(read_mechanism_text(kRing, "ring.toml").content_hash,
            read_mechanism_text(kRing, "other.toml").content_hash);
}

MechanismDescription example(const std::string& file, const std::vector<Setting>& settings) {
  return read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + file, settings);
}

// What a star stands for is every joint that has the number, whatever others there are.
TEST(Setting, WithAStarMeansThoseThatHaveTheNumber) {
  const MechanismDescription gimbal = example("bearing-pairs/gimbal.toml", {{"clearance.*.axial", "0.03 mm"}});
  int set = 0;
  for (const ClearanceDescription& c : gimbal.clearances)
    if (gimbal.joints[c.joint].type == JointType::revolute) {
      EXPECT_DOUBLE_EQ(c.parameters.axial, 0.03e-3) << gimbal.joints[c.joint].name;
      ++set;
    } else {
      EXPECT_EQ(c.parameters.axial, 0.0) << gimbal.joints[c.joint].name;
    }
  EXPECT_GT(set, 0);
  EXPECT_THROW(example("3-rrcpr/3-rrcpr.toml", {{"clearance.*.pad_radius", "3 mm"}}), InputError);  // which none has
}

TEST(Setting, WithAStarMeansThePairsAmongTheBearings) {
  const MechanismDescription m = example("bearing-pairs/preloaded.toml", {{"clearance.*.preload", "41 N"}});
  ASSERT_FALSE(m.springs.empty());
  for (const SpringDescription& spring : m.springs) EXPECT_DOUBLE_EQ(spring.parameters.preload, 41.0);
}

TEST(Setting, WithAStarNamesTheFloatingBearings) {
  const MechanismDescription plain = example("bearing-pairs/gimbal.toml", {});
  std::string floating;
  for (const ClearanceDescription& c : plain.clearances)
    if (const std::string& name = plain.joints[c.joint].name; name.ends_with(".floating")) floating = name;
  ASSERT_FALSE(floating.empty());
  const MechanismDescription all = example("bearing-pairs/gimbal.toml", {{"clearance.*.floating.radial", "0.021 mm"}});
  for (const ClearanceDescription& c : all.clearances) {
    const bool floats = all.joints[c.joint].name.ends_with(".floating");
    if (floats) {
      EXPECT_DOUBLE_EQ(c.parameters.radial, 0.021e-3) << all.joints[c.joint].name;
    } else {
      EXPECT_NE(c.parameters.radial, 0.021e-3) << all.joints[c.joint].name;
    }
  }
}

// An absent table is none of the file's mistakes.
TEST(Setting, BelowATableThatTheFileHasNotIsBlamedItself) {
  try {
    example("2-us-pointing/2-us-pointing.toml", {{"payload.mass", "1 kg"}});
    ADD_FAILURE();
  } catch (const InputError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("--set payload.mass=1 kg"), std::string::npos) << refusal.what();
  }
}

}  // namespace settings_test
}  // namespace boresight
