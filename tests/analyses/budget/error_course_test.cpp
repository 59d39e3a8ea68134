// Standing errors that have a course in time, and those that a mechanism file gives a value, in a budget: against closed forms.
#include <gmock/gmock.h>

#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "budget/made_budget.hpp"
#include "error_scenes.hpp"
#include "scenes.hpp"

namespace boresight {
namespace error_course_test {

using testing::AllOf;
using testing::HasSubstr;

constexpr double kOffset = 2e-4, kRipple = 3e-4;  // [rad]

const std::string kBudget = "[budget]\nmembers = 40\nattribution = 12\nsampling = \"1 ms\"\nwindow = \"0.2 s\"\n";
const std::string kRippleDrawn =
    "[[random]]\nparameter = \"error.ripple\"\ndistribution = { discrete = { values = [\"-0.3 mrad\", \"0.3 mrad\"] } "
    "}\n";

std::shared_ptr<const Mechanism> mirror(const std::string& more = "", double offset = 0.0) {
  MechanismDescription m = read_mechanism_text(kMirror + more, "mirror.toml");
  m.errors[0].value = offset;
  return std::make_shared<const Mechanism>(std::move(m));
}

std::string contributor(const std::string& keys, const std::string& name = "a") {
  return "[[budget.contributor]]\nname = \"" + name + "\"\n" + keys;
}

const Contribution& contribution(const Budget& b, const std::string& name) {
  for (const Contribution& c : b.contributions)
    if (c.name == name) return c;
  throw std::out_of_range(name);
}

TEST(KnownErrors, AreRowsOfTheirOwnBesideWhatScatters) {
  const Budget b = make_budget(mirror("", kOffset), kRippleDrawn + kBudget).budget;
  const double offset = kOffset * kOffset, ripple = 0.5 * kRipple * kRipple;
  EXPECT_EQ(contribution(b, "error.offset").kind, kKnownKind);
  EXPECT_NEAR(contribution(b, "error.offset").share, offset / (offset + ripple), 5e-3);
  EXPECT_NEAR(contribution(b, "error.ripple").share, ripple / (offset + ripple), 5e-3);
  EXPECT_NEAR(contribution(b, "error.offset").share + contribution(b, "error.ripple").share, 1.0, 1e-6);
  for (const auto& [index, mean] : {std::pair{ErrorIndex::ape, kOffset}, std::pair{ErrorIndex::rpe, 0.0}}) {
    const ClassicalLine& line = table_of(b, index, Interpretation::mixed).lines.at(1);
    EXPECT_EQ(line.name, "error.offset");
    EXPECT_NEAR(line.axes[1].mean, mean, 1e-6 * kOffset);
    EXPECT_NEAR(line.axes[1].sd, 0.0, 1e-6 * kOffset);
    EXPECT_NEAR(line.axes[0].mean, 0.0, 1e-6 * kOffset);
  }
}

// Without it, sin(0.95 pi / 2) of the ripple's amplitude is left.
TEST(KnownErrors, AreWhatTheBudgetWouldBeWithout) {
  const Budget b = make_budget(mirror("", kOffset), kRippleDrawn + kBudget).budget;
  for (const ErrorReduction& r : b.reductions)
    if (r.name == "error.offset") {
      EXPECT_EQ(r.action, "as drawn");
      EXPECT_NEAR(r.after, kRipple * std::sin(0.95 * M_PI / 2.0), 2e-3 * kRipple);
      EXPECT_GT(r.before, r.after + 0.5 * kOffset);
      return;
    }
  FAIL() << "no such line";
}

// A clearance alone is that of the drawn mechanism, so that its share and the error's make all of it.
TEST(KnownErrors, AreNotWithinTheSharesOfClearances) {
  MechanismDescription m = scenes::rrcpr();
  m.motion.duration = 0.2;
  m.errors = {scenes::frame_error(m, ErrorDescription::Kind::translation, "F1", "platform", Vec3::UnitX())};
  m.errors[0].name = "seat";
  m.errors[0].value = 1e-4;
  const Budget b = make_budget(std::make_shared<const Mechanism>(m), "[budget]\nmembers = 2\nsampling = \"1 ms\"\n",
                               "position_error", "quasistatic")
                       .budget;
  EXPECT_GT(contribution(b, "error.seat").share, 0.05);
  EXPECT_GT(contribution(b, "F1").share, 0.05);
  EXPECT_NEAR(contribution(b, "together").share, 0.0, 0.01);
}

TEST(ErrorCourses, OfAnOffsetAreWhatTheSameRippleIsAsALawOfTheDrive) {
  const Budget as_law = make_budget(mirror(), kRippleDrawn + kBudget).budget;
  const Budget as_course =
      make_budget(mirror(),
                  kBudget + contributor("error = \"offset\"\ncourse = \"3e-4*sin(10*pi*t)\"\nfactor = { discrete "
                                        "= { values = [-1, 1] } }\n"))
          .budget;
  for (const ErrorIndex index : {ErrorIndex::ape, ErrorIndex::mpe, ErrorIndex::rpe}) {
    EXPECT_NEAR(mixed_level(as_course, index), mixed_level(as_law, index), 1e-3 * kRipple);
    const Moments law = table_of(as_law, index, Interpretation::mixed).lines.at(0).axes[1],
                  course = table_of(as_course, index, Interpretation::mixed).lines.at(0).axes[1];
    EXPECT_NEAR(course.sd, law.sd, 1e-3 * kRipple);
  }
  EXPECT_NEAR(contribution(as_course, "a").share, 1.0, 1e-9);
  EXPECT_EQ(contribution(as_course, "a").kind, "drive over time");
}

// The mirror's column for its drive's offset is one at all times: a course that grows in time is a drift.
TEST(ErrorCourses, ThatGrowInTimeAreDriftsInEveryIndexAndInterpretation) {
  const Budget b =
      make_budget(
          mirror(),
          kBudget + "separation = \"0.4 s\"\n" +
              contributor("error = \"offset\"\ncourse = \"1e-4*t\"\nfactor = { normal = { mean = 1, sd = 0.2 } }\n",
                          "of the error") +
              contributor("class = \"drift\"\naxes = [\"y\"]\ndistribution = { normal = { mean = \"1e-4 rad/s\", sd = "
                          "\"2e-5 rad/s\" } }\n",
                          "as a class"))
          .budget;
  int compared = 0;
  for (const ClassicalTable& t : b.tables) {
    const Moments course = t.lines.at(0).axes[1], drift = t.lines.at(1).axes[1];
    EXPECT_NEAR(std::abs(course.mean), std::abs(drift.mean), 4e-7) << to_string(t.index) << to_string(t.interpretation);
    EXPECT_NEAR(course.sd, drift.sd, 4e-7) << to_string(t.index) << to_string(t.interpretation);
    ++compared;
  }
  EXPECT_EQ(compared, 12);  // APE, MPE, RPE, PDE by three interpretations
}

// Warming moves the centre of mass away from the joint, 0.1 m beside it, along the arm as it turns: 23.6e-6 * 0.1 m * 5 t cos(t) along x.
TEST(ErrorCourses, OfTemperaturesAreSeenThroughThePose) {
  MechanismDescription m = read_mechanism_text(kMirror, "mirror.toml");
  ErrorDescription warming;
  warming.name = "warming";
  warming.kind = ErrorDescription::Kind::expansion;
  warming.body = 0;
  warming.coefficient = 23.6e-6;
  m.errors.push_back(warming);
  m.bodies[0].center_of_mass = Vec3(0.1, 0.0, 0.0);
  const auto mechanism = std::make_shared<const Mechanism>(m);
  const Budget b = make_budget(mechanism, kBudget + contributor("error = \"warming\"\ncourse = \"5*t\"\n"),
                               "position_error", "perturbation")
                       .budget;
  const ClassicalLine& line = table_of(b, ErrorIndex::ape, Interpretation::mixed).lines.at(0);
  EXPECT_EQ(line.kind, "temperature over time");
  const double one = 23.6e-6 * 0.1 * 5.0;
  EXPECT_NEAR(line.axes[0].mean, one * (std::cos(1.0) + std::sin(1.0) - 1.0), 2e-3 * one);
  EXPECT_NEAR(line.axes[2].mean, -one * (std::sin(1.0) - std::cos(1.0)), 2e-3 * one);
  EXPECT_NEAR(mixed_level(b, ErrorIndex::ape, 3), 0.95 * one, 3e-3 * one);
}

TEST(ErrorCourses, OfOneGroupVaryTogether) {
  const auto value = [](const std::string& group) {
    const std::string keys =
        "error = \"offset\"\ndistribution = { uniform = { min = \"-1 mrad\", max = \"1 mrad\" } }\n" + group;
    return make_budget(mirror(), kBudget + contributor(keys, "a") + contributor(keys, "b")).plan;
  };
  const BudgetPlan together = value("group = \"g\"\n"), apart = value("");
  for (const auto& [plan, same] : {std::pair{&together, true}, std::pair{&apart, false}}) {
    const std::vector<std::uint64_t> streams = streams_of(plan->contributors);
    for (std::uint64_t member = 0; member < 5; ++member) {
      const auto of = [&](std::size_t i) {
        return course(plan->contributors[i], 1, member, streams[i], 1e-3, 1000, plan->windows).front();
      };
      EXPECT_EQ((of(0) - of(1)).norm() < 1e-15, same);
    }
  }
}

// What moves in nothing but errors needs no dynamics; where all of them are zero, as at their medians, there is nothing to follow.
TEST(BudgetWithoutClearance, IsTheSameOnTheCheapRungs) {
  const Budget exact = make_budget(mirror(), kRippleDrawn + kBudget).budget;
  for (const char* rung : {"perturbation", "quasistatic", "envelope"}) {
    const Budget b = make_budget(mirror(), kRippleDrawn + kBudget, "boresight_error", rung).budget;
    for (const ErrorIndex index : {ErrorIndex::ape, ErrorIndex::mpe, ErrorIndex::rpe})
      EXPECT_NEAR(mixed_level(b, index), mixed_level(exact, index), 1e-6 * kRipple) << rung;
    EXPECT_EQ(b.failed, 0) << rung;
  }
}

TEST(ErrorCourses, MistakesAreOneLineWithFileLineAndKey) {
  const auto says = [&](const std::string& study, const std::string& words) {
    try {
      make_budget(mirror(), study);
      ADD_FAILURE() << study;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("study.toml:"), HasSubstr("budget.contributor.a"), HasSubstr(words)));
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  };
  says(kBudget + contributor("error = \"ofset\"\nvalue = \"1 mrad\"\n"), "did you mean offset?");
  says(kBudget + contributor("error = \"offset\"\n"), "a course, a distribution or a value");
  says(kBudget + contributor("error = \"offset\"\nvalue = \"1 K\"\n"), "an angle");
  says(kBudget + contributor("error = \"seat\"\nvalue = \"1 mrad\"\n"), "a length");
  says(kBudget + contributor("error = \"offset\"\nclass = \"bias\"\nvalue = \"1 mrad\"\n"), "error and class");
  says(kBudget + contributor("error = \"offset\"\nvalue = \"1 mrad\"\nfactor = { normal = { mean = 1, sd = 1 } }\n"),
       "a course, which factor multiplies");
  says(kBudget + contributor("error = \"offset\"\ncourse = \"1 + tt\"\n"), "course");
  says(kBudget + contributor("class = \"bias\"\nvalue = \"1 mrad\"\ncourse = \"t\"\n"), "beside error only");
  says(kBudget + contributor("value = \"1 mrad\"\n"), "or error for a standing error");
  says(kRippleDrawn + kBudget + contributor("error = \"ripple\"\nvalue = \"1 mrad\"\n"),
       "which [[random]] scatters too");
}

}  // namespace error_course_test
}  // namespace boresight
