#include "sweep/published_findings.hpp"

#include <gmock/gmock.h>

#include "boresight/io/mechanism_file.hpp"

namespace boresight::app {
namespace published_findings_test {

using Verdict = PublishedFinding::Verdict;

// A sweep whose results are made up, so that every verdict can be turned round.
struct MadeUpSweep {
  const Mechanism mechanism{read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml")};
  SweepPlan plan;
  SweepResult result;

  MadeUpSweep(const std::string& parameter, const std::string& unit, const std::vector<double>& values) {
    plan.axes = {{{parameter}, unit, values}};
    for (std::size_t k = 0; k < values.size(); ++k)
      result.points.push_back({SweepPoint::Status::done, plan.values_at(k), {}, {}});
    for (SweepPoint& p : result.points) p.result.contact = {{"F1", 0.9, 10, 1e-5, 100.0, 0.01, 0.04, 0}};
  }
  RunResult& at(std::size_t k) { return result.points[k].result; }
  PublishedFinding finding(const std::string& words) const {
    for (const PublishedFinding& f : published_findings(mechanism, plan, result))
      if (f.statement.find(words) != std::string::npos) return f;
    ADD_FAILURE() << "no finding says: " << words;
    return {};
  }
};

MadeUpSweep clearance_sweep() { return {"clearance.F1.radial", "m", {1e-4, 2e-4}}; }
MadeUpSweep load_sweep() { return {"payload.mass", "kg", {0.0, 250.0, 500.0}}; }

void set_errors(RunResult& result, double error, double rotation) {
  result.index.position_error = {error, 0.8 * error, 0.7 * error, error, 0.1};
  result.index.orientation_error.max = rotation;
}

TEST(PublishedFindings, GrowthWithClearanceIsJudgedByTheNumbers) {
  MadeUpSweep sweep = clearance_sweep();
  set_errors(sweep.at(0), 1e-4, 0.0);
  set_errors(sweep.at(1), 2e-4, 0.0);
  EXPECT_EQ(sweep.finding("the larger the clearance").verdict, Verdict::agrees);
  set_errors(sweep.at(1), 0.9e-4, 0.0);
  EXPECT_EQ(sweep.finding("the larger the clearance").verdict, Verdict::differs);
}

TEST(PublishedFindings, AnOrientationThatTurnsIsNotUntouched) {
  MadeUpSweep sweep = clearance_sweep();
  set_errors(sweep.at(0), 1e-4, 1e-12);
  set_errors(sweep.at(1), 2e-4, 1e-12);
  EXPECT_EQ(sweep.finding("little on the angular").verdict, Verdict::agrees);
  set_errors(sweep.at(1), 2e-4, 1e-3);
  EXPECT_EQ(sweep.finding("little on the angular").verdict, Verdict::differs);
}

TEST(PublishedFindings, SaysWhichOfTheTwoSentencesOnLoadHolds) {
  MadeUpSweep sweep = load_sweep();
  for (std::size_t k = 0; k < 3; ++k) {
    set_errors(sweep.at(k), 1e-4 * static_cast<double>(k + 1), 0.0);
    sweep.at(k).platform_acceleration_max = Vec3(100.0 * static_cast<double>(k + 1), 0.0, 0.0);
  }
  EXPECT_THAT(sweep.finding("Section 5").measured, testing::HasSubstr("rises with load, as section 4"));
  for (std::size_t k = 0; k < 3; ++k)
    sweep.at(k).platform_acceleration_max = Vec3(100.0 / static_cast<double>(k + 1), 0.0, 0.0);
  EXPECT_THAT(sweep.finding("Section 5").measured, testing::HasSubstr("falls with load, as section 5"));
  EXPECT_EQ(sweep.finding("Section 5").verdict, Verdict::explained);
}

TEST(PublishedFindings, SaysNothingOfParametersThePaperDoesNotVary) {
  const MadeUpSweep sweep("clearance.F1.contact.restitution", "1", {0.5, 0.9});
  EXPECT_TRUE(published_findings(sweep.mechanism, sweep.plan, sweep.result).empty());
}

TEST(PublishedFindings, OnePointSaysNothing) {
  MadeUpSweep sweep = clearance_sweep();
  sweep.result.points[0].status = SweepPoint::Status::failed;
  EXPECT_TRUE(published_findings(sweep.mechanism, sweep.plan, sweep.result).empty());
}

}  // namespace published_findings_test
}  // namespace boresight::app
