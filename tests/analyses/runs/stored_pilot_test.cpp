// What a pilot found, kept in a study's store.
#include "boresight_analyses/runs/stored_pilot.hpp"

#include <gtest/gtest.h>

namespace boresight {
namespace stored_pilot_test {

TEST(StoredPilot, IsReadBackAsItWas) {
  PilotResult pilot;
  pilot.accuracy = 0.02;
  pilot.geometry = true;
  pilot.index = "boresight error, RMS, 95 % quantile over the scatter";
  pilot.unit = "rad";
  pilot.pairs = 12;
  pilot.trials.resize(2);
  pilot.trials[0].rung = "quasistatic";
  pilot.trials[0].error = 1e-4;
  pilot.trials[1].rung = "multibody";
  pilot.trials[1].reference = true;
  pilot.chosen = 0;
  pilot.met = true;
  pilot.errors = {{0.95, 1e-4}};
  pilot.why = "pure geometry";
  const std::optional<PilotResult> read = pilot_of_text(text_of(pilot));
  ASSERT_TRUE(read);
  EXPECT_EQ(text_of(*read), text_of(pilot));
  EXPECT_TRUE(read->geometry);
  EXPECT_EQ(read->pairs, pilot.pairs);
  EXPECT_EQ(read->why, pilot.why);
  ASSERT_EQ(read->trials.size(), 2u);
  EXPECT_EQ(read->trials[0].error, 1e-4);
  EXPECT_TRUE(read->trials[1].reference);
}

}  // namespace stored_pilot_test
}  // namespace boresight
