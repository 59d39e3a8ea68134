// Where contacts begin and end between steps that do not stop for them.
#include "boresight/contact_events/contact_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace boresight {
namespace contact_tracker_test {

// A gap whose rate is a parabola in time: what carries the free flight on is exact for it, once it has three
// values.
TEST(ContactTracker, PlacesTheStartOfAFlightWithAParabolaForItsRateExactly) {
  constexpr double kFrom = 0.4, kSpeed = 0.3, kAcceleration = 9.0, kJerk = 2000.0;
  // Penetration and its rate, zero and kSpeed at t = kFrom.
  const auto penetration = [](double t) {
    const double s = t - kFrom;
    return kSpeed * s + kAcceleration * s * s / 2.0 + kJerk * s * s * s / 6.0;
  };
  const auto rate = [](double t) {
    const double s = t - kFrom;
    return kSpeed + kAcceleration * s + kJerk * s * s / 2.0;
  };
  ContactTracker tracker(0, "joint", JointPlay{}, true);
  const auto accept = [&](double t) {
    std::array<ContactState<double>, kContactPlaces> contact{};
    for (ContactState<double>& c : contact) c.penetration = -1.0;
    contact[0].penetration = penetration(t);
    contact[0].rate = rate(t);
    return tracker.accept(t, contact);
  };
  // Unequal steps; the last one is the first beyond the start, whose own rate a force has bent: it is not
  // used.
  for (const double t : {0.380, 0.387, 0.392, 0.398}) EXPECT_FALSE(accept(t)) << t;
  EXPECT_TRUE(accept(0.404));
  std::vector<ContactEvent> events;
  const ContactSummary summary = tracker.finish(0.405, events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(events[0].start, kFrom, 1e-12);
  EXPECT_NEAR(events[0].start_speed, kSpeed, 1e-10);
  EXPECT_EQ(summary.impacts, 1);
  EXPECT_NEAR(summary.max_impact_speed, kSpeed, 1e-10);
}

}  // namespace contact_tracker_test
}  // namespace boresight
