#include "boresight_analyses/sweep/sweep.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "boresight/ladder/ladder.hpp"
#include "example.hpp"

namespace boresight {
namespace sweep_test {

const char* const kGrid =
    "[[sweep.axis]]\nparameter = [\"clearance.F1.radial\", \"clearance.F1.axial\"]\nvalues = [\"0.1 mm\", "
    "\"0.2 mm\"]\n"
    "[[sweep.axis]]\nparameter = \"payload.mass\"\nvalues = [\"0 kg\", \"250 kg\", \"500 kg\"]\n";

class SweepTest : public testing::Test {
 protected:
  SweepResult sweep(int jobs, const std::function<bool(const SweepProgress&)>& progress = {}, double step = 0.0) const {
    SweepOptions options;
    options.jobs = jobs;
    options.run.step = step;
    options.progress = progress;
    return run_sweep(*rung_, *mechanism_, plan_, options);
  }

  std::shared_ptr<const Mechanism> mechanism_ = short_mechanism();
  SweepPlan plan_ = plan_of(kGrid, *mechanism_);
  std::unique_ptr<Rung> rung_ = make_rung("multibody", mechanism_);
};

void expect_same(const RunResult& a, const RunResult& b) {
  EXPECT_EQ(a.index.position_error.max, b.index.position_error.max);
  EXPECT_EQ(a.index.position_error.rms, b.index.position_error.rms);
  EXPECT_EQ(a.index.line_of_sight_error.p9973, b.index.line_of_sight_error.p9973);
  EXPECT_EQ(a.contact[0].impacts, b.contact[0].impacts);
  EXPECT_EQ(a.contact[0].max_force, b.contact[0].max_force);
  ASSERT_EQ(a.time, b.time);
  for (std::size_t i = 0; i < a.time.size(); ++i) EXPECT_EQ(a.boresight.samples[i].a, b.boresight.samples[i].a);
}

TEST_F(SweepTest, APointIsTheSingleRunWithItsParameters) {
  const SweepResult result = sweep(1);
  ASSERT_EQ(result.points.size(), 6u);
  for (std::size_t k = 0; k < result.points.size(); ++k) {
    ASSERT_EQ(result.points[k].status, SweepPoint::Status::done);
    Parameters parameters = mechanism_->parameters();
    parameters.clearance[0].radial = parameters.clearance[0].axial = result.points[k].values[0];
    parameters.payload_mass = result.points[k].values[1];
    expect_same(result.points[k].result, rung_->run(parameters, {}));
  }
  EXPECT_GT(result.points[3].result.index.position_error.max, result.points[0].result.index.position_error.max);
}

TEST_F(SweepTest, GivesTheSameBitsForAnyNumberOfThreads) {
  const SweepResult one = sweep(1), four = sweep(4), many = sweep(50);
  for (std::size_t k = 0; k < one.points.size(); ++k) {
    expect_same(one.points[k].result, four.points[k].result);
    expect_same(one.points[k].result, many.points[k].result);
  }
}

TEST_F(SweepTest, StopsWhenAskedAndSaysWhatItReached) {
  const SweepResult result = sweep(2, [](const SweepProgress& p) { return p.done < 1.0; });
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.points.back().status, SweepPoint::Status::not_reached);
}

TEST_F(SweepTest, ProgressOnlyGrowsAndEndsAtTheLastPoint) {
  double last = 0.0;
  sweep(2, [&](const SweepProgress& p) {
    EXPECT_GE(p.done, last);
    last = p.done;
    return true;
  });
  EXPECT_NEAR(last, 6.0, 1e-9);
}

TEST_F(SweepTest, AFailedPointNamesItsReasonAndTheOthersGoOn) {
  const SweepResult result = sweep(2, {}, 1e-3);  // far too large a step
  EXPECT_EQ(result.failed, 6u);
  EXPECT_FALSE(result.interrupted);
  EXPECT_THAT(result.points[0].failure, testing::HasSubstr("F1"));
}

// Of all that a point has, its history and its contacts, and the time that it took: it was not computed again.
TEST_F(SweepTest, GoesOnWithThePointsThatAreKept) {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "boresight_kept_points.db";
  std::filesystem::remove(file);
  const auto sweep_kept = [&](const std::function<bool(const SweepProgress&)>& progress) {
    KeptResults kept(std::make_unique<SampleStore>(file, std::map<std::string, std::string>{{"study", "this"}},
                                                   KeptResults::columns()));
    SweepOptions options;
    options.progress = progress;
    options.kept = &kept;
    return run_sweep(*rung_, *mechanism_, plan_, options);
  };
  const SweepResult begun = sweep_kept([](const SweepProgress& p) { return p.done < 2.5; });
  ASSERT_TRUE(begun.interrupted);
  ASSERT_EQ(begun.points[1].status, SweepPoint::Status::done);
  const SweepResult ended = sweep_kept({}), whole = sweep(1);
  ASSERT_FALSE(ended.interrupted);
  for (std::size_t k = 0; k < whole.points.size(); ++k) {
    const RunResult &mine = ended.points[k].result, &theirs = whole.points[k].result;
    expect_same(mine, theirs);
    EXPECT_EQ(ended.points[k].values, whole.points[k].values);
    EXPECT_EQ(mine.integrator, theirs.integrator);
    EXPECT_EQ(mine.contact[0].joint, theirs.contact[0].joint);
    EXPECT_EQ(mine.error.basis, theirs.error.basis);
    EXPECT_EQ(mine.warnings, theirs.warnings);
    EXPECT_EQ(mine.boresight.samples.back().pose.q.coeffs(), theirs.boresight.samples.back().pose.q.coeffs());
    ASSERT_EQ(mine.events.size(), theirs.events.size());
    for (std::size_t e = 0; e < mine.events.size(); ++e) {
      EXPECT_EQ(mine.events[e].place, theirs.events[e].place);
      EXPECT_EQ(mine.events[e].max_force, theirs.events[e].max_force);
    }
    if (k < 2) {
      EXPECT_EQ(mine.cost.cpu_seconds, begun.points[k].result.cost.cpu_seconds);
    }
  }
  std::filesystem::remove(file);
}

}  // namespace sweep_test
}  // namespace boresight
