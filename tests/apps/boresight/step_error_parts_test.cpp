#include "report_parts/step_error_parts.hpp"

#include <gmock/gmock.h>

#include "report_parts/report_parts.hpp"
#include "run/error_lines.hpp"

namespace boresight::app {
namespace step_error_parts_test {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const IndexChoice kMaximum{"position_error", "max"}, kTurn{"orientation_error", "rms"};

PointingIndices indices(double position, double turn) {
  PointingIndices of;
  of.position_error.max = position;
  of.orientation_error.rms = turn;
  return of;
}

// Further runs that agree among each other, and lie off by this much.
MeasuredError off_by(double position, double turn) {
  MeasuredError measured;
  measured.measured = true;
  measured.runs = 2;
  measured.basis = "measured by further runs";
  measured.stated = indices(position, turn);
  return measured;
}

RunResult left_out(double share, const PointingIndices& index) {
  RunResult result;
  result.rung = "quasistatic";
  result.index = index;
  result.error.model.fill(share);
  result.error.basis = "what vibrates";
  return result;
}

TEST(StepsMislead, WhereTheyLeaveOutMoreThanThereIs) {
  EXPECT_THAT(steps_mislead(off_by(2e-4, 0.0), indices(1e-4, 0.0), kMaximum, 1.0), HasSubstr("not followed"));
  EXPECT_THAT(steps_mislead(off_by(9e-5, 0.0), indices(1e-4, 0.0), kMaximum, 1.0), IsEmpty());
  EXPECT_THAT(steps_mislead(off_by(0.0, 2e-6), indices(0.0, 1e-6), kTurn, 1.0), HasSubstr("not followed"));
}
// Neighbouring steps that lie as far apart as all there is show no motion of many, but none.
TEST(StepsMislead, WhereNeighbouringStepsLieAsFarApart) {
  MeasuredError scattered = off_by(2e-4, 0.0);
  scattered.spread = scattered.stated;
  EXPECT_THAT(steps_mislead(scattered, indices(1e-4, 0.0), kMaximum, 1.0), HasSubstr("neighbouring steps"));
}
TEST(StepsMislead, ButNotAboutTheRoundingOfAMotionWithoutError) {
  EXPECT_THAT(steps_mislead(off_by(3e-13, 0.0), indices(1e-14, 0.0), kMaximum, 1.0), IsEmpty());
  EXPECT_THAT(steps_mislead(off_by(0.0, 3e-13), indices(0.0, 1e-14), kTurn, 1.0), IsEmpty());
  // Of a mechanism of a micrometre the same is no rounding.
  EXPECT_THAT(steps_mislead(off_by(3e-13, 0.0), indices(1e-14, 0.0), kMaximum, 1e-6), HasSubstr("not followed"));
  // Nor is it where what smaller steps give is large.
  EXPECT_THAT(steps_mislead(off_by(1e-5, 0.0), indices(1e-14, 0.0), kMaximum, 1.0), HasSubstr("not followed"));
  // Without play and errors the index is the integration's own error, and a tenth of a micrometre in a metre is followed well.
  EXPECT_THAT(steps_mislead(off_by(5e-7, 0.0), indices(1e-7, 0.0), kMaximum, 1.0, false), IsEmpty());
  EXPECT_THAT(steps_mislead(off_by(5e-7, 0.0), indices(1e-7, 0.0), kMaximum, 1.0, true), HasSubstr("not followed"));
  EXPECT_THAT(steps_mislead(off_by(5e-3, 0.0), indices(1e-3, 0.0), kMaximum, 1.0, false), HasSubstr("not followed"));
}
// Nine figures of per cent say nothing that one word does not.
TEST(StepErrors, ManyTimesWhatIsFoundAreNoPercentages) {
  for (const double times : {1e3, 1e6, 1e9}) {
    const double index = 1e-2 / times;
    EXPECT_THAT(steps_mislead(off_by(1e-2, 0.0), indices(index, 0.0), kMaximum, 1.0),
                AllOf(HasSubstr("times what is found: "), Not(HasSubstr("%"))));
    EXPECT_THAT(step_error_sentence(off_by(1e-2, 0.0), indices(index, 0.0), kMaximum, 1.0),
                AllOf(HasSubstr("times the value itself of what smaller steps give"), Not(HasSubstr("%"))));
    EXPECT_THAT(model_error_said(left_out(times, indices(1e-4, 0.0)), kMaximum, 1.0).sentence,
                AllOf(HasSubstr("by a factor of " + std::string(times < 1e4 ? "1001," : "10000 or more,")),
                      Not(HasSubstr("e+"))));
  }
}

TEST(StepErrorSentence, CallsRoundingByItsName) {
  EXPECT_THAT(step_error_sentence(off_by(3e-13, 0.0), indices(1e-14, 0.0), kMaximum, 1.0),
              HasSubstr("within rounding of what smaller steps give"));
  EXPECT_THAT(step_error_sentence(off_by(1e-6, 0.0), indices(1e-4, 0.0), kMaximum, 1.0),
              HasSubstr("within 1 % of what smaller steps give"));
}

// The RMS of a turn is not as good as the maximum of a distance: each figure has its own.
TEST(StatedErrorText, IsOfTheFigureBesideIt) {
  RunResult result;
  result.index = indices(1e-4, 1e-3);
  const MeasuredError measured = off_by(2e-6, 3.8e-4);
  EXPECT_EQ(stated_error_text(measured, result, kMaximum, 1.0), "± 2 %");
  EXPECT_EQ(stated_error_text(measured, result, kTurn, 1.0), "± 38 %");
  EXPECT_EQ(stated_error_text(off_by(2e-3, 0.0), result, kMaximum, 1.0), "± 20 times it");
  // What a bound of 45 um allows where the journals move by a hundredth of it is not 45 um and a hundred times more.
  EXPECT_EQ(stated_error_text(off_by(0.0, 0.0), left_out(99.0, indices(4.5e-5, 0.0)), kMaximum, 1.0),
            "within a factor of 100");
}
TEST(StatedErrorText, HoldsWhatTheRungLeavesOutToo) {
  EXPECT_EQ(stated_error_text(off_by(2e-6, 0.0), left_out(0.1, indices(1e-4, 0.0)), kMaximum, 1.0), "± 12 %");
}
TEST(StatedErrorText, IsEmptyWhereNothingWasMeasuredAndOfRounding) {
  EXPECT_THAT(stated_error_text({}, left_out(0.1, indices(1e-4, 0.0)), kMaximum, 1.0), IsEmpty());
  EXPECT_THAT(stated_error_text(off_by(3e-13, 0.0), left_out(0.0, indices(1e-14, 0.0)), kMaximum, 1.0), IsEmpty());
}
TEST(ErrorLines, StandWithTheirOwnUncertainties) {
  RunResult result;
  result.index = indices(1e-4, 0.0);
  result.index.position_error.rms = 0.5e-4;
  MeasuredError measured = off_by(2e-6, 0.0);
  measured.stated.position_error.rms = 0.5e-5;
  const std::vector<std::string> with = error_lines(result, measured, 1.0), without = error_lines(result, {}, 1.0);
  EXPECT_THAT(with.front(), AllOf(HasSubstr("± 2 %"), HasSubstr("± 10 %")));
  ASSERT_EQ(with.size(), 3U);
  EXPECT_THAT(with.back(), AllOf(HasSubstr("what steps do"), Not(HasSubstr("leaves out"))));
  EXPECT_EQ(without.size(), 2U);
  EXPECT_THAT(without.front(), Not(HasSubstr("±")));
}

TEST(StepErrorSentence, EndsWithoutAReasonWhereNoneIsKnown) {
  MeasuredError interrupted, refused;
  refused.why_not = "--step-error off";
  const PointingIndices index = indices(1e-4, 0.0);
  EXPECT_EQ(step_error_sentence(interrupted, index, kMaximum, 1.0),
            "what the steps do to the indices was not measured");
  EXPECT_EQ(step_error_sentence(refused, index, kMaximum, 1.0),
            "what the steps do to the indices was not measured: --step-error off");
}

TEST(ModelErrorSaid, IsASentenceToATenthAndAWarningBeyond) {
  const ModelErrorSaid little = model_error_said(left_out(0.02, indices(1e-4, 0.0)), kMaximum, 1.0);
  EXPECT_EQ(little.sentence,
            "position error, maximum: what the quasistatic rung leaves out is about 2 % of it, by its own estimate");
  EXPECT_THAT(little.warning, IsEmpty());
  const ModelErrorSaid much = model_error_said(left_out(0.39, indices(1e-4, 0.0)), kMaximum, 1.0);
  EXPECT_THAT(much.warning, AllOf(HasSubstr("about 39 % of it"), HasSubstr("--rung multibody")));
  const ModelErrorSaid many = model_error_said(left_out(82.0, indices(1e-4, 0.0)), kMaximum, 1.0);
  EXPECT_THAT(many.warning, HasSubstr("off by a factor of 83,"));
  const ModelErrorSaid all = model_error_said(left_out(1.3, indices(1e-4, 0.0)), kMaximum, 1.0);
  EXPECT_THAT(all.warning, AllOf(HasSubstr("up to the whole of it"), Not(HasSubstr("300"))));
}
TEST(ModelErrorSaid, IsSaidWhereARungFindsNothingAndAnotherMuch) {
  EXPECT_THAT(model_error_said(left_out(40.0, indices(1e-14, 0.0)), kMaximum, 1.0).warning,
              HasSubstr("far more than it finds"));
}
TEST(ModelErrorSaid, IsNothingWhereNothingIsLeftOutOrNothingDeviates) {
  EXPECT_THAT(model_error_said(left_out(0.0, indices(1e-4, 0.0)), kMaximum, 1.0).sentence, IsEmpty());
  EXPECT_THAT(model_error_said(left_out(0.5, indices(1e-14, 0.0)), kMaximum, 1.0).warning, IsEmpty());
  RunResult exact = left_out(0.5, indices(1e-4, 0.0));  // of a rung that leaves nothing out, and so states nothing
  exact.error.basis.clear();
  EXPECT_THAT(model_error_said(exact, kMaximum, 1.0).sentence, IsEmpty());
}

TEST(ForceError, IsSaidWhereStepsGoThroughThePeakOfAnImpact) {
  RunResult result;
  result.contact.resize(2);
  result.contact[0].max_force = 100.0;
  result.contact[1].max_force = 200.0;
  MeasuredError measured = off_by(0.0, 0.0);
  measured.contact_force = {29.0, 0.2};
  EXPECT_EQ(force_error_text(measured, result, 0), "± 29 %");
  EXPECT_THAT(force_error_text(measured, result, 1), IsEmpty());
  EXPECT_THAT(force_error_text({}, result, 0), IsEmpty());
}

TEST(IndexTable, HasEachFiguresOwnError) {
  const PointingIndices index = indices(1e-4, 1e-3);
  const RunResult result = left_out(0.02, index);
  const MeasuredError measured = off_by(1e-6, 0.0);
  std::vector<Overlay> overlays = {{"with clearance", &result}};
  const auto position = [&] { return index_table(overlays).rows.at(0).at(1).get<std::string>(); };
  EXPECT_THAT(position(), Not(HasSubstr("±")));
  EXPECT_THAT(index_table(overlays).caption, Not(HasSubstr("±")));
  overlays.front().stated = [&](const IndexChoice& of) { return stated_error_text(measured, result, of, 1.0); };
  EXPECT_EQ(stated_error_text(measured, result, kMaximum, 1.0), "± 3 %");
  EXPECT_THAT(position(), HasSubstr(" ±\u00a03\u00a0%"));
  EXPECT_THAT(index_table(overlays).caption, HasSubstr("±"));
}

}  // namespace step_error_parts_test
}  // namespace boresight::app
