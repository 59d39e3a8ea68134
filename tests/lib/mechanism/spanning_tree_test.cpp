// Which joints become tree joints, and with how many numbers.
#include "boresight/mechanism/spanning_tree.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "scenes.hpp"

namespace boresight {
namespace spanning_tree_test {

std::set<std::string> cut(const Mechanism& mechanism, const SpanningTree& tree) {
  std::set<std::string> names;
  for (int joint : tree.cut_joints()) names.insert(mechanism.description().joints[joint].name);
  return names;
}

const TreeJoint& carrying(const Mechanism& mechanism, const SpanningTree& tree, const std::string& body) {
  for (const TreeJoint& t : tree.joints())
    if (t.body == mechanism.body_index(body)) return t;
  throw std::logic_error("no body " + body);
}

Mechanism example(const std::string& name) {
  return Mechanism(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + name + "/" + name + ".toml", {}));
}

// Bodies without joints, and what a test adds.
MechanismDescription two_bodies() {
  MechanismDescription m;
  for (const char* name : {"a", "b"}) {
    BodyDescription b;
    b.name = name;
    b.mass = 1.0;
    m.bodies.push_back(b);
  }
  m.bodies[0].boresight = Vec3::UnitZ();
  return m;
}

TEST(SpanningTree, CutsTheDefaultSceneAtItsClearanceAndOneMoreLoop) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const SpanningTree tree(*mechanism, true);
  EXPECT_EQ(cut(*mechanism, tree), (std::set<std::string>{"F1", "F3"}));
  // B, C (two) in each leg and F2: sixteen coordinates less the six drives.
  EXPECT_EQ(tree.speeds(), 10);
  EXPECT_EQ(tree.positions(), 10);
  EXPECT_EQ(carrying(*mechanism, tree, "crank1").speeds, 0);
  EXPECT_TRUE(carrying(*mechanism, tree, "rod3").driven);
  EXPECT_EQ(carrying(*mechanism, tree, "tube2").speeds, 2);
  EXPECT_EQ(carrying(*mechanism, tree, "platform").parent, mechanism->body_index("rod2"));
}

TEST(SpanningTree, PutsParentsFirstAndBranchesOneAfterTheOther) {
  const auto mechanism = scenes::build(scenes::rrcpr());
  const SpanningTree tree(*mechanism, true);
  std::set<int> seen = {kGround};
  int branches = 0;
  for (const TreeJoint& t : tree.joints()) {
    EXPECT_TRUE(seen.count(t.parent));
    seen.insert(t.body);
    branches += t.parent == kGround;
  }
  EXPECT_EQ(branches, 3);
  // Every branch is one run of speeds: only its first one has none before it on the way to the ground.
  for (int k = 0; k < tree.speeds(); ++k)
    EXPECT_TRUE(tree.speed_parent()[k] == k - 1 || tree.speed_parent()[k] == -1) << "speed " << k;
}

TEST(SpanningTree, CutsWhereFewestRowsAreNeeded) {
  const Mechanism crank_slider = example("crank-slider");
  EXPECT_EQ(cut(crank_slider, SpanningTree(crank_slider, true)), (std::set<std::string>{"A"}));  // opened: two rows
  EXPECT_EQ(cut(crank_slider, SpanningTree(crank_slider, false)),
            (std::set<std::string>{"B"}));  // spherical: three rows
  const Mechanism four_bar = example("four-bar");
  EXPECT_EQ(cut(four_bar, SpanningTree(four_bar, true)), (std::set<std::string>{"D"}));
  EXPECT_EQ(cut(four_bar, SpanningTree(four_bar, false)), (std::set<std::string>{"C"}));
}

// Of two ways round a loop a driven joint is never the one that is cut.
TEST(SpanningTree, KeepsDrivenJoints) {
  MechanismDescription m = two_bodies();
  for (const auto& [first, second] : {std::pair{kGround, 0}, std::pair{kGround, 1}, std::pair{0, 1}}) {
    JointDescription j;
    j.name = "J" + std::to_string(m.joints.size());
    j.first = first;
    j.second = second;
    m.joints.push_back(j);
  }
  m.joints[2].driven = true;
  const Mechanism mechanism(m);
  const SpanningTree tree(mechanism, true);
  EXPECT_EQ(cut(mechanism, tree), (std::set<std::string>{"J1"}));
  EXPECT_EQ(tree.speeds(), 1);
}

TEST(SpanningTree, LetsABodyFloatThatNothingConnectsToTheGround) {
  MechanismDescription m = two_bodies();
  JointDescription j;
  j.name = "hinge";
  j.first = 1;  // described from the far body back
  j.second = 0;
  m.joints.push_back(j);
  const Mechanism mechanism(m);
  const SpanningTree tree(mechanism, true);
  EXPECT_EQ(carrying(mechanism, tree, "a").joint, -1);
  EXPECT_EQ(carrying(mechanism, tree, "a").speeds, 6);
  EXPECT_EQ(carrying(mechanism, tree, "a").positions, 7);
  EXPECT_EQ(carrying(mechanism, tree, "b").parent, 0);
  EXPECT_EQ(carrying(mechanism, tree, "b").drive_sign, -1.0);
  EXPECT_EQ(tree.speed_parent(), (std::vector<int>{-1, 0, 1, 2, 3, 4, 5}));
  EXPECT_TRUE(tree.cut_joints().empty());
}

// With axes kept parallel it has three slides and a turn; a drive prescribes the turn.
TEST(SpanningTree, CarriesABodyByItsClearanceJointWhereNothingElseDoes) {
  MechanismDescription m = two_bodies();
  m.bodies.pop_back();
  JointDescription j;
  j.name = "hinge";
  m.joints.push_back(j);
  ClearanceDescription c;
  c.journal = 0;
  m.clearances.push_back(c);
  for (bool driven : {false, true}) {
    m.joints[0].driven = driven;
    const Mechanism mechanism(m);
    const SpanningTree opened(mechanism, true), closed(mechanism, false);
    EXPECT_EQ(opened.speeds(), driven ? 3 : 4);
    EXPECT_EQ(closed.speeds(), driven ? 0 : 1);
    EXPECT_TRUE(opened.cut_joints().empty());
  }
}

}  // namespace spanning_tree_test
}  // namespace boresight
