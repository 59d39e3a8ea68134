// Runs between which the rig was set up anew: each has offsets of its own, and errors are told by what runs have in common.
#include <gmock/gmock.h>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/calibration/next_test.hpp"
#include "poses_bench.hpp"

namespace boresight {
namespace offsets_per_run_test {

using poses::gimbal;
using poses::kArcsec;

const std::vector<std::string> kErrors = {"error.IA", "error.IE", "error.NPAE"};

poses::Bench bench_of(int poses) { return {gimbal(), kErrors, {6, 7, 8}, poses}; }

// As many runs of the same stars; of run r, channel c is off by 20 (r + 1) (-1)^(r + c) arcsec. missing: of the last run, a channel.
CalibrationProblem problem_of(const poses::Bench& bench, int runs, bool per_run, int missing = -1) {
  CalibrationProblem all = bench.problem(std::vector<double>(3, kArcsec), 1);
  all.runs.clear();
  for (int r = 0; r < runs; ++r) {
    CalibrationProblem one = bench.problem(std::vector<double>(3, kArcsec), static_cast<unsigned>(10 + r));
    MeasuredData data = one.runs.front().data;
    for (int c = 0; c < 3; ++c) data.value.col(c).array() += ((r + c) % 2 ? -20.0 : 20.0) * (r + 1) * kArcsec;
    if (missing >= 0 && r == runs - 1) data.value.col(missing).setConstant(std::nan(""));
    all.runs.emplace_back("night " + std::to_string(r + 1), bench.mechanism, data);
  }
  all.loss.kind = Loss::none;
  all.fit_bias = true;
  all.offsets_per_run = per_run;
  all.prepare(std::numeric_limits<double>::infinity(), true);
  return all;
}

const ParameterEstimate& named(const std::vector<ParameterEstimate>& all, const std::string& name) {
  for (const ParameterEstimate& e : all)
    if (e.name == name) return e;
  throw std::logic_error(name);
}

TEST(OffsetsPerRun, AreFoundBesideTheErrorsThatRunsShare) {
  const poses::Bench bench = bench_of(60);
  CalibrationProblem problem = problem_of(bench, 3, true);
  EXPECT_EQ(problem.global_count(), 3 + 9);
  EXPECT_THAT(problem.global_names(), testing::Contains("bias.night 2.bx"));
  const CalibrationResult own = calibrate(problem, {});
  ASSERT_TRUE(own.fit.converged) << own.fit.reason;
  for (std::size_t p = 0; p < kErrors.size(); ++p) {
    const ParameterEstimate& e = own.inference.parameters[p];
    EXPECT_NEAR(e.value, bench.truth(kErrors[p]), 4.0 * e.standard_error) << e.name;
  }
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const char* channels[] = {"bx", "by", "bz"};
      const ParameterEstimate& e =
          named(own.inference.parameters, "bias.night " + std::to_string(r + 1) + "." + channels[c]);
      EXPECT_NEAR(e.value, ((r + c) % 2 ? -20.0 : 20.0) * (r + 1) * kArcsec, 4.0 * e.standard_error) << e.name;
    }
  // One offset for all of them leaves the nights' own in the readings, tens of times the noise.
  CalibrationProblem shared = problem_of(bench, 3, false);
  const CalibrationResult common = calibrate(shared, {});
  for (std::size_t p = 0; p < kErrors.size(); ++p)
    EXPECT_GT(common.inference.parameters[p].standard_error, 10.0 * own.inference.parameters[p].standard_error);
}

// A channel that a run has not has no offset there, and makes nothing singular.
TEST(OffsetsPerRun, AreOfTheChannelsThatARunHas) {
  const poses::Bench bench = bench_of(60);
  CalibrationProblem problem = problem_of(bench, 2, true, 1);
  EXPECT_EQ(problem.global_count(), 3 + 5);
  const CalibrationResult result = calibrate(problem, {});
  ASSERT_TRUE(result.fit.converged) << result.fit.reason;
  for (std::size_t p = 0; p < kErrors.size(); ++p) {
    const ParameterEstimate& e = result.inference.parameters[p];
    EXPECT_TRUE(e.identifiable) << e.name;
    EXPECT_NEAR(e.value, bench.truth(kErrors[p]), 4.0 * e.standard_error) << e.name;
  }
}

// A further night of the same stars tells as much as the first did, offsets of its own that it has to find included.
TEST(OffsetsPerRun, OfAFurtherTestAreUnknownToo) {
  const poses::Bench bench = bench_of(500);
  CalibrationProblem problem = problem_of(bench, 1, true);
  const CalibrationResult result = calibrate(problem, {});
  const NextTest same =
      judge_candidate(problem, result.inference, result.fit.globals, {false, false, false}, {"same", gimbal()});
  ASSERT_EQ(same.refusal, "");
  EXPECT_NEAR(same.a_ratio, 0.5, 5e-3);
}

}  // namespace offsets_per_run_test
}  // namespace boresight
