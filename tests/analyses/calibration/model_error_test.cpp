// What a search whose paths do not agree tells of its errors.
#include "boresight_analyses/calibration/model_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "four_bar_rig.hpp"

namespace boresight {
namespace model_error_test {

// Two ends: the lowest and another. How far that is, the errors are too, and errors as small as they were elsewhere stay so.
TEST(CalibrationModelError, SpansWhatTheEndsOfASearchAreApart) {
  const four_bar::Bench bench({2.0, 2.6}, 0.02, false);
  CalibrationProblem problem = bench.problem({}, four_bar::kFour);
  problem.prepare(10.0, true);
  const Globals lowest = problem.start();
  Globals other = lowest;
  other.u[1] += 0.3;
  const Eigen::Index n = problem.packed(lowest).size();
  CalibrationModelError error;
  error.covariance = 1e-4 * MatX::Identity(n, n);
  error.covariance(3, 3) = std::numeric_limits<double>::quiet_NaN();  // held
  other.u[3] += 0.1;
  const CalibrationModelError before = error;

  span({lowest}, problem, lowest, error);  // one path has nothing to say
  EXPECT_EQ(error.ends, 0);
  EXPECT_EQ(error.covariance(1, 1), 1e-4);

  span({lowest, lowest}, problem, lowest, error);  // nor have two that end in one place
  EXPECT_EQ(error.ends, 0);
  EXPECT_EQ(error.covariance(1, 1), 1e-4);

  span({lowest, other}, problem, lowest, error);
  EXPECT_EQ(error.ends, 1);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      if (i == 3 && j == 3) continue;
      EXPECT_NEAR(error.covariance(i, j), before.covariance(i, j) + (i == 1 && j == 1 ? 0.09 : 0.0), 1e-15) << i << j;
    }
  EXPECT_TRUE(std::isnan(error.covariance(3, 3)));
}

// A clock is said to be late or early where its offset is more than four of its standard errors, and it had been told to be right.
TEST(CalibrationModelError, SaysWhichWayAClockIsOffWhereTheDataKnow) {
  const four_bar::Bench bench({2.0}, 0.02, false);
  CalibrationProblem problem = bench.problem({}, {four_bar::kFour[0]});
  problem.fit_time_offset = true;
  problem.time_offset_prior = 1e-4;
  problem.prepare(10.0, true);
  Inference inference;
  for (const FittedParameter& p : problem.parameters) {
    ParameterEstimate e;
    e.name = p.path;
    e.value = p.start;
    e.standard_error = 0.1 * p.start;
    inference.parameters.push_back(e);
  }
  inference.parameters.resize(static_cast<std::size_t>(problem.time_offset_column()) + 1);
  ParameterEstimate& clock = inference.parameters.back();
  clock.standard_error = 2e-5;
  const auto says = [&](double offset) {
    clock.value = offset;
    std::string all;
    for (const std::string& s : in_words(CalibrationModelError{}, problem, inference)) all += s;
    return all;
  };
  EXPECT_NE(says(-8.1e-5).find("0.081 ms late"), std::string::npos) << says(-8.1e-5);
  EXPECT_NE(says(8.1e-5).find("0.081 ms early"), std::string::npos);
  EXPECT_EQ(says(7.9e-5), "");
  problem.time_offset_prior = 0.0;
  EXPECT_EQ(says(8.1e-5), "") << "it was asked for";
}

// They are asked where runs contradict each other, and nowhere else.
TEST(CalibrationModelError, IsOfRunsThatContradictEachOtherBeyondTheirNoise) {
  CalibrationModelError error;
  error.groups = 10;
  error.disagreement = 1.4;
  EXPECT_FALSE(error.contradicted());
  error.disagreement = 1.6;
  EXPECT_TRUE(error.contradicted());
  error.groups = 1;
  EXPECT_FALSE(error.contradicted());
}

}  // namespace model_error_test
}  // namespace boresight
