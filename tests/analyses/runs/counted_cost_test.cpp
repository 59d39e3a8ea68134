// What samples cost by count, from the table that the header prints.
#include "boresight_analyses/runs/counted_cost.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace boresight {
namespace counted_cost_test {

TEST(CountedCost, OfAnEvaluationIsTheTablesForBodiesAndClearances) {
  const auto microseconds = [](const char* rung, bool lanes, std::size_t bodies, std::size_t clearances) {
    return 1e6 * nominal_seconds_an_evaluation(rung, lanes, bodies, clearances);
  };
  EXPECT_NEAR(microseconds("envelope", false, 7, 3), 15.0, 1e-9);
  EXPECT_NEAR(microseconds("quasistatic", false, 7, 3), 3.0, 1e-9);
  EXPECT_NEAR(microseconds("perturbation", false, 7, 3), 0.84 + 0.96, 1e-9);
  EXPECT_NEAR(microseconds("perturbation", true, 7, 3), 0.45, 1e-9);
  EXPECT_NEAR(microseconds("multibody", false, 7, 3), 2.1 + 2.7, 1e-9);
  // A mechanism without clearances costs as one with one.
  EXPECT_NEAR(microseconds("multibody", false, 7, 0), 2.1 + 0.9, 1e-9);
  EXPECT_THROW(nominal_seconds_an_evaluation("static", false, 1, 1), std::invalid_argument);
}

}  // namespace counted_cost_test
}  // namespace boresight
