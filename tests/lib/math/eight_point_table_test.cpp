#include "boresight/math/eight_point_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "boresight/math/time_table.hpp"

namespace boresight {
namespace eight_point_table_test {

constexpr double kSpacing = 0.02;
constexpr int kKnots = 21;

std::vector<double> tabled(const std::vector<std::function<double(double)>>& functions) {
  std::vector<double> values;
  for (int k = 0; k < kKnots; ++k)
    for (const auto& f : functions) values.push_back(f(k * kSpacing));
  return values;
}

// The largest miss between the knots, but for so many cells at either end.
template <class Table>
double miss(const Table& table, const std::function<double(double)>& f, int cells_left_out = 0) {
  double worst = 0.0;
  const double first = cells_left_out * kSpacing, last = (kKnots - 1 - cells_left_out) * kSpacing;
  for (int i = 0; i <= 997; ++i) {
    const double t = first + (last - first) * i / 997.0;
    double value = 0.0;
    table.at(t, &value);
    worst = std::max(worst, std::abs(value - f(t)));
  }
  return worst;
}

TEST(EightPointTable, IsExactForPolynomialsOfDegreeSeven) {
  const auto f = [](double t) { return std::pow(5.0 * t - 1.0, 7) + 3.0 * std::pow(t, 4) - 2.0; };
  EXPECT_LT(miss(EightPointTable(kSpacing, 1, tabled({f})), f), 2e-14);
}

// On a grid whose cubics are good to 2e-6, as the scenes' are. Its last cells are interpolated from one side.
TEST(EightPointTable, HasThreeDigitsMoreThanCubicsOnTheSameGridAndTwoAtItsEnds) {
  const auto f = [](double t) { return std::cos(8.0 * t); };
  const EightPointTable table(kSpacing, 1, tabled({f}));
  const TimeTable cubics(kSpacing, 1, tabled({f}));
  constexpr int kInside = EightPointTable::kPoints / 2;
  EXPECT_GT(miss(cubics, f, kInside), 1e-7);
  EXPECT_LT(miss(table, f, kInside), 1e-3 * miss(cubics, f, kInside));
  EXPECT_LT(miss(table, f), 1e-2 * miss(cubics, f));
}

TEST(EightPointTable, MeetsEveryKnotOfEveryFunction) {
  const std::vector<std::function<double(double)>> functions = {
      [](double t) { return std::exp(t); }, [](double t) { return 1.0 / (1.0 + t); }, [](double) { return -3.0; }};
  const EightPointTable table(kSpacing, 3, tabled(functions));
  for (int k = 0; k < kKnots; ++k) {
    double out[3];
    table.at(k * kSpacing, out);
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(out[j], functions[j](k * kSpacing), 4e-15) << k;
  }
}

TEST(EightPointTable, FallsWithTheEighthPowerOfTheSpacing) {
  const auto f = [](double t) { return std::sin(60.0 * t); };
  std::vector<double> fine;
  for (int k = 0; k <= 2 * (kKnots - 1); ++k) fine.push_back(f(0.5 * k * kSpacing));
  const double coarse_miss = miss(EightPointTable(kSpacing, 1, tabled({f})), f);
  EXPECT_LT(miss(EightPointTable(0.5 * kSpacing, 1, fine), f), coarse_miss / 100.0);
}

}  // namespace eight_point_table_test
}  // namespace boresight
