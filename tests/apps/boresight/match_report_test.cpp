#include "match/match_report.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <numbers>

#include "boresight/io/mechanism_file.hpp"

namespace boresight::app {
namespace match_report_test {

TEST(SearchText, SaysHowFarAnInterruptedSearchCame) {
  MatchingResult result;
  EXPECT_EQ(search_text(result), "interrupted in the search of the box, before any descent");
  result.global = "direct";
  EXPECT_EQ(search_text(result), "search of the box: direct, interrupted in the first descent");
  result.local = "bobyqa";
  EXPECT_EQ(search_text(result), "search of the box: direct, descent: bobyqa");
}

TEST(ObjectiveText, HasTheUnitOfWhatItIsHeldAgainst) {
  const MatchingPlan plan;
  const IndexChoice turn{"boresight_error", "max"};
  EXPECT_EQ(objective_text(plan, turn, 0.0002094, 0.0002091), "0.2094 mrad");
  EXPECT_EQ(objective_text(plan, turn, 0.00009, 0.0002091), "0.09 mrad");
}

// A study that writes its limit in arcsec reads its answer in arcsec.
TEST(ObjectiveText, HasTheUnitThatALimitOfTheSameMeasureIsWrittenIn) {
  MatchingPlan plan;
  plan.constraints.push_back({.measure = {.measure = Measure::peak_acceleration}, .at_most = 1.0, .unit = "m/s^2"});
  const IndexChoice turn{"boresight_error", "max"};
  EXPECT_EQ(written_unit(plan, Measure::index), "");
  EXPECT_EQ(objective_text(plan, turn, 0.0002094, 0.0002091), "0.2094 mrad");
  plan.constraints.push_back({.measure = {.over = Over::worst}, .at_most = 3e-4, .unit = "arcsec"});
  EXPECT_EQ(written_unit(plan, Measure::index), "arcsec");
  EXPECT_EQ(objective_text(plan, turn, 0.0002094, 0.0002091), "43.19 arcsec");
}

// It stands at the head of the report, as other verbs' answers do, and on the terminal.
TEST(MatchSentence, BeginsWithACapital) {
  const Mechanism mechanism{read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml")};
  const Command command;
  Study study;
  study.index = {"boresight_error", "max"};
  const RungChoice rung{.name = "quasistatic", .why = ""};
  MatchingPlan plan;
  plan.variables.emplace_back();
  plan.variables.front().paths = {"payload.mass"};
  plan.variables.front().si_unit = plan.variables.front().unit = "kg";
  MatchingResult result;
  result.design = {1.0};
  const MatchStudy matched{command, study, mechanism, rung, plan, result, {}, ""};
  const std::string sentence = match_sentence(matched);
  EXPECT_TRUE(std::isupper(static_cast<unsigned char>(sentence.front()))) << sentence;
}

// 0.2 and 0.26 mrad are 41.3 and 53.6 arcsec; the limit is 50.
TEST(ConstraintTable, SaysWhichRungEachValueIsOfAndWhatTheConfirmationFound) {
  const Mechanism mechanism{read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml")};
  const Command command;
  Study study;
  study.index = {"boresight_error", "max"};
  const RungChoice rung{.name = "quasistatic", .why = ""};
  MatchingPlan plan;
  plan.constraints.push_back({.measure = {}, .at_most = 50.0 * std::numbers::pi / 648000.0, .unit = "arcsec"});
  MatchingResult result;
  result.constraint_values = {2.0e-4};
  result.active = {false};
  const MatchStudy matched{command, study, mechanism, rung, plan, result, {}, ""};
  const auto columns = [&] {
    const report::Table table = constraint_table(matched);
    std::vector<std::string> names;
    for (const report::Column& column : table.columns) names.push_back(column.label);
    return names;
  };
  const auto cells = [&] {
    const report::Table table = constraint_table(matched);
    std::vector<std::string> texts;
    for (const nlohmann::json& cell : table.rows.at(0)) texts.push_back(cell);
    texts.erase(texts.begin());  // which constraint
    return texts;
  };
  EXPECT_EQ(columns(), (std::vector<std::string>{"of", "value on quasistatic", "at most", "kept", "active"}));
  EXPECT_EQ(cells(), (std::vector<std::string>{"41.3 arcsec", "50 arcsec", "yes", "no"}));

  MatchingConfirmation& confirmation = result.confirmation.emplace_back();
  confirmation.rung = "perturbation";
  confirmation.constraint_values = {2.6e-4};
  EXPECT_EQ(columns(), (std::vector<std::string>{"of", "value on quasistatic", "confirmed on perturbation", "at most",
                                                 "kept", "active"}));
  EXPECT_EQ(cells(),
            (std::vector<std::string>{"41.3 arcsec", "53.6 arcsec", "50 arcsec", "yes, not as confirmed", "no"}));

  result.on_confirming_rung = true;
  result.constraint_values = {2.6e-4};
  EXPECT_EQ(columns(), (std::vector<std::string>{"of", "value on perturbation", "at most", "kept", "active"}));
  EXPECT_EQ(cells(), (std::vector<std::string>{"53.6 arcsec", "50 arcsec", "no", "no"}));
}

// A mass of 0 is at the end of its range, and nothing weighs less.
TEST(EndsAtNothing, OnlyWhereNothingIsLess) {
  DesignVariable v;
  v.paths = {"payload.mass"};
  v.si_unit = "kg";
  v.to = 5.0;
  EXPECT_TRUE(ends_at_nothing(v, 0.0));
  EXPECT_FALSE(ends_at_nothing(v, 5.0));
  v.paths = {"payload.center_of_mass.x"};
  v.si_unit = "m";
  EXPECT_FALSE(ends_at_nothing(v, 0.0));
  v.paths = {"clearance.F1.radial"};
  EXPECT_TRUE(ends_at_nothing(v, 0.0));
  v.from = 1e-5;
  EXPECT_FALSE(ends_at_nothing(v, 1e-5));
}

}  // namespace match_report_test
}  // namespace boresight::app
