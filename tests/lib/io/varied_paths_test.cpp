// What a study varies, and the settings that this leaves without effect.
#include "boresight/io/varied_paths.hpp"

#include <gmock/gmock.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace varied_paths_test {

using testing::AllOf;
using testing::HasSubstr;

const Origin kAt{"study.toml", 7};

MechanismDescription with(const std::vector<Setting>& settings) {
  return read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/altaz-gimbal/bearing-pairs.toml", settings);
}

// Of a study that varies these paths; "": taken.
std::string refusal(const std::vector<Setting>& settings, const std::vector<std::string>& varied,
                    OwnValue own = OwnValue::unread) {
  const MechanismDescription mechanism = with(settings);
  VariedPaths paths(mechanism);
  try {
    for (const std::string& path : varied) paths.take(kAt, "sweep.axis.parameter", {path}, own);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(VariedPaths, RefuseASettingOfWhatTheStudyVariesWithBothPlaces) {
  EXPECT_THAT(
      refusal({{"clearance.azimuth.radial", "0.2mm"}}, {"clearance.azimuth.radial"}),
      AllOf(
          HasSubstr("--set clearance.azimuth.radial=0.2mm: clearance.azimuth.radial: found a value that would have no "
                    "effect: the study varies it (study.toml:7)"),
          HasSubstr("expected no --set of it")));
  EXPECT_NE(refusal({{"clearance.azimuth.radial", "0.2mm"}}, {"clearance.*.radial"}), "");
}

TEST(VariedPaths, TakeSettingsThatHaveAnEffect) {
  EXPECT_EQ(refusal({{"clearance.upper.radial", "0.2mm"}, {"motion.duration", "1 s"}}, {"clearance.azimuth.radial"}),
            "");
  EXPECT_EQ(refusal({{"clearance.*.radial", "0.2mm"}}, {"clearance.azimuth.radial"}), "") << "it sets the others";
  EXPECT_EQ(refusal({{"clearance.azimuth.radial", "0.2mm"}}, {"clearance.azimuth.radial"}, OwnValue::read), "");
}

TEST(VariedPaths, RefuseAStarOfWhichTheStudyVariesEveryOne) {
  const std::vector<Setting> all = {{"clearance.*.radial", "0.2mm"}};
  EXPECT_EQ(refusal(all, {"clearance.azimuth.radial", "clearance.upper.radial"}), "");
  EXPECT_NE(refusal(all, {"clearance.azimuth.radial", "clearance.upper.radial", "clearance.elevation.radial",
                          "clearance.far.radial"}),
            "");
}

TEST(VariedPaths, AreEachTakenOnce) {
  EXPECT_THAT(refusal({}, {"clearance.*.radial", "clearance.azimuth.radial"}),
              HasSubstr("study.toml:7: sweep.axis.parameter: found \"clearance.azimuth.radial\" a second time"));
  const MechanismDescription mechanism = with({});
  VariedPaths paths(mechanism);
  paths.take(kAt, "random.parameter", {"clearance.*.radial"});
  EXPECT_TRUE(paths.contains("clearance.azimuth.radial"));
  EXPECT_FALSE(paths.contains("clearance.azimuth.axial"));
}

}  // namespace varied_paths_test
}  // namespace boresight
