// The loads that `check` foresees, from the ideal motion at a few instants alone, against those under which journals rest.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/statics/quasistatic.hpp"

namespace boresight {
namespace foreseen_loads_test {

struct Load {
  std::string joint;
  double foreseen, carried;  // largest of the motion [N]
};

std::vector<Load> loads_of(const std::filesystem::path& file) {
  const auto mechanism = std::make_shared<const Mechanism>(read_mechanism(file, {}));
  std::vector<Load> loads;
  if (mechanism->clearances() == 0) return loads;
  RunOptions options;
  options.sample_spacing = 0.0;
  options.events = false;
  const std::vector<ContactFrequency> foreseen = analyse_contacts(*mechanism, mechanism->parameters());
  const RunResult rest = make_rests(mechanism)->run(mechanism->parameters(), options);
  for (std::size_t c = 0; c < foreseen.size(); ++c)
    loads.push_back({foreseen[c].joint, foreseen[c].largest_load, rest.contact[c].max_load});
  return loads;
}

TEST(ForeseenLoads, AreCarriedWhereEachJointHasItsOwn) {
  const std::filesystem::path examples = BORESIGHT_EXAMPLES;
  for (const char* file :
       {"3-rrcpr/3-rrcpr.toml", "3-rrcpr/twelve-joints.toml", "3-rrr/3-rrr.toml", "four-bar/four-bar.toml",
        "crank-slider/crank-slider.toml", "2-us-pointing/2-us-pointing.toml", "hexapod/play.toml"}) {
    const std::vector<Load> loads = loads_of(examples / file);
    EXPECT_FALSE(loads.empty()) << file;
    for (const Load& load : loads) {
      // Instants between those that are looked at may ask for more; couples are not in the resultant.
      EXPECT_GT(load.foreseen, 0.95 * load.carried) << file << ", " << load.joint;
      EXPECT_LT(load.foreseen, 1.05 * load.carried) << file << ", " << load.joint;
    }
  }
}

// Of two bearings that share a load, gaps decide which one carries it. That is at most twice the half of it.
TEST(ForeseenLoads, AreNoLessThanHalfOfWhatIsCarriedOnTheGauntletsArchetypes) {
  int looked = 0;
  for (const auto& file : std::filesystem::directory_iterator(BORESIGHT_CORPUS)) {
    if (file.path().extension() != ".toml") continue;
    try {
      for (const Load& load : loads_of(file)) {
        EXPECT_GE(load.foreseen, 0.499 * load.carried) << file.path().filename() << ", " << load.joint;
        ++looked;
      }
    } catch (const ComputationError&) {  // journals do not come to rest there
    }
  }
  EXPECT_GT(looked, 50);
}

}  // namespace foreseen_loads_test
}  // namespace boresight
