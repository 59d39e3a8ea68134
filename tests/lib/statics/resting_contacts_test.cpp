// What rungs without dynamics say of contacts: of journals that nothing presses, and of a motion's beginning that is left out.
#include "boresight/statics/resting_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/statics/envelope.hpp"
#include "boresight/statics/quasistatic.hpp"

namespace boresight {
namespace resting_contacts_test {

std::shared_ptr<const Mechanism> example(const std::string& path) {
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + path, std::vector<Setting>{}));
}

// The lower of two bearings of a shaft carries it; the upper one is there.
TEST(RestingContacts, OfAJournalThatNothingPressesAreNone) {
  const auto mechanism = example("altaz-gimbal/bearing-pairs.toml");
  int pressed = 0, free = 0;
  for (const ContactSummary& c : make_rests(mechanism)->run(mechanism->parameters(), {}).contact) {
    EXPECT_EQ(c.contact_fraction, c.max_force > 0.0 ? 1.0 : 0.0) << c.joint << ": " << c.max_force << " N";
    ++(c.max_force > 0.0 ? pressed : free);
  }
  EXPECT_GT(pressed, 0);
  EXPECT_GT(free, 0);
}

// Two bearings of one shaft carry what hangs on it together: neither of them all, and none of them nothing.
TEST(RestingContacts, OfABearingPairShareItsLoad) {
  const auto mechanism = example("altaz-gimbal/bearing-pairs.toml");
  std::vector<std::unique_ptr<Rung>> rungs;
  rungs.push_back(make_rests(mechanism));
  rungs.push_back(make_envelope(mechanism));
  for (const auto& rung : rungs) {
    double load[2] = {0.0, 0.0};
    for (const ContactSummary& c : rung->run(mechanism->parameters(), {}).contact)
      if (c.joint == "elevation" || c.joint == "far") load[c.joint == "far"] = c.max_load;
    EXPECT_NEAR(load[0] / load[1], 1.0, 0.1) << rung->name();
    // The tube with its trunnions is all that they carry, and hardly moves: its mass times g.
    double weight = 0.0;
    for (std::size_t b = 0; b < mechanism->description().bodies.size(); ++b)
      if (mechanism->description().bodies[b].name == "tube" || mechanism->description().bodies[b].name == "trunnions")
        weight += mechanism->parameters().body_mass[b] * mechanism->parameters().gravity.norm();
    EXPECT_NEAR((load[0] + load[1]) / weight, 1.0, 0.05) << rung->name();
  }
}

TEST(RestingContacts, LeaveOutWhatComesBeforeTheStart) {
  const auto mechanism = example("3-rrcpr/3-rrcpr.toml");
  std::vector<std::unique_ptr<Rung>> rungs;
  rungs.push_back(make_rests(mechanism));
  rungs.push_back(make_envelope(mechanism));
  for (const auto& rung : rungs) {
    RunOptions options;
    const RunResult whole = rung->run(mechanism->parameters(), options);
    options.start = 0.9 * mechanism->duration();
    const RunResult late = rung->run(mechanism->parameters(), options);
    EXPECT_EQ(late.contact[0].joint, whole.contact[0].joint);
    EXPECT_GT(late.contact[0].max_force, 0.0) << rung->name();
    EXPECT_GT(whole.contact[0].max_force, 1.2 * late.contact[0].max_force) << rung->name();
    double largest = 0.0;
    for (std::size_t k = 0; k < late.time.size(); ++k)
      if (late.time[k] >= options.start) largest = std::max(largest, late.clearances[0][k].normal_force);
    // The envelope's histories hold the worst offset, which no load presses anywhere.
    if (rung->name() == "quasistatic") {
      EXPECT_NEAR(late.contact[0].max_force, largest, 0.01 * largest);
    }
    EXPECT_EQ(late.contact[0].contact_fraction, 1.0) << rung->name();
  }
}

}  // namespace resting_contacts_test
}  // namespace boresight
