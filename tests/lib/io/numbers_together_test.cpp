// What the reader refuses of several numbers together is refused of a sample that has them, too, in the same words.
#include "boresight/keys/numbers_together.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "boresight/mechanism/parameter_path.hpp"
#include "good_file.hpp"
#include "slider_in_guide_file.hpp"

namespace boresight {
namespace numbers_together_test {

struct Set {
  std::string path, text;
  double value;
};

std::optional<ImpossibleNumbers> drawn(const std::string& file, const std::vector<Set>& numbers) {
  const MechanismDescription m = read_mechanism_text(file, "f.toml");
  Parameters parameters = nominal_parameters(m);
  for (const Set& number : numbers) ParameterPath(m, number.path).set(parameters, number.value);
  return impossible_numbers(m, parameters);
}

void expect_refused_alike(const std::string& file, const std::vector<Set>& numbers) {
  std::vector<Setting> settings;
  for (const Set& number : numbers) settings.push_back({number.path, number.text});
  const std::string& name = numbers.front().path;
  const std::optional<ImpossibleNumbers> found = drawn(file, numbers);
  ASSERT_TRUE(found) << name;
  try {
    read_mechanism_text(file, "f.toml", settings);
    ADD_FAILURE() << "the reader takes " << name;
  } catch (const InputError& error) {
    EXPECT_EQ(found->expected, error.expected) << name;
    EXPECT_EQ(found->path, error.key) << name;
  }
}

std::string with_friction(const std::string& more) { return with("coefficient = 0.03", "coefficient = 0.03\n" + more); }

TEST(NumbersTogether, AreRefusedOfASampleWhereTheReaderRefusesThem) {
  expect_refused_alike(kGood, {{"clearance.R.radial", "12 mm", 12e-3}});
  expect_refused_alike(kGood, {{"clearance.R.cap_radius", "10.05 mm", 10.05e-3}});
  expect_refused_alike(kGood,
                       {{"clearance.R.cap_radius", "12 mm", 12e-3}, {"clearance.R.journal_radius", "13 mm", 13e-3}});
  expect_refused_alike(kGood, {{"clearance.R.contact.restitution", "0", 0.0}});
  expect_refused_alike(kGood, {{"clearance.R.friction.dynamic_speed", "0.05 mm/s", 0.05e-3}});
  expect_refused_alike(with_friction("law = \"bengisu-akay\"\nstatic_coefficient = 0.05"),
                       {{"clearance.R.friction.coefficient", "0.06", 0.06}});
  const std::string guide = scenes::slider_in_guide("30 mm", "60 mm");
  expect_refused_alike(guide, {{"clearance.G.width_gap", "15 mm", 15e-3}});
  expect_refused_alike(guide, {{"clearance.G.height_gap", "11 mm", 11e-3}});
  expect_refused_alike(
      with("radial = \"0.1 mm\"\n", "radial = \"0.1 mm\"\nbearing = \"pair\"\nspan = \"60 mm\"\n"),
      {{"clearance.R.sleeve_length", "100 mm", 0.1}, {"clearance.R.floating.sleeve_length", "50 mm", 0.05}});
}

TEST(NumbersTogether, AreTakenWhereTheReaderTakesThem) {
  const std::string pair = with("radial = \"0.1 mm\"\n", "radial = \"0.1 mm\"\nbearing = \"pair\"\nspan = \"30 mm\"\n");
  for (const std::string& file :
       {kGood, scenes::slider_in_guide("30 mm", "60 mm"), pair /* whose sleeves touch */,
        with_friction("law = \"lugre\""), with("restitution = 0.9", "law = \"hunt-crossley\"\nrestitution = 0")}) {
    const std::optional<ImpossibleNumbers> found = drawn(file, {});
    EXPECT_FALSE(found) << found->text();
  }
  EXPECT_FALSE(drawn(kGood, {{"clearance.R.journal_radius", "", 15e-3}}));
}

TEST(NumbersTogether, AreToldWithThoseThatTheyDoNotFit) {
  const auto found = drawn(kGood, {{"clearance.R.cap_radius", "", 12e-3}, {"clearance.R.radial", "", 3e-3}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->text(),
            "clearance.R.cap_radius: found 12 mm with journal_radius = 10 mm, radial = 3 mm, expected more than "
            "journal_radius + radial");
}

}  // namespace numbers_together_test
}  // namespace boresight
