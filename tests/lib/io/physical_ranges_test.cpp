// Numbers that nothing built can have are refused where they are read, wherever they come from.
#include "boresight/keys/physical_ranges.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "boresight/contact/normal_law.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "good_file.hpp"

namespace boresight {
namespace physical_ranges_test {

// Without its comments, which hold numbers too.
std::string example(const std::string& name) {
  std::ifstream in(std::string(BORESIGHT_EXAMPLES) + name);
  std::string text;
  for (std::string line; std::getline(in, line);) text += line.substr(0, line.find('#')) + "\n";
  return text;
}

std::string error_with(const Setting& setting) { return error_of(example("/3-rrcpr/3-rrcpr.toml"), {setting}); }

// Every text that is a number with a unit: where its number begins, and how long it is.
std::vector<std::pair<std::size_t, std::size_t>> numbers_with_units(const std::string& text) {
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t open = text.find('"'); open != std::string::npos;) {
    const std::size_t close = text.find('"', open + 1);
    if (close == std::string::npos) break;
    const std::string inside = text.substr(open + 1, close - open - 1);
    const std::size_t blank = inside.find(' ');
    double number = 0.0;
    if (blank != std::string::npos && parse_number(inside.substr(0, blank), number) &&
        inside.find_first_of("*(", blank) == std::string::npos)
      found.emplace_back(open + 1, blank);
    open = text.find('"', close + 1);
  }
  return found;
}

TEST(PhysicalRanges, RefuseEveryValueOfAFileThatIsBlownUpBeyondTheReal) {
  for (const char* name : {"/3-rrcpr/3-rrcpr.toml", "/crank-slider/crank-slider.toml", "/four-bar/four-bar.toml"}) {
    const std::string text = example(name);
    const auto places = numbers_with_units(text);
    ASSERT_GT(places.size(), 10u) << name;
    for (const auto& [begin, length] : places)
      for (const char* absurd : {"1e300", "-1e300", "1e40"}) {
        std::string changed = text;
        changed.replace(begin, length, absurd);
        const std::string error = error_of(changed);
        EXPECT_NE(error.find("expected "), std::string::npos)
            << name << " at " << text.substr(begin, 30) << " -> " << absurd << ": " << error;
      }
  }
}

TEST(PhysicalRanges, AreNamedWithTheirBounds) {
  EXPECT_EQ(error_with({"clearance.F1.contact.young", "1e-308 GPa"}),
            "--set clearance.F1.contact.young=1e-308 GPa: clearance.F1.contact.young: found \"1e-308 GPa\", expected "
            "an elastic modulus "
            "from 1 kPa to 10 TPa");
  EXPECT_EQ(error_with({"clearance.F1.cap_radius", "1e300 mm"}),
            "--set clearance.F1.cap_radius=1e300 mm: clearance.F1.cap_radius: found \"1e300 mm\", expected a length "
            "from 1 pm to 10000 km");
  EXPECT_EQ(
      error_with({"gravity.z", "-1e300 m/s^2"}),
      "--set gravity.z=-1e300 m/s^2: gravity: found \"-1e300 m/s^2\", expected an acceleration of at most 1e7 m/s^2");
  EXPECT_EQ(error_with({"motion.duration", "1e12 s"}),
            "--set motion.duration=1e12 s: motion.duration: found \"1e12 s\", expected a time from 1 ns to 1e9 s");
}

TEST(PhysicalRanges, TakeWhatHasBeenBuilt) {
  for (const Setting& setting : std::vector<Setting>{{"clearance.F1.contact.young", "50 kPa"},   // foam
                                                     {"clearance.F1.contact.young", "1.2 TPa"},  // diamond
                                                     {"clearance.F1.radial", "5 nm"},
                                                     {"clearance.F1.contact.density", "22.6 g/cm^3"},  // osmium
                                                     {"payload.mass", "420000 kg"},  // a space station
                                                     {"payload.mass", "0 kg"},
                                                     {"gravity.z", "0 m/s^2"},
                                                     {"gravity.z", "-1e6 m/s^2"},  // a centrifuge
                                                     {"motion.duration", "1 us"},
                                                     {"motion.duration", "30 days"}})
    EXPECT_EQ(error_with(setting), "no error") << setting.path << " = " << setting.value;
}

TEST(PhysicalRanges, HoldAtTheirOwnBounds) {
  for (const PhysicalRange& range :
       {kSizeRange, kMassRange, kDurationRange, kYoungRange, kContactSpeedRange, kStiffnessRange}) {
    const double least = parse_quantity(range.least, range.unit), most = parse_quantity(range.most, range.unit);
    EXPECT_TRUE(holds(range, least) && holds(range, most) && holds(range, -most) && holds(range, 0.0))
        << in_words(range);
    EXPECT_FALSE(holds(range, 0.99 * least) || holds(range, 1.01 * most) || holds(range, 5e-324)) << in_words(range);
  }
}

TEST(PhysicalRanges, RefuseAnInertiaThatIsNotOfItsMass) {
  const std::string error = error_with({"body.platform.mass", "1e-12 kg"});
  EXPECT_EQ(error, "no error");  // 1000 km across, but a body
  EXPECT_NE(error_with({"body.platform.inertia", "1e20 kg m^2"}).find("radius of gyration"), std::string::npos);
}

TEST(PhysicalRanges, RefuseLawsOfMotionThatLeaveThem) {
  const std::string text = example("/four-bar/four-bar.toml");
  const std::size_t drives = text.find("drives = {");
  ASSERT_NE(drives, std::string::npos);
  const std::size_t open = text.find('"', drives), close = text.find('"', open + 1);
  std::string changed = text;
  changed.replace(open + 1, close - open - 1, "1e200*t");
  EXPECT_NE(error_of(changed).find("beyond anything real"), std::string::npos) << error_of(changed);
}

TEST(PhysicalRanges, RefuseAPlayAsWideAsTheJournal) {
  const std::string error = error_with({"clearance.F1.radial", "10 mm"});
  EXPECT_NE(error.find("expected less than journal_radius"), std::string::npos) << error;
}

// Restitution zero is a matter of the law: some stay finite there, some grow without bound.
TEST(Restitution, OfZeroIsTakenByLawsThatStayFiniteAndRefusedByOthersWithTheirNames) {
  const std::string text = example("/3-rrcpr/3-rrcpr.toml");
  int taken = 0, refused = 0;
  for (const NormalLawEntry& law : normal_laws()) {
    std::vector<Setting> settings = {{"clearance.F1.contact.law", law.name}, {"clearance.F1.contact.restitution", "0"}};
    if (law.geometry == ContactGeometry::linear) settings.push_back({"clearance.F1.contact.stiffness", "1e7 N/m"});
    const std::string error = error_of(text, settings);
    if (law.lowest_restitution < 0.0) {
      EXPECT_EQ(error, "no error") << law.name;
      ++taken;
    } else {
      EXPECT_NE(
          error.find(
              "laws that take 0: hunt-crossley, herbert-mcwhannell, lee-wang, lankarani-nikravesh, zhiying-qishao, "
              "carvalho-martins"),
          std::string::npos)
          << law.name << ": " << error;
      ++refused;
    }
  }
  EXPECT_GE(taken, 8);
  EXPECT_GE(refused, 8);
}

TEST(Restitution, OfZeroIsTakenByALawForCylindersWithADissipationThatTakesIt) {
  const std::string text = example("/3-rrcpr/3-rrcpr.toml");
  const std::vector<Setting> zero = {{"clearance.F1.contact.law", "johnson"},
                                     {"clearance.F1.contact.restitution", "0"}};
  EXPECT_NE(error_of(text, zero).find("with law = \"johnson\""), std::string::npos);
  std::vector<Setting> with = zero;
  with.push_back({"clearance.F1.contact.dissipation", "hunt-crossley"});
  EXPECT_EQ(error_of(text, with), "no error");
}

TEST(Restitution, StaysInsideOfWhatItMeans) {
  for (const char* value : {"-0.1", "1.01", "1e-300"})
    EXPECT_NE(error_with({"clearance.F1.contact.restitution", value}), "no error") << value;
}

}  // namespace physical_ranges_test
}  // namespace boresight
