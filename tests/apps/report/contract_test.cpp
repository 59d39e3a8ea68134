// What the contract refuses, and that the refusal names the place, the find and the expectation.
#include "report/contract.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "report/document.hpp"
#include "sample.hpp"

namespace boresight::report {
namespace contract_test {

using nlohmann::json;

json with_item(const json& item) {
  return {{"title", "T"}, {"sections", json::array({{{"id", "s"}, {"title", "S"}, {"items", json::array({item})}}})}};
}

json small_chart() {
  Chart chart{.title = "C", .x = {"Time", "s"}, .y = {"Error", "mm"}};
  chart.series = {{.name = "a", .x = Numbers{1, 2}, .y = Numbers{3, 4}}};
  return chart;
}

std::string refusal(const json& document) {
  try {
    check(document);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Contract, ShowsTheBeginningOfALongTextByWholeLetters) {
  std::string greek;
  for (int k = 0; k < 80; ++k) greek += "φ";
  const json document = {{"title", "T"}, {"sections", "x" + greek}};
  // A quotation mark, the x and 55 letters.
  EXPECT_NE(refusal(document).find("found \"x" + greek.substr(0, 110) + "..., expected"), std::string::npos)
      << refusal(document);
}

TEST(Contract, AcceptsEveryKindOfItem) {
  EXPECT_EQ(refusal(sample::every_kind()), "accepted");
  EXPECT_EQ(refusal(sample::hostile()), "accepted");
}

TEST(Contract, AcceptsTheSmallestDocument) {
  EXPECT_EQ(refusal({{"title", "T"}, {"sections", json::array()}}), "accepted");
}

TEST(Contract, AcceptsBarsThatBeginSomewhere) {
  json chart = small_chart();
  chart["series"][0] = {{"name", "steps"}, {"style", "bars"}, {"x", {2.0, 3.0}}};
  chart["series"][0]["y"] = {"first", "second"};
  chart["series"][0]["y_low"] = {0.0, 2.0};
  EXPECT_EQ(refusal(with_item(chart)), "accepted");
  chart["series"][0]["y_low"] = {0.0};
  EXPECT_NE(refusal(with_item(chart)).find("y_low: found 1 values, expected 2, as in x"), std::string::npos);
}

TEST(Contract, NamesThePlaceOfSeriesOfUnequalLength) {
  json chart = small_chart();
  chart["series"][0]["y"] = {1.0, 2.0, 3.0};
  EXPECT_EQ(refusal(with_item(chart)),
            "report document: sections[0].items[0].series[0].y: found 3 values, expected 2, as in x");
}

TEST(Contract, NamesUnknownKeys) {
  json chart = small_chart();
  chart["serie"] = 1;
  EXPECT_NE(refusal(with_item(chart)).find("sections[0].items[0]: found unknown key 'serie'"), std::string::npos);
}

TEST(Contract, NamesMissingKeys) {
  EXPECT_EQ(refusal({{"sections", json::array()}}),
            "report document: (root): found no key 'title', expected the keys title, sections");
}

struct Refused {
  const char* pointer;  // what is changed in the small chart
  json value;
  const char* expected;
};

TEST(Contract, RefusesChartsThatCannotBeDrawnAsMeant) {
  for (const Refused& one : {Refused{"/x/label", "", "some text"},
                             {"/x/range", {2, 1}, "from < to"},
                             {"/x/range", {1}, "two numbers"},
                             {"/y/log", 1, "true or false"},
                             {"/series/0/style", "wavy", "one of line"},
                             {"/series/0/x", 3, "an array"},
                             {"/series/0/y", {1, "two"}, "a number or null"},
                             {"/series/0/error_low", {1, -1}, "not negative"},
                             {"/series/0/y_low", {1, 1}, "style area or bars"},
                             {"/series/0/style", "histogram", "no y"},
                             {"/series/0/text", {"one"}, "2, as in x"},
                             {"/series", json::array(), "series, heatmap"},
                             {"/height", 5, "from 120"},
                             {"/lines", {{{"axis", "z"}, {"value", 1}}}, "one of x, y"},
                             {"/circles", {{{"x", 0}, {"y", 0}, {"r", -1}}}, "from 0"}}) {
    json chart = small_chart();
    chart[json::json_pointer(one.pointer)] = one.value;
    EXPECT_NE(refusal(with_item(chart)).find(one.expected), std::string::npos)
        << one.pointer << ": " << refusal(with_item(chart));
  }
}

TEST(Contract, RefusesWhatLogarithmsCannotShow) {
  json chart = small_chart();
  chart["y"]["log"] = true;
  chart["lines"] = {{{"axis", "y"}, {"value", 0.0}}};
  EXPECT_NE(refusal(with_item(chart)).find("logarithmic"), std::string::npos);
  chart["lines"] = json::array();
  chart["y"]["range"] = {0, 1};
  EXPECT_NE(refusal(with_item(chart)).find("logarithmic"), std::string::npos);
}

TEST(Contract, RefusesHeatMapsThatAreNoGrid) {
  Chart chart{.title = "C",
              .x = {"a"},
              .y = {"b"},
              .heatmap = Heatmap{.x = Numbers{1, 2}, .y = Numbers{1}, .z = {{1, 2, 3}}, .label = "z"}};
  EXPECT_NE(refusal(with_item(chart)).find("heatmap.z[0]: found 3 values, expected 2"), std::string::npos);
}

TEST(Contract, RefusesTablesWhoseRowsDoNotFit) {
  EXPECT_NE(refusal(with_item(Table{.title = "T", .columns = {{"a"}, {"b"}}, .rows = {{1}}}))
                .find("rows[0]: found 1 values, expected 2, as in columns"),
            std::string::npos);
}

TEST(Contract, RefusesStripsWithUnknownStatesOrTimeRunningBack) {
  const auto strip = [](double end, const char* state) {
    return json(Strip{.title = "S", .x = {"t", "s"}, .states = {{"free"}}, .rows = {{"F1", {1}, {end}, {state}}}});
  };
  EXPECT_EQ(refusal(with_item(strip(2, "free"))), "accepted");
  EXPECT_NE(refusal(with_item(strip(2, "stuck"))).find("found \"stuck\", expected one of free"), std::string::npos);
  EXPECT_NE(refusal(with_item(strip(0.5, "free"))).find("end[0]"), std::string::npos);
}

json small_view() {
  View view{.title = "V", .unit = "mm", .time = {0, 1}};
  view.points = {{.x = {0}, .y = {0}, .z = {0}},
                 {.x = {1, 2}, .y = {3, 4}, .z = {5, 6}, .dx = {0, 1}, .dy = {0, 0}, .dz = {0, 0}}};
  view.bodies = {{.name = "rod", .points = {0, 1}}};
  view.joints = {{.name = "F1", .first = 0, .second = 1, .tip = 1, .clearance = ViewClearance{0.1, 0.0}}};
  return view;
}

TEST(Contract, TakesThePointsOfAViewAtRestOrForEachInstant) {
  json view = small_view();
  EXPECT_EQ(refusal(with_item(view)), "accepted");
  view["points"][1]["y"] = {1.0, 2.0, 3.0};
  EXPECT_NE(refusal(with_item(view)).find("points[1].y: found 3 values, expected 2, as in time"), std::string::npos);
  view["points"][1]["y"] = {1.0, NAN};
  EXPECT_NE(refusal(with_item(view)).find("points[1].y[1]"), std::string::npos);
}

TEST(Contract, RefusesViewsOfPointsThatAreNotThere) {
  json view = small_view();
  view["bodies"][0]["points"] = {0, 2};
  EXPECT_NE(refusal(with_item(view)).find("bodies[0].points[1]: found 2, expected the index of one of the 2 points"),
            std::string::npos);
  view = small_view();
  view["joints"][0]["tip"] = -1;
  EXPECT_NE(refusal(with_item(view)).find("joints[0].tip: found -1"), std::string::npos);
  view["joints"][0].erase("tip");
  EXPECT_EQ(refusal(with_item(view)), "accepted");  // a ball's clearance has no axis
  view["joints"][0]["clearance"]["pad"] = 20.0;
  EXPECT_NE(refusal(with_item(view)).find("clearance.pad: found 20.0, expected the joint's tip beside it"),
            std::string::npos);
  view = small_view();
  view["joints"][0]["clearance"]["width"] = 0.1;
  EXPECT_NE(refusal(with_item(view)).find("clearance.width: found 0.1, expected the joint's side beside it"),
            std::string::npos);
  view["joints"][0]["side"] = 0;
  EXPECT_NE(refusal(with_item(view)).find("clearance: found one of width and height, expected both"),
            std::string::npos);
  view["joints"][0]["clearance"]["height"] = 0.1;
  EXPECT_EQ(refusal(with_item(view)), "accepted");
}

TEST(Contract, RefusesSectionsThatCannotBeLinkedTo) {
  Document document{.title = "T", .sections = {{.id = "a", .title = "A"}, {.id = "a", .title = "B"}}};
  EXPECT_NE(refusal(document).find("'a' a second time"), std::string::npos);
  document.sections[1].id = "two words";
  EXPECT_NE(refusal(document).find("sections[1].id"), std::string::npos);
}

TEST(Contract, RefusesUnknownKindsAndVerdicts) {
  EXPECT_NE(refusal(with_item({{"kind", "pie"}})).find("one of text, table"), std::string::npos);
  json document = with_item(small_chart());
  document["verdict"] = {{"status", "fine"}, {"text", "t"}};
  EXPECT_NE(refusal(document).find("one of good, bad, neutral"), std::string::npos);
}

Numbers rounded_y(const Numbers& y) {
  Chart chart{.title = "C", .x = {"x"}, .y = {"y"}};
  chart.series = {{.name = "a", .x = y, .y = y}};
  const json result = rounded(with_item(chart))["sections"][0]["items"][0]["series"][0]["y"];
  Numbers values;
  for (const json& one : result) values.push_back(one.is_null() ? NAN : one.get<double>());
  return values;
}

TEST(Rounding, KeepsSevenDigits) { EXPECT_EQ(rounded_y({1.23456789, 2e-9 / 3}), (Numbers{1.234568, 6.666667e-10})); }

TEST(Rounding, KeepsTheShapeOfASeriesThatHardlyVaries) {
  EXPECT_EQ(rounded_y({1000.00001234, 1000.00002345}), (Numbers{1000.00001234, 1000.00002345}));
}

TEST(Rounding, MakesGapsOfWhatIsNoNumber) {
  const Numbers y = rounded_y({1.0, NAN, INFINITY, -INFINITY});
  EXPECT_EQ(y[0], 1.0);
  for (int i = 1; i < 4; ++i) EXPECT_TRUE(std::isnan(y[i]));
}

TEST(Rounding, GivesDeviationsOfAViewDigitsOfTheirOwn) {
  json view = small_view();
  view["points"][1]["x"] = {123.456789, 1e-7};
  view["points"][1]["dx"] = {1.23456789e-5, -3.3e-8};
  const json point = rounded(with_item(view))["sections"][0]["items"][0]["points"][1];
  EXPECT_EQ(point["x"], (Numbers{123.46, 0.0}));
  EXPECT_EQ(point["dx"], (Numbers{1.2346e-5, -3.3e-8}));
}

TEST(Rounding, LeavesTablesInFull) {
  const json document = with_item(Table{.title = "T", .columns = {{"a"}}, .rows = {{1.23456789012345}}});
  EXPECT_EQ(rounded(document), document);
}

}  // namespace contract_test
}  // namespace boresight::report
