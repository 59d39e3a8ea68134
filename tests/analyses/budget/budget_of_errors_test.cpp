// Standing errors in a budget, against closed forms: a mirror on one driven axis that turns at a constant rate, whose boresight is
// off by what its drive is off by.
#include <gmock/gmock.h>

#include <cmath>
#include <complex>

#include "budget/made_budget.hpp"

namespace boresight {
namespace budget_of_errors_test {

constexpr double kOffset = 2e-4, kRipple = 3e-4;  // [rad], at their largest

class BudgetOfErrors : public testing::Test {
 protected:
  // Of these errors, each between minus and plus its largest value with two values alone, so that every square is known.
  Budget budget(const std::vector<std::pair<std::string, std::string>>& drawn, const std::string& more = "") const {
    std::string study;
    for (const auto& [path, value] : drawn)
      study += "[[random]]\nparameter = \"" + path + "\"\ndistribution = { discrete = { values = [\"-" + value +
               "\", \"" + value + "\"] } }\n";
    study += "[budget]\nmembers = 40\nattribution = 12\nsampling = \"1 ms\"\nwindow = \"0.2 s\"\n" + more;
    return make_budget(mechanism_, study).budget;
  }
  // That of error.offset alone, of a Gaussian, at the probability of a study that names none.
  Budget budget_of_one_offset(int members, int attribution) const {
    return make_budget(
               mechanism_,
               "[[random]]\nparameter = \"error.offset\"\ndistribution = { normal = { mean = \"0 arcsec\", sd = "
               "\"10 arcsec\" } }\n[budget]\nmembers = " +
                   std::to_string(members) + "\nsampling = \"20 ms\"\nattribution = " + std::to_string(attribution) +
                   "\n")
        .budget;
  }
  static double mixed(const Budget& b, ErrorIndex index) { return mixed_level(b, index); }
  static const ClassicalLine& line(const Budget& b, ErrorIndex index, std::size_t number) {
    return table_of(b, index, Interpretation::mixed).lines.at(number);
  }

  const std::shared_ptr<const Mechanism> mechanism_ =
      std::make_shared<const Mechanism>(read_mechanism_text(kMirror, "mirror.toml"));
};

TEST_F(BudgetOfErrors, AConstantOffsetIsInApeAndMpeAndNotInRpe) {
  const Budget b = budget({{"error.offset", "0.2 mrad"}});
  EXPECT_NEAR(mixed(b, ErrorIndex::ape), kOffset, 1e-6 * kOffset);
  EXPECT_NEAR(mixed(b, ErrorIndex::mpe), kOffset, 1e-6 * kOffset);
  EXPECT_LT(mixed(b, ErrorIndex::rpe), 1e-6 * kOffset);
  ASSERT_EQ(b.contributions.size(), 1u);
  EXPECT_EQ(b.contributions[0].kind, kDriveKind);
  EXPECT_NEAR(b.contributions[0].share, 1.0, 1e-9);
}

// sin(10 pi t): a window of 0.2 s is one period. Its mean is nothing, what is left is the sinusoid: 95 % of the time below
// sin(0.95 pi / 2) of its amplitude, its square half of that of the amplitude.
TEST_F(BudgetOfErrors, ARippleOfTheDriveIsInRpeAsASinusoidAndNotInMpe) {
  const Budget b = budget({{"error.ripple", "0.3 mrad"}});
  EXPECT_NEAR(mixed(b, ErrorIndex::rpe), kRipple * std::sin(0.95 * M_PI / 2.0), 2e-3 * kRipple);
  EXPECT_LT(mixed(b, ErrorIndex::mpe), 1e-3 * kRipple);
  const std::vector<Moments>& axes = line(b, ErrorIndex::rpe, 0).axes;
  EXPECT_NEAR(std::hypot(axes.at(0).sd, axes.at(1).sd), kRipple / std::sqrt(2.0), 2e-3 * kRipple);
}

// A loop that sees the error: at its corner a lag of first order leaves 1 / sqrt(2) of a sinusoid, and one that drives against what stands
// leaves nothing of it. Contributors from outside are what they were.
TEST_F(BudgetOfErrors, GoThroughALoopThatContributorsFromOutsideDoNotSee) {
  const Budget lagged =
      budget({{"error.ripple", "0.3 mrad"}}, "through = [{ first_order = { bandwidth = \"5 Hz\" } }]\n");
  EXPECT_NEAR(mixed(lagged, ErrorIndex::rpe), kRipple * std::sin(0.95 * M_PI / 2.0) / std::sqrt(2.0), 0.02 * kRipple);
  const std::string loop = "through = [{ sensitivity = { frequency = \"20 Hz\", damping = 0.7 } }]\n";
  const Budget standing = budget({{"error.offset", "0.2 mrad"}}, loop);
  EXPECT_LT(mixed(standing, ErrorIndex::ape), 1e-9 * kOffset);
  const Budget outside = budget({{"error.offset", "0.2 mrad"}},
                                loop +
                                    "[[budget.contributor]]\nname = \"star tracker\"\nclass = \"bias\"\n"
                                    "distribution = { discrete = { values = [\"0.1 mrad\"] } }\naxes = [\"x\"]\n");
  EXPECT_NEAR(mixed(outside, ErrorIndex::ape), 1e-4, 1e-9);
}

// Where the histories begin later than the motion, the loop has settled on the sinusoid by then: of it |S| is left and no mean,
// S = (s^2 + 2 z w s) / (s^2 + 2 z w s + w^2).
TEST_F(BudgetOfErrors, GoThroughALoopThatHasSettledWhereHistoriesBegin) {
  const Budget b =
      budget({{"error.ripple", "0.3 mrad"}},
             "start = \"0.2 s\"\nthrough = [{ sensitivity = { frequency = \"20 Hz\", damping = 0.7 } }]\n");
  const std::complex<double> s(0.0, 5.0), top = s * s + 2.0 * 0.7 * 20.0 * s, bottom = top + 400.0;
  const double left = std::abs(top / bottom) * kRipple;
  EXPECT_NEAR(mixed(b, ErrorIndex::rpe), left * std::sin(0.95 * M_PI / 2.0), 5e-3 * left);
  EXPECT_LT(mixed(b, ErrorIndex::mpe), 2e-3 * left);
}

TEST_F(BudgetOfErrors, SharesAreThoseOfTheMeanSquaresAndAddUpWhicheverMembersAreAttributed) {
  const Budget b = budget({{"error.offset", "0.2 mrad"}, {"error.ripple", "0.3 mrad"}, {"error.seat", "1 mm"}});
  ASSERT_EQ(b.contributions.size(), 3u);
  const double offset = kOffset * kOffset, ripple = 0.5 * kRipple * kRipple;
  // The product of offset and ripple is nothing over whole periods.
  EXPECT_NEAR(b.contributions[0].share, offset / (offset + ripple), 5e-3);
  EXPECT_NEAR(b.contributions[1].share, ripple / (offset + ripple), 5e-3);
  EXPECT_NEAR(b.contributions[2].share, 0.0, 1e-9);
  EXPECT_EQ(b.contributions[2].kind, kGeometryKind);
  EXPECT_NEAR(b.contributions[0].share + b.contributions[1].share, 1.0, 1e-6);
}

// Four turns of a milliradian about two axes, there and back: to first order they cancel but for 0.1 urad; turns about two axes do not commute,
// and 1 urad is left. A linear rung says by how much it may be off, and meets no requirement that hangs on it.
TEST_F(BudgetOfErrors, AreNotMetOnARungThatMayBeOffByMoreThanTheMargin) {
  std::string text = R"toml(
format = 1
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]
[motion]
duration = "0.1 s"
drives = { J1 = "0", J2 = "0", J3 = "0" }
)toml";
  for (const char* name : {"b1", "b2", "b3"})
    text += "[[body]]\nname = \"" + std::string(name) +
            "\"\nmass = \"1 kg\"\ncenter_of_mass = [\"0 m\", \"0 m\", \"0 m\"]\n"
            "inertia = [\"1 kg m^2\", \"1 kg m^2\", \"1 kg m^2\"]\n" +
            (std::string(name) == "b3" ? "boresight = [0.1, 1, 0.2]\n" : "");
  const auto joint = [&](const char* name, const char* connects) {
    text += "[[joint]]\nname = \"" + std::string(name) + "\"\ntype = \"revolute\"\nconnects = " + connects +
            "\npoint = [\"0 m\", \"0 m\", \"0 m\"]\naxis = [0, 0, 1]\ndriven = true\n";
  };
  joint("J1", "[\"ground\", \"b1\"]");
  joint("J2", "[\"b1\", \"b2\"]");
  joint("J3", "[\"b2\", \"b3\"]");
  const auto error = [&](const char* name, const char* at, const char* body, const char* axis, const char* value) {
    text += "[[error]]\nname = \"" + std::string(name) + "\"\njoint = \"" + at + "\"\nbody = \"" + body +
            "\"\nrotation = " + axis + "\nvalue = \"" + value + "\"\n";
  };
  error("a", "J1", "ground", "[1, 0, 0]", "1 mrad");
  error("b", "J2", "b1", "[0, 1, 0]", "1 mrad");
  error("c", "J3", "b2", "[1, 0, 0]", "-0.9999 mrad");
  error("d", "J3", "b3", "[0, 1, 0]", "1 mrad");
  const auto mechanism = std::make_shared<const Mechanism>(read_mechanism_text(text, "turns.toml"));
  const std::string study =
      "[[random]]\nparameter = \"error.d\"\ndistribution = { normal = { mean = \"1 mrad\", sd = \"0.05 urad\" } }\n"
      "[budget]\nmembers = 40\nattribution = 2\n[[budget.requirement]]\nindex = \"APE\"\nlimit = \"0.6 urad\"\n"
      "probability = 0.9\ninterpretation = \"ensemble\"\n"
      "[[budget.part]]\nname = \"all\"\nmechanism = true\nallocated = \"0.6 urad\"\n";
  const auto budget = [&](const char* rung) { return make_budget(mechanism, study, "boresight_error", rung).budget; };
  const Budget by_multibody = budget("multibody"), by_perturbation = budget("perturbation");
  const RequirementAnswer &exact = by_multibody.requirements.at(0), &linear = by_perturbation.requirements.at(0);
  EXPECT_FALSE(exact.met_by_members);
  EXPECT_GT(exact.level.level.value, 0.9e-6);
  EXPECT_TRUE(linear.met_by_members) << linear.level.level.value;
  EXPECT_GT(linear.model_error, 1.0);
  EXPECT_FALSE(linear.compliance.met);
  // The whole budget as a part of its own is judged likewise.
  const SubBudget& part = by_perturbation.parts.at(0);
  EXPECT_TRUE(part.kept_by_members);
  EXPECT_EQ(part.model_error, linear.model_error);
  EXPECT_EQ(part.within_error.share, linear.within_error.share);
  EXPECT_FALSE(part.compliance.met);
  EXPECT_FALSE(by_multibody.parts.at(0).kept_by_members);
}

// n_P sd is what one axis of a Gaussian error has. Of a level over the members 60 do not tell it, as it may be a third off by them; 2000 do. Of
// the worst of them over time, and of what turns about the other axis, there is no doubt.
TEST_F(BudgetOfErrors, OfAGaussianAreFairByTheRuleWhereThereAreMembersToTell) {
  for (const int members : {60, 2000}) {
    const Budget budget = budget_of_one_offset(members, 3);
    for (const BudgetLevel& l : budget.levels) {
      if (l.axis == 2) continue;  // by the rule for equal axes
      const bool told = members == 2000 || l.axis == 0 || l.interpretation == Interpretation::temporal;
      EXPECT_EQ(l.standing, told ? RuleStanding::fair : RuleStanding::in_doubt)
          << members << " " << l.axis << " " << to_string(l.interpretation);
    }
  }
}

// The classical line of an error is that of all members, whichever of them are run without it.
TEST_F(BudgetOfErrors, HasTheSameRuleHoweverFewMembersAreAttributed) {
  const Budget few = budget_of_one_offset(60, 3), all = budget_of_one_offset(60, 60);
  ASSERT_EQ(few.levels.size(), all.levels.size());
  for (std::size_t i = 0; i < few.levels.size(); ++i) {
    EXPECT_NEAR(few.levels[i].by_rule, all.levels[i].by_rule, 1e-3 * all.levels[i].by_rule) << i;
    EXPECT_EQ(few.levels[i].rule_interval.low, few.levels[i].by_rule) << i;
    EXPECT_EQ(few.levels[i].standing, all.levels[i].standing) << i;
  }
  ASSERT_EQ(few.reductions.size(), 1u);
  EXPECT_EQ(few.reductions[0].members, 60u);
  EXPECT_NEAR(few.reductions[0].gain(), all.reductions[0].gain(), 1e-3 * all.reductions[0].gain());
}

// An error about an axis between x and y has both at once: the half cone is that of one axis.
TEST_F(BudgetOfErrors, AboutAnAxisBetweenTheirsHaveTheHalfConeOfOneAxis) {
  const auto tilted = std::make_shared<const Mechanism>(read_mechanism_text(
      std::string(kMirror) + "[[error]]\nname = \"tilt\"\njoint = \"Y\"\nbody = \"mirror\"\nrotation = [1, 1, 0]\n",
      "tilted.toml"));
  const std::string spread = "distribution = { normal = { mean = \"0 arcsec\", sd = \"10 arcsec\" } }\n",
                    budget = "[budget]\nmembers = 60\nattribution = 3\nsampling = \"20 ms\"\nstart = \"0 s\"\n";
  const double one = 1.959964 * 10.0 * M_PI / 180.0 / 3600.0;
  const auto integrated = [](const Budget& b) {
    return *std::find_if(b.levels.begin(), b.levels.end(), [](const BudgetLevel& l) {
              return l.index == ErrorIndex::ape && l.interpretation == Interpretation::mixed && l.axis == 2;
            })->integrated;
  };
  const Budget drawn = make_budget(tilted, "[[random]]\nparameter = \"error.tilt\"\n" + spread + budget).budget;
  const std::vector<Moments>& axes = line(drawn, ErrorIndex::ape, 0).axes;
  const double sd = std::hypot(axes[0].sd, axes[1].sd);
  EXPECT_NEAR(integrated(drawn), 1.96 * sd, 0.05 * sd);
  const Budget beside =
      make_budget(tilted, budget + "[[budget.contributor]]\nname = \"b\"\nerror = \"tilt\"\n" + spread).budget;
  EXPECT_NEAR(integrated(beside), one, 0.01 * one);
}

}  // namespace budget_of_errors_test
}  // namespace boresight
