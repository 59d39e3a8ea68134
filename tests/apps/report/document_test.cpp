#include "report/document.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace boresight::report {
namespace document_test {

using nlohmann::json;

TEST(Document, LeavesOutWhatSaysNothing) {
  EXPECT_EQ(json(Column{.label = "a"}), json::parse(R"({"label": "a"})"));
  EXPECT_EQ(json(State{.name = "free"}), json::parse(R"({"name": "free"})"));
  EXPECT_EQ(json(Text{"words"}), json::parse(R"({"kind": "text", "text": "words"})"));
}

TEST(Document, WritesASeriesAsTheContractSays) {
  const Series series{
      .name = "a", .x = Names{"F1"}, .y = Numbers{2}, .style = Style::bars, .muted = true, .error_high = {0.5}};
  EXPECT_EQ(
      json(series),
      json::parse(R"({"name": "a", "x": ["F1"], "y": [2.0], "style": "bars", "muted": true, "error_high": [0.5]})"));
}

TEST(Document, WritesAHistogramWithoutY) {
  EXPECT_FALSE(json(Series{.name = "a", .x = Numbers{1}, .style = Style::histogram}).contains("y"));
}

TEST(Thinned, KeepsEverySpike) {
  Numbers x, y;
  for (int i = 0; i < 100000; ++i) x.push_back(i), y.push_back(std::sin(i * 1e-4));
  y[54321] = 7;
  y[12345] = -7;
  const auto [kept_x, kept_y] = thinned(x, y, 2000);
  EXPECT_LE(kept_x.size(), 2000u);
  EXPECT_EQ(*std::max_element(kept_y.begin(), kept_y.end()), 7);
  EXPECT_EQ(*std::min_element(kept_y.begin(), kept_y.end()), -7);
  EXPECT_TRUE(std::is_sorted(kept_x.begin(), kept_x.end()));
  EXPECT_EQ(kept_x.front(), 0);
  EXPECT_EQ(kept_x.back(), 99999);
}

TEST(Thinned, KeepsGaps) {
  Numbers x, y;
  for (int i = 0; i < 10000; ++i) x.push_back(i), y.push_back(i > 4000 && i < 4100 ? NAN : 1.0);
  const auto kept = thinned(x, y, 400).second;
  EXPECT_TRUE(std::any_of(kept.begin(), kept.end(), [](double one) { return std::isnan(one); }));
}

TEST(HeightOfBars, GrowsWithThemAsFarAsAChartMay) {
  EXPECT_EQ(height_of_bars(5, 80), 540);
  EXPECT_EQ(height_of_bars(40, 80), 2000);
}

TEST(Thinned, LeavesShortSeriesAlone) { EXPECT_EQ(thinned({1, 2, 3}, {4, 5, 6}, 100).second, (Numbers{4, 5, 6})); }

}  // namespace document_test
}  // namespace boresight::report
