// A step that is far beyond its accuracy is refused in words; a contact that is open keeps no speed of the one before.
#include <gtest/gtest.h>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/contact_tracker.hpp"
#include "boresight/rungs/rung.hpp"
#include "scenes.hpp"

namespace boresight {
namespace {

std::string refusal(const char* rung, const std::string& integrator, double step) {
  const auto mechanism = scenes::build(scenes::rrcpr({{"motion.duration", "0.1 s"}}));
  RunOptions options;
  options.integrator = integrator;
  options.step = step;
  try {
    make_rung(rung, mechanism)->run(mechanism->parameters(), options);
  } catch (const ComputationError& failure) {
    return failure.what();
  }
  return "none";
}

TEST(FixedSteps, AreRefusedWhereOneOfThemErrsByAShareOfTheClearance) {
  for (const char* integrator : {"dopri5", "rosenbrock"})
    for (const char* rung : {"perturbation", "multibody"}) {
      const std::string text = refusal(rung, integrator, 1e-3);
      EXPECT_NE(text.find("times the smallest clearance"), std::string::npos) << rung << ' ' << integrator << ": " << text;
      EXPECT_NE(text.find("take a smaller step, or none"), std::string::npos) << text;
    }
  EXPECT_EQ(refusal("perturbation", "rosenbrock", 2e-5), "none");
  EXPECT_EQ(refusal("perturbation", "dopri5", 2e-5), "none");
}

TEST(OpenContact, TakesTheSpeedAtWhichItWouldBeginNowUnderLocatedEvents) {
  JournalInSleeve law;
  law.tilts = true;
  law.minimum_impact_speed = 1e-3;
  ContactTracker tracker(0, "F1", law, false);
  constexpr int minus = static_cast<int>(ContactPlace::radial_minus), plus = static_cast<int>(ContactPlace::radial_plus);
  // The minus end hits at 0.5 m/s, rests, and leaves; the plus end lies on throughout.
  tracker.begin(ContactPlace::radial_plus, 0.0, 0.02);
  tracker.begin(ContactPlace::radial_minus, 0.0, 0.5);
  EXPECT_EQ(tracker.memory().impact_speed[minus], 0.5);
  tracker.end(ContactPlace::radial_minus, 0.01, 0.3);
  std::array<ContactState<double>, kContactPlaces> contact{};
  contact[minus].penetration = -1e-5;
  contact[minus].rate = 0.004;
  contact[plus].penetration = 1e-6;
  contact[plus].rate = 0.0;
  tracker.observe(0.011, contact);
  EXPECT_EQ(tracker.memory().impact_speed[minus], 0.004);
  EXPECT_EQ(tracker.memory().impact_speed[plus], 0.02) << "a contact that is closed keeps its own";
  contact[minus].rate = -0.1;
  tracker.observe(0.012, contact);
  EXPECT_EQ(tracker.memory().impact_speed[minus], 1e-3) << "never below the least";
}

}  // namespace
}  // namespace boresight
