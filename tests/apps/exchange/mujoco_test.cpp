// MuJoCo reads URDF by a reader of its own. Its mass matrix and its forces of gravity and of inertia, of the URDF and of what we import
// and convert to MJCF, must be the same in every pose: masses, places, axes and their signs are then.
#ifdef BORESIGHT_HAS_MUJOCO
#include <mujoco/mujoco.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <random>

#include "exchange/writers.hpp"
#include "imported.hpp"

namespace boresight::app {
namespace mujoco_test {

struct Model {
  std::unique_ptr<mjModel, void (*)(mjModel*)> model{nullptr, mj_deleteModel};
  std::unique_ptr<mjData, void (*)(mjData*)> data{nullptr, mj_deleteData};

  explicit Model(const std::string& text, const std::string& extension) {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / ("model-" + std::to_string(::getpid()) + extension);
    std::ofstream(file) << text;
    char fault[1000] = "";
    model.reset(mj_loadXML(file.c_str(), nullptr, fault, sizeof fault));
    std::filesystem::remove(file);
    if (!model) throw std::runtime_error(fault);
    model->opt.disableflags |= mjDSBL_CONTACT | mjDSBL_LIMIT;
    data.reset(mj_makeData(model.get()));
  }
  int joint(const std::string& name) const { return mj_name2id(model.get(), mjOBJ_JOINT, name.c_str()); }
  MatX mass_matrix() const {
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> M(model->nv, model->nv);
    mj_fullM(model.get(), M.data(), data->qM);
    return M;
  }
};

// A chain with turned frames, inertias about turned axes and a slider.
const std::string kArm = R"(<robot name="arm">
  <link name="base"/>
  <link name="shoulder"><inertial><origin xyz="0.02 -0.01 0.05" rpy="0.3 0.2 0.1"/><mass value="3"/>
    <inertia ixx="0.02" ixy="0.001" ixz="-0.002" iyy="0.03" iyz="0.0015" izz="0.025"/></inertial></link>
  <link name="arm"><inertial><origin xyz="0.2 0 0.01" rpy="0 0.4 0"/><mass value="1.5"/>
    <inertia ixx="0.004" ixy="0" ixz="0.0003" iyy="0.02" iyz="0" izz="0.021"/></inertial></link>
  <link name="rod"><inertial><origin xyz="0.1 0.02 0"/><mass value="0.7"/>
    <inertia ixx="0.001" ixy="0.0001" ixz="0" iyy="0.004" iyz="0" izz="0.0045"/></inertial></link>
  <link name="head"><inertial><origin xyz="0 0 0.04" rpy="1 0 0.5"/><mass value="0.4"/>
    <inertia ixx="0.0006" ixy="0" ixz="0" iyy="0.0008" iyz="0.0001" izz="0.0009"/></inertial></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="shoulder"/><origin xyz="0 0 0.3" rpy="0.1 -0.2 0.5"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="9" velocity="9"/></joint>
  <joint name="lift" type="revolute"><parent link="shoulder"/><child link="arm"/><origin xyz="0.05 0.03 0.1" rpy="0 0.7 -0.3"/>
    <axis xyz="0 -0.6 0.8"/><limit lower="-3" upper="3" effort="9" velocity="9"/></joint>
  <joint name="reach" type="prismatic"><parent link="arm"/><child link="rod"/><origin xyz="0.4 0 0" rpy="0.2 0 0"/>
    <axis xyz="1 0 0"/><limit lower="-1" upper="1" effort="9" velocity="9"/></joint>
  <joint name="roll" type="revolute"><parent link="rod"/><child link="head"/><origin xyz="0.2 0 0.01" rpy="0 0.3 1.2"/>
    <axis xyz="0.48 0.6 0.64"/><limit lower="-3" upper="3" effort="9" velocity="9"/></joint>
</robot>)";

TEST(MuJoCo, FindsTheSameDynamicsInAUrdfAndInWhatWeMakeOfIt) {
  const Model theirs(kArm, ".urdf");
  const Model ours(mjcf_of(Mechanism(imported(read_urdf(kArm, "arm.urdf")))).text, ".xml");
  ASSERT_EQ(theirs.model->nv, 4);
  ASSERT_EQ(ours.model->nv, 4);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  for (int pose = 0; pose < 20; ++pose) {
    for (const char* name : {"turn", "lift", "reach", "roll"}) {
      const double q = draw(random), v = draw(random);
      for (const Model* m : {&theirs, &ours}) {
        const int joint = m->joint(name);
        ASSERT_GE(joint, 0) << name;
        m->data->qpos[m->model->jnt_qposadr[joint]] = q;
        m->data->qvel[m->model->jnt_dofadr[joint]] = v;
      }
    }
    mj_forward(theirs.model.get(), theirs.data.get());
    mj_forward(ours.model.get(), ours.data.get());
    const MatX M = theirs.mass_matrix();
    expect_near(ours.mass_matrix(), M, 1e-9 * M.cwiseAbs().maxCoeff(), "mass matrix");
    const auto bias = [](const Model& m) { return Eigen::Map<const VecX>(m.data->qfrc_bias, m.model->nv); };
    expect_near(bias(ours), bias(theirs), 1e-9 * bias(theirs).cwiseAbs().maxCoeff(), "gravity and inertia");
  }
}

// Names of a kind differ in MJCF, where one of our joints may be two, and a loop's end a body.
TEST(MuJoCo, LoadsWhateverNamesBodiesAndJointsHave) {
  MechanismDescription m = read_mechanism(BORESIGHT_EXAMPLES "/hexapod/hexapod.toml");
  m.bodies.at(0).name = "world";
  std::vector<JointDescription*> universal;
  for (JointDescription& joint : m.joints)
    if (joint.type == JointType::universal) universal.push_back(&joint);
  ASSERT_GE(universal.size(), 3u);
  universal[1]->name = universal[0]->name + " 2";
  universal[2]->name = universal[0]->name + " 2 2";
  for (std::size_t j = 0; j < m.joints.size() && j + 1 < m.bodies.size(); ++j)
    m.bodies[j + 1].name = m.joints[j].name + " end";
  const Model model(mjcf_of(Mechanism(m)).text, ".xml");
  mj_forward(model.model.get(), model.data.get());
  for (int row = 0; row < model.data->ne; ++row) EXPECT_NEAR(model.data->efc_pos[row], 0.0, 1e-9);
}

TEST(MuJoCo, WhatAsksForAnotherPoseThanTheDrawnOneIsNamed) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("poses-" + std::to_string(::getpid()) + ".xml");
  const auto left_out = [&](const std::string& ref, const std::string& relpose) {
    std::ofstream(file)
        << "<mujoco><compiler angle='radian'/><worldbody><body name='a'><joint name='j' axis='0 1 0' ref='" << ref
        << "'/><inertial pos='0 0 1' mass='1' diaginertia='1 1 1'/></body>"
           "<body name='b' pos='0 0 2'><freejoint/><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/></body>"
           "</worldbody><equality><weld name='tie' body1='a' body2='b' "
        << relpose << "/></equality></mujoco>";
    std::string all;
    for (const Remark& one : read_mjcf(file.string()).left_out) all += one.text + '\n';
    return all;
  };
  EXPECT_EQ(left_out("0", ""), "");
  EXPECT_THAT(left_out("0.5", ""), testing::HasSubstr("j: its ref of 0.5 rad"));
  EXPECT_THAT(left_out("0", "relpose='0 0 3 1 0 0 0'"), testing::HasSubstr("tie: the pose that it asks for"));
  std::filesystem::remove(file);
}

TEST(MuJoCo, ANameThatIsNotUtf8IsRefused) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("letters-" + std::to_string(::getpid()) + ".xml");
  std::ofstream(file) << "<mujoco><worldbody><body name='m\xEF'><joint name='j' axis='0 1 0'/>"
                         "<inertial pos='0 0 1' mass='1' diaginertia='1 1 1'/></body></worldbody></mujoco>";
  try {
    read_mjcf(file.string());
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("name: found the byte 0xEF, expected UTF-8"));
  }
  std::filesystem::remove(file);
}

// Loops that MuJoCo closes by equalities are closed at home.
TEST(MuJoCo, FindsTheLoopsOfTheExamplesClosed) {
  for (const char* name : {"3-rrcpr/3-rrcpr.toml", "hexapod/hexapod.toml", "bricard/bricard.toml",
                           "crank-slider/crank-slider.toml", "andrews-squeezer/andrews-squeezer.toml"}) {
    const Model m(mjcf_of(Mechanism(read_mechanism(std::string(BORESIGHT_EXAMPLES "/") + name))).text, ".xml");
    mj_forward(m.model.get(), m.data.get());
    ASSERT_GT(m.data->ne, 0) << name;
    for (int row = 0; row < m.data->ne; ++row) EXPECT_NEAR(m.data->efc_pos[row], 0.0, 1e-9) << name << ", row " << row;
  }
}

TEST(MuJoCo, ABodyThatOnlyASpringHoldsIsAPartOfTheMechanism) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("spring-" + std::to_string(::getpid()) + ".xml");
  std::ofstream(file) << "<mujoco><worldbody><site name='hook' pos='0 0 3'/>"
                         "<body name='arm'><joint/><inertial pos='0 0 1' mass='1' diaginertia='1 1 1'/></body>"
                         "<body name='bob' pos='0 0 2'><freejoint/><inertial pos='0 0 0' mass='2' diaginertia='1 1 "
                         "1'/><site name='eye'/></body>"
                         "</worldbody><tendon><spatial stiffness='50' springlength='0.5'><site site='hook'/><site "
                         "site='eye'/></spatial></tendon></mujoco>";
  const MechanismDescription m = imported(read_mjcf(file.string()));
  std::filesystem::remove(file);
  ASSERT_EQ(m.bodies.size(), 2u);
  ASSERT_EQ(m.springs.size(), 1u);
  EXPECT_EQ(m.springs[0].first, kGround);
  EXPECT_EQ(m.springs[0].second, index_of(m.bodies, "bob"));
  expect_near(m.springs[0].second_point, Vec3(0.0, 0.0, 2.0), 1e-12);
}

TEST(MuJoCo, WhatAFlagDisablesIsNotThere) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("flags-" + std::to_string(::getpid()) + ".xml");
  std::ofstream(file) << "<mujoco><option><flag gravity='disable' equality='disable'/></option><worldbody>"
                         "<body name='a'><joint name='j'/><inertial pos='0 0 1' mass='1' diaginertia='1 1 1'/></body>"
                         "</worldbody><equality><connect name='tie' body1='a' anchor='0 0 1'/></equality></mujoco>";
  const MechanismDescription m = imported(read_mjcf(file.string()));
  std::filesystem::remove(file);
  EXPECT_EQ(m.gravity.norm(), 0.0);
  EXPECT_EQ(m.joints.size(), 1u);
}

TEST(MuJoCo, ReadsSeveralJointsOfABodyAsOneOrAsAChain) {
  const auto read = [](const std::string& joints, const std::string& actuators = "") {
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / ("joints-" + std::to_string(::getpid()) + ".xml");
    std::ofstream(file) << "<mujoco><worldbody><body name='a'><inertial pos='0 0 1' mass='1' diaginertia='1 1 1'/>" +
                               joints + "</body></worldbody>" + actuators + "</mujoco>";
    return imported(read_mjcf(file.string()));
  };
  const std::string hinge_x = "<joint name='x' axis='1 0 0'/>", hinge_y = "<joint name='y' axis='0 1 0'/>";
  EXPECT_EQ(read(hinge_x + hinge_y).joints.at(0).type, JointType::universal);
  EXPECT_EQ(read("<joint name='s' type='slide' axis='0 0 1'/><joint name='h' axis='0 0 1'/>").joints.at(0).type,
            JointType::cylindrical);
  EXPECT_EQ(read("<joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 1 0'/><joint axis='0 0 1'/>")
                .joints.at(0)
                .type,
            JointType::planar);
  EXPECT_EQ(read("<joint type='ball'/>").joints.at(0).type, JointType::spherical);
  // Driven one by one, each is a joint, and what is between them has hardly any mass.
  const MechanismDescription gimbal =
      read(hinge_x + hinge_y, "<actuator><motor joint='x'/><motor joint='y'/></actuator>");
  ASSERT_EQ(gimbal.joints.size(), 2u);
  ASSERT_EQ(gimbal.bodies.size(), 2u);
  EXPECT_TRUE(joint_called(gimbal, "x").driven && joint_called(gimbal, "y").driven);
  EXPECT_LT(std::min(gimbal.bodies[0].mass, gimbal.bodies[1].mass), 1e-8);
}

}  // namespace mujoco_test
}  // namespace boresight::app
#endif
