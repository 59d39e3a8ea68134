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
  return read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml", settings);
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
  EXPECT_THAT(refusal({{"clearance.F1.radial", "0.2mm"}}, {"clearance.F1.radial"}),
              AllOf(HasSubstr("--set clearance.F1.radial=0.2mm: clearance.F1.radial: found a value that would have no "
                              "effect: the study varies it (study.toml:7)"),
                    HasSubstr("expected no --set of it")));
  EXPECT_NE(refusal({{"clearance.F1.radial", "0.2mm"}}, {"clearance.*.radial"}), "");
}

TEST(VariedPaths, TakeSettingsThatHaveAnEffect) {
  EXPECT_EQ(refusal({{"clearance.F2.radial", "0.2mm"}, {"motion.duration", "1 s"}}, {"clearance.F1.radial"}), "");
  EXPECT_EQ(refusal({{"clearance.*.radial", "0.2mm"}}, {"clearance.F1.radial"}), "") << "it sets the others";
  EXPECT_EQ(refusal({{"clearance.F1.radial", "0.2mm"}}, {"clearance.F1.radial"}, OwnValue::read), "");
}

TEST(VariedPaths, RefuseAStarOfWhichTheStudyVariesEveryOne) {
  const std::vector<Setting> all = {{"clearance.*.radial", "0.2mm"}};
  EXPECT_EQ(refusal(all, {"clearance.F1.radial", "clearance.F2.radial"}), "");
  EXPECT_NE(refusal(all, {"clearance.F1.radial", "clearance.F2.radial", "clearance.F3.radial"}), "");
}

TEST(VariedPaths, AreEachTakenOnce) {
  EXPECT_THAT(refusal({}, {"clearance.*.radial", "clearance.F1.radial"}),
              HasSubstr("study.toml:7: sweep.axis.parameter: found \"clearance.F1.radial\" a second time"));
  const MechanismDescription mechanism = with({});
  VariedPaths paths(mechanism);
  paths.take(kAt, "random.parameter", {"clearance.*.radial"});
  EXPECT_TRUE(paths.contains("clearance.F1.radial"));
  EXPECT_FALSE(paths.contains("clearance.F1.axial"));
}

}  // namespace varied_paths_test
}  // namespace boresight
