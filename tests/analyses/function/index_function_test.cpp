// The index as a function: its values are those of single motions, and its points are held to the ranges of their keys.
#include "boresight_analyses/function/index_function.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/interruption.hpp"

namespace boresight {
namespace index_function_test {

using testing::HasSubstr;

const char kRadial[] = "clearance.F1.radial";

std::shared_ptr<const Mechanism> mechanism_of_function() {
  static const auto shared = std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/3-rrcpr.toml", {{"motion.duration", "20 ms"}}));
  return shared;
}

IndexFunction function_of(const std::vector<std::string>& paths, const std::string& rung) {
  return {mechanism_of_function(),
          inputs_named(*mechanism_of_function(), paths),
          {.index = {"position_error", "max"}, .rung = rung}};
}

std::string refusal_of(const IndexFunction& f, const std::vector<double>& point) {
  try {
    f.at(point);
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

TEST(FunctionInputs, HaveTheUnitAndTheValueOfTheirPath) {
  const auto inputs = inputs_named(*mechanism_of_function(), {kRadial, "payload.mass"});
  ASSERT_EQ(inputs.size(), 2u);
  EXPECT_EQ(inputs[0].name(), kRadial);
  EXPECT_EQ(inputs[0].si_unit, "m");
  EXPECT_EQ(inputs[0].nominal, std::vector{mechanism_of_function()->parameters().clearance[0].radial});
  EXPECT_EQ(inputs[1].si_unit, "kg");
}

TEST(FunctionInputs, OfScalesAreTheSharesThatTheyAre) {
  const Mechanism errors(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/3-rrcpr/tolerances.toml"));
  const auto inputs = inputs_named(errors, {"error.A1.scale", "error.A1.zero"});
  EXPECT_EQ(inputs[0].told_unit(), "1");
  EXPECT_EQ(inputs[1].told_unit(), "rad");
}

// A shaft of steel in a housing of aluminium: one path, two materials.
TEST(FunctionInputs, HaveNoSingleValueWhereTheirPathNamesNumbersThatDiffer) {
  const std::string path = "clearance.D.contact.young";
  const auto four_bar = std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml", {{"motion.duration", "20 ms"}}));
  const auto inputs = inputs_named(*four_bar, {path});
  EXPECT_EQ(inputs[0].nominal, (std::vector{207e9, 72e9}));
  const IndexFunction f(four_bar, inputs, {.index = {"position_error", "max"}, .rung = "quasistatic"});
  EXPECT_EQ(f.at(std::vector{207e9}).status, Outcome::Status::done);
  try {
    f.nominal();
    FAIL() << "a nominal point";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(path + ": found values from 7.2e+10 to 2.07e+11 Pa, expected one value"));
  }
  const auto like = inputs_named(*mechanism_of_function(), {"clearance.F1.contact.young"});
  EXPECT_EQ(like[0].nominal, std::vector{72e9});
}

TEST(FunctionInputs, AreRefusedASecondTimeAndWhereTheyNameNothing) {
  EXPECT_THROW(inputs_named(*mechanism_of_function(), {kRadial, kRadial}), InputError);
  EXPECT_THROW(inputs_named(*mechanism_of_function(), {"clearance.F9.radial"}), InputError);
}

TEST(FunctionInputs, AreHeldToTheRangeOfTheirKey) {
  const FunctionInput radial = inputs_named(*mechanism_of_function(), {kRadial}).front();
  EXPECT_NO_THROW(check_value(radial, 1e-4));
  for (const double value : {-1e-4, 1e9, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(check_value(radial, value), ValueFault) << value;
}

TEST(IndexFunction, HasTheValueOfTheMotionAlone) {
  const IndexFunction f = function_of({kRadial}, "quasistatic");
  const std::vector<double> point = {0.13e-3};
  Parameters parameters = mechanism_of_function()->parameters();
  parameters.clearance[0].radial = point[0];
  const RunResult run = make_rung("quasistatic", mechanism_of_function())->run(parameters, RunOptions());
  const Outcome outcome = f.at(point);
  ASSERT_EQ(outcome.status, Outcome::Status::done) << outcome.message;
  EXPECT_EQ(outcome.value, run.index.position_error.max);
}

TEST(IndexFunction, GivesManyPointsTheBitsOfEachAlone) {
  const IndexFunction f = function_of({kRadial, "payload.mass"}, "perturbation");
  std::vector<std::vector<double>> points;
  for (int k = 0; k < 11; ++k) points.push_back({(0.6 + 0.07 * k) * 1e-4, 1.0 + k});
  const std::vector<Outcome> all = f.at_all(points, {});
  ASSERT_EQ(all.size(), points.size());
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_EQ(all[k].value, f.at(points[k]).value) << k;
}

TEST(IndexFunction, RefusesPointsOfAnotherSizeAndValuesThatTheMechanismDoesNotTake) {
  const IndexFunction f = function_of({kRadial, "payload.mass"}, "quasistatic");
  EXPECT_NE(refusal_of(f, {1e-4}), "taken");
  EXPECT_THAT(refusal_of(f, {-1e-4, 1.0}), HasSubstr(kRadial));
  EXPECT_THAT(refusal_of(f, {1e-4, -1.0}), HasSubstr("payload.mass"));
  EXPECT_EQ(refusal_of(f, {1e-4, 1.0}), "taken");
}

// A journal of 10 mm: 9 mm of play alone fit into it, and not within the caps of 12 mm.
TEST(IndexFunction, RefusesValuesThatTheMechanismDoesNotTakeTogether) {
  const IndexFunction f = function_of({kRadial, "clearance.F1.cap_radius"}, "perturbation");
  EXPECT_THAT(refusal_of(f, {30e-3, 50e-3}), HasSubstr("less than journal_radius"));
  EXPECT_THAT(refusal_of(f, {9e-3, 12e-3}),
              HasSubstr("clearance.F1.cap_radius: found 12 mm with journal_radius = 10 mm, radial = 9 mm"));
  EXPECT_EQ(refusal_of(f, {1e-4, 12e-3}), "taken");
  EXPECT_THROW(f.at_all({{1e-4, 12e-3}, {9e-3, 12e-3}}, {}), InputError);
  EXPECT_THROW(f.slopes_at(std::vector{9e-3, 12e-3}), InputError);
}

TEST(IndexFunction, SaysWhyARungHasNoSlopes) {
  EXPECT_EQ(function_of({kRadial}, "perturbation").why_no_slopes(), "");
  EXPECT_NE(function_of({kRadial}, "quasistatic").why_no_slopes(), "");
}

TEST(IndexFunction, StopsWhereItIsTold) {
  const std::atomic<bool> stop{true};
  EXPECT_NE(function_of({kRadial}, "multibody").at(std::vector{1e-4}, stop).status, Outcome::Status::done);
}

// A four-bar whose journal stays in contact: the slopes of a motion of so many seconds are followed for about as long as that.
TEST(IndexFunction, StopsItsSlopesWhereItIsTold) {
  const auto mechanism = std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/four-bar/four-bar.toml", {{"motion.duration", "4 s"}}));
  const IndexFunction f(mechanism, inputs_named(*mechanism, {"clearance.D.radial"}),
                        {.index = {"position_error", "rms"}, .rung = "perturbation"});
  const std::atomic<bool> set{true};
  EXPECT_THROW(f.slopes_at(std::vector{1e-4}, set), Interrupted);

  // In the midst of them: the motion's derivatives are followed last.
  static std::atomic<bool> stop, reached;
  stop = reached = false;
  watch_work([](const char* what, double share) {
    reached = reached || (std::string(what).find("derivatives") != std::string::npos && share > 0.5);
    stop = stop || reached;
    return true;
  });
  EXPECT_THROW(f.slopes_at(std::vector{1e-4}, stop), Interrupted);
  watch_work(nullptr);
  EXPECT_TRUE(reached);
}

// Another scene for every payload: while it is built, too.
TEST(IndexFunction, StopsWhereASceneIsBuiltForIt) {
  const IndexFunction f = function_of({"payload.mass"}, "envelope");
  static std::atomic<bool> stop;
  static std::atomic<int> looks;
  stop = false;
  looks = 0;
  watch_work([](const char*, double) {
    stop = true;
    ++looks;
    return true;
  });
  EXPECT_EQ(f.at(std::vector{10.0}, stop).status, Outcome::Status::not_reached);
  watch_work(nullptr);
  EXPECT_EQ(looks, 1);
  EXPECT_EQ(f.at(std::vector{10.0}).status, Outcome::Status::done);  // what was begun is no trap for the next one
}

}  // namespace index_function_test
}  // namespace boresight
