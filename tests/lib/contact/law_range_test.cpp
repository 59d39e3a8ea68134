#include "boresight/contact/law_range.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boresight {
namespace law_range_test {

ClearanceParameters joint(double radial) {
  ClearanceParameters p;
  p.radial = radial;
  p.journal_radius = 10e-3;
  p.sleeve_length = 30e-3;
  return p;
}

TEST(LawRange, OfHertzEndsWhereThePatchSpansFifteenDegrees) {
  const ClearanceParameters p = joint(0.1e-3);
  const NormalLaw law = make_normal_law("flores", "", p);
  // a = R_a sin 15 degrees, d = a^2 / R.
  const double a = 10e-3 * std::sin(M_PI / 12.0), d = a * a / (10e-3 * 10.1e-3 / 0.1e-3), limit = law.elastic_force(d);
  EXPECT_FALSE(out_of_range("flores", p, 0.99 * limit));
  EXPECT_TRUE(out_of_range("flores", p, 1.01 * limit));
}

TEST(LawRange, OfPereiraIsWhatTheFitCovers) {
  EXPECT_FALSE(out_of_range("pereira", joint(0.1e-3), 100.0));
  EXPECT_TRUE(out_of_range("pereira", joint(4e-6), 100.0));
}

TEST(LawRange, JohnsonAndLiuMeetAndNeitherHoldsWhereTheOtherIsNamed) {
  for (const double load : {1.0, 100.0, 1e4, 1e6, 1e8}) {
    const std::string fits = fitting_law(joint(0.1e-3), load);
    ASSERT_FALSE(fits.empty()) << load;
    EXPECT_FALSE(out_of_range(fits, joint(0.1e-3), load)) << load;
  }
  EXPECT_EQ(fitting_law(joint(0.1e-3), 100.0), "johnson");
  EXPECT_EQ(fitting_law(joint(0.1e-3), 1e7), "liu");
}

TEST(LawRange, WarningNamesJointLawReasonAndOneThatFits) {
  const auto warning = range_warning("F1", "flores", joint(0.1e-3), 2e3);
  ASSERT_TRUE(warning);
  for (const char* part : {"F1", "flores", "15", "2000 N", "fits"})
    EXPECT_NE(warning->find(part), std::string::npos) << *warning;
  EXPECT_FALSE(range_warning("F1", "flores", joint(0.1e-3), 10.0));
}

TEST(LawRange, TellsAnAngleFromTheLimitThatItPasses) {
  const ClearanceParameters p = joint(0.1e-3);
  double within = 0.0, beyond = 1e6;
  while (beyond - within > 1e-6 * beyond) {
    const double load = 0.5 * (within + beyond);
    (out_of_range("flores", p, load) ? beyond : within) = load;
  }
  const std::string reason = out_of_range("flores", p, 1.001 * beyond).value();
  EXPECT_NE(reason.find("spans 15.0"), std::string::npos) << reason;
}

TEST(LawRange, NeverSpeaksOfAContactWithoutLoad) {
  for (const NormalLawEntry& entry : normal_laws())
    EXPECT_FALSE(out_of_range(entry.name, joint(1e-5), 0.0)) << entry.name;
}

}  // namespace law_range_test
}  // namespace boresight
