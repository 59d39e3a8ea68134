// The generator says what it means: the same text for a seed, files that the program reads, joints that close at home, as many
// freedoms as each kind of mechanism is meant to have.
#include "generator.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "families.hpp"

namespace boresight::gauntlet {
namespace {

// Half of them are older than the youngest family.
std::vector<std::uint64_t> seeds() {
  std::vector<std::uint64_t> all;
  for (std::uint64_t k = 1; k <= 150; ++k) {
    all.push_back(k);
    all.push_back(100'000 + k);
  }
  return all;
}

Mechanism built(const Scene& scene) { return Mechanism(read_mechanism_text(scene.toml(), scene.name)); }

TEST(Generator, GivesTheSameTextForASeed) {
  for (std::uint64_t seed : {1u, 17u, 230u}) {
    EXPECT_EQ(generate(seed).toml(), generate(seed).toml());
    EXPECT_NE(generate(seed).toml(), generate(seed + 1).toml());
  }
}

TEST(Generator, DrawsNoFamilyThatIsYoungerThanTheSeed) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) EXPECT_NE(generate(seed).family, "stage") << seed;
}

TEST(Generator, WritesFilesThatTheProgramReads) {
  for (const std::uint64_t seed : seeds()) EXPECT_NO_THROW(built(generate(seed))) << seed;
}

TEST(Generator, HasAsManyFreeFreedomsAsMeant) {
  for (const std::uint64_t seed : seeds()) {
    const Scene scene = generate(seed);
    EXPECT_EQ(undriven_freedoms(built(scene)), scene.undriven_freedoms) << seed << ' ' << scene.about;
  }
}

TEST(Generator, DrivesAreIndependent) {
  for (const std::uint64_t seed : seeds()) {
    const Scene scene = generate(seed);
    const Mechanism mechanism = built(scene);
    // Without its drives a mechanism has a freedom more for each of them.
    Scene slack = scene;
    int drives = 0;
    for (SceneJoint& j : slack.joints) {
      drives += !j.law.empty();
      j.law.clear();
    }
    EXPECT_EQ(undriven_freedoms(built(slack)), scene.undriven_freedoms + drives) << seed << ' ' << scene.about;
  }
}

TEST(Generator, DrawsEveryFamily) {
  std::set<std::string> drawn, known;
  for (const std::uint64_t seed : seeds()) drawn.insert(generate(seed).family);
  for (const Family& f : families()) known.insert(f.name);
  EXPECT_EQ(drawn, known);
}

TEST(Generator, DrawsEveryLawBothAxesAndGravityOfEveryDirection) {
  std::map<std::string, int> contact, friction;
  int free_axes = 0, parallel = 0, several = 0, none = 0, weightless = 0, tilted = 0;
  for (const std::uint64_t seed : seeds()) {
    const Scene scene = generate(seed);
    several += scene.plays.size() > 1;
    none += scene.plays.empty();
    weightless += scene.gravity.norm() == 0.0;
    tilted += scene.gravity.head<2>().norm() > 1.0;
    for (const ScenePlay& p : scene.plays) {
      ++contact[p.contact.law];
      ++friction[p.friction.law];
      (p.free_axes ? free_axes : parallel) += 1;
    }
  }
  EXPECT_GE(contact.size(), 15u);
  EXPECT_EQ(friction.size(), 6u);
  for (int count : {free_axes, parallel, several, weightless, tilted}) EXPECT_GT(count, 40);
  EXPECT_GT(none, 3);
}

}  // namespace
}  // namespace boresight::gauntlet
