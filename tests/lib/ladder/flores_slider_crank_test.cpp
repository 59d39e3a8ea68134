// The slider-crank of Flores et al. (2006) with clearance between rod and slider, event by event.
//
// The figures are those of tests/reference/flores_slider_crank.py: two coordinates, each impact followed from its first to its last 1e-13 m.
#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "reference/reference.hpp"
#include "scenes.hpp"
#include "slider_crank_in_two_coordinates.hpp"

namespace boresight {
namespace flores_slider_crank_test {

using scenes::SliderCrankInTwoCoordinates;

enum Body { kCrankBody, kRodBody, kSliderBody };

MechanismDescription example(const std::vector<Setting>& settings = {}) {
  return read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/flores-slider-crank/flores-slider-crank.toml", settings);
}

RunResult follow(MechanismDescription description, double sample = 1e-4, double step = 1e-7) {
  const auto mechanism = scenes::build(std::move(description));
  RunOptions options;
  options.step = step;
  options.sample_spacing = sample;
  options.pose_bodies = {kCrankBody, kRodBody, kSliderBody};
  return make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
}

struct Event {
  double start, normal, speed, sliding, duration, depth, force,
      end_speed;  // normal in degrees, sliding of the surfaces
};

std::vector<Event> impacts(const std::string& law) {
  std::vector<Event> events;
  for (const reference::Row& r : reference::table("flores_slider_crank", law))
    events.push_back({r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7]});
  return events;
}

// Where on the bore the journal touches at t [degrees], and how fast their surfaces slide there: from the
// poses on either side of t, which the contact has not moved yet by more than (step)^2.
struct Touch {
  double normal, sliding;
};
Touch touch(const RunResult& result, double t) {
  const auto history = [&](int body) -> const std::vector<PoseSample>& {
    for (const BodyHistory& h : result.others)
      if (h.body == body) return h.samples;
    return result.boresight.samples;
  };
  const double spacing = result.time[1] - result.time[0];
  const std::size_t k = static_cast<std::size_t>(t / spacing);
  const double part = t / spacing - static_cast<double>(k);
  const auto offset = [&](std::size_t at, Vec3& rate) {
    const PoseSample &rod = history(kRodBody)[at], &slider = history(kSliderBody)[at];
    const Vec3 arm = rod.pose.q * Vec3(0.06, 0.0, 0.0);  // from the rod's centre to the journal's
    rate = rod.v + rod.w.cross(arm) - slider.v;
    return Vec3(rod.pose.p + arm - slider.pose.p);
  };
  Vec3 rate, later_rate;
  const Vec3 from = offset(k, rate), to = offset(k + 1, later_rate);
  const Vec3 n = (from + part * (to - from)).normalized(), v = rate + part * (later_rate - rate);
  return {std::atan2(n.y(), n.x()) * 180.0 / std::numbers::pi,
          v.y() * n.x() - v.x() * n.y() + SliderCrankInTwoCoordinates::kJournal * history(kRodBody)[k].w.z()};
}

// time, numbers: relative; normal: [degrees]; sliding: [m/s].
struct Bounds {
  double time, numbers, normal, sliding;
};
void expect_impact(const RunResult& result, int k, const Bounds& within) {
  const ContactEvent& e = result.events[k];
  static const std::vector<Event> reference = impacts("lankarani-nikravesh");
  const Event& r = reference.at(static_cast<std::size_t>(k));
  EXPECT_NEAR(e.start / r.start, 1.0, within.time) << "impact " << k + 1;
  EXPECT_NEAR(e.start_speed / r.speed, 1.0, within.numbers) << "impact " << k + 1;
  EXPECT_NEAR(e.max_force / r.force, 1.0, within.numbers) << "impact " << k + 1;
  EXPECT_NEAR(e.max_penetration / r.depth, 1.0, within.numbers) << "impact " << k + 1;
  EXPECT_NEAR(e.end_speed / r.end_speed, 1.0, within.numbers) << "impact " << k + 1;
  EXPECT_NEAR(e.duration / r.duration, 1.0, within.numbers) << "impact " << k + 1;
  const Touch at = touch(result, e.start);
  EXPECT_NEAR(at.normal, r.normal, within.normal) << "impact " << k + 1;
  EXPECT_NEAR(at.sliding, r.sliding, within.sliding) << "impact " << k + 1;
}

TEST(FloresSliderCrank, StrikesWhereAndAsHardAsTwoIndependentFormulationsSay) {
  const RunResult result = follow(example({{"motion.duration", "1.2 ms"}}), 1e-7);
  ASSERT_GE(result.events.size(), 4u);
  for (int k = 0; k < 4; ++k) expect_impact(result, k, {1e-6, 1e-4, 1e-3, 1e-4});
  // Where the first impact is hardest, the slider accelerates with its share of force over mass along the
  // guide.
  std::size_t hardest = 0;
  for (std::size_t k = 0; k < result.time.size(); ++k)
    if (result.clearances[0][k].normal_force > result.clearances[0][hardest].normal_force) hardest = k;
  const double along = std::cos(touch(result, result.time[hardest]).normal * std::numbers::pi / 180.0);
  EXPECT_NEAR(result.boresight.samples[hardest].a.x() / along / 327659.0, 1.0, 1e-4);
}

// All twelve: from the fifth on, errors grow by what each impact multiplies them with.
TEST(FloresSliderCrank, FollowsTheTwelveImpactsOfTheReference) {
  const RunResult result = follow(example({{"motion.duration", "4.2 ms"}}), 1e-7);
  ASSERT_EQ(result.events.size(), 12u);
  const std::vector<Event> reference = impacts("lankarani-nikravesh");
  ASSERT_EQ(reference.size(), 12u);
  for (int k = 0; k < 12; ++k)
    expect_impact(result, k,
                  {1e-5, 1e-3, 0.05, 1e-3 * std::max(1.0, std::abs(reference[static_cast<std::size_t>(k)].sliding))});
}

// The same with Flores' law.
TEST(FloresSliderCrank, WithFloresLawStrikesAsHardAsComputedIndependently) {
  const RunResult result = follow(example({{"motion.duration", "0.8 ms"}, {"clearance.B.contact.law", "flores"}}));
  ASSERT_GE(result.events.size(), 3u);
  const std::vector<Event> expected = impacts("flores");
  EXPECT_NEAR(result.events[0].max_penetration / expected[0].depth, 1.0, 1e-5);
  EXPECT_NEAR(result.events[0].max_force / expected[0].force, 1.0, 1e-5);
  EXPECT_NEAR(result.events[0].end_speed / expected[0].end_speed, 1.0, 1e-5);
  for (std::size_t k = 1; k < 3; ++k) {
    EXPECT_NEAR(result.events[k].start / expected[k].start, 1.0, 1e-6);
    EXPECT_NEAR(result.events[k].start_speed / expected[k].speed, 1.0, 1e-5);
  }
}

TEST(FloresSliderCrank, WithoutDampingStrikesAsComputedIndependently) {
  const RunResult elastic = follow(example({{"motion.duration", "0.7 ms"}, {"clearance.B.contact.law", "hertz"}}));
  ASSERT_GE(elastic.events.size(), 2u);
  const std::vector<Event> expected = impacts("hertz");
  EXPECT_NEAR(elastic.events[0].max_penetration / expected[0].depth, 1.0, 1e-5);
  EXPECT_NEAR(elastic.events[0].max_force / expected[0].force, 1.0, 1e-5);
  EXPECT_NEAR(elastic.events[0].end_speed / expected[0].end_speed, 1.0, 1e-5);
  EXPECT_NEAR(elastic.events[1].start / expected[1].start, 1.0, 1e-6);
}

const double kLankaraniNikravesh = 0.75 * (1.0 - 0.9 * 0.9);

// What the two-coordinate formulation says about friction below rests on its impacts without: those of the reference, to every digit that it
// prints.
TEST(FloresSliderCrank, InTwoCoordinatesHasTheImpactsOfTheReference) {
  SliderCrankInTwoCoordinates hand(kLankaraniNikravesh, false,
                                   [](double) { return SliderCrankInTwoCoordinates::kJournal; });
  const auto events = hand.events(1.2e-3, 2e-8);
  const std::vector<Event> expected = impacts("lankarani-nikravesh");
  ASSERT_GE(events.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(events[k].start / expected[k].start, 1.0, 1e-8) << "impact " << k + 1;
    EXPECT_NEAR(events[k].speed / expected[k].speed, 1.0, 1e-7) << "impact " << k + 1;
    EXPECT_NEAR(events[k].force / expected[k].force, 1.0, 1e-6) << "impact " << k + 1;
    EXPECT_NEAR(events[k].end_speed / expected[k].end_speed, 1.0, 1e-7) << "impact " << k + 1;
  }
}

// Here friction acts on both bodies at one point, on the bore, so that no angular momentum leaks: its lever
// about the journal's centre is R_j less the penetration (0.8 % at most). With that lever and nothing else
// changed, the formulation of the test above moves the second impact by 2.8e-5 and the third by 2.0e-4 of its
// time, its speed by 6e-4.
TEST(FloresSliderCrank, WithFrictionIsTheReferenceWithFrictionMovedToTheBore) {
  MechanismDescription rubbing = example({{"motion.duration", "0.9 ms"}});
  rubbing.clearances[0].friction_law = "modified-coulomb";
  FrictionParameters& friction = rubbing.clearances[0].parameters.friction;
  friction.coefficient = 0.03;
  friction.static_speed = 1e-3;
  friction.dynamic_speed = 1e-2;
  const RunResult rough = follow(std::move(rubbing), 1e-4, 5e-8);  // the ramp's kinks cost the step its order
  SliderCrankInTwoCoordinates hand(kLankaraniNikravesh, true,
                                   [](double depth) { return SliderCrankInTwoCoordinates::kJournal - depth; });
  const auto events = hand.events(0.9e-3, 2e-8);
  ASSERT_GE(events.size(), 3u);
  ASSERT_GE(rough.events.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(rough.events[k].start / events[k].start, 1.0, 1e-6) << "impact " << k + 1;
    EXPECT_NEAR(rough.events[k].start_speed / events[k].speed, 1.0, 1e-5) << "impact " << k + 1;
    EXPECT_NEAR(rough.events[k].max_force / events[k].force, 1.0, 1e-5) << "impact " << k + 1;
    EXPECT_NEAR(rough.events[k].max_penetration / events[k].depth, 1.0, 1e-5) << "impact " << k + 1;
    EXPECT_NEAR(rough.events[k].end_speed / events[k].end_speed, 1.0, 1e-5) << "impact " << k + 1;
  }
}

// The ideal mechanism against its closed form, at 5000 rpm: slider, force between rod and slider, moment that turns
// the crank.
TEST(FloresSliderCrank, HasTheClosedFormOfItsIdealMotion) {
  const Mechanism mechanism(example());
  const IdealMotion ideal = ideal_motion(mechanism, mechanism.parameters());
  const auto at = [](double degrees) { return degrees / 360.0 * 60.0 / 5000.0; };
  IdealState state;
  for (const reference::Row& r : reference::table("flores_slider_crank", "ideal slider")) {
    ideal.state(at(r[0]), state);
    EXPECT_NEAR(state.bodies[kSliderBody].v.x(), r[1], 2e-6) << r[0] << " degrees";
    EXPECT_NEAR(state.acceleration[kSliderBody][0] / r[2], 1.0, 1e-6) << r[0] << " degrees";
  }

  const MechanismDescription& m = mechanism.description();
  double fastest = 0.0, fastest_at = 0.0, highest = 0.0, highest_at = 0.0, lowest = 0.0, pin_force = 0.0;
  double largest_moment = 0.0, smallest_moment = 0.0;
  for (int k = 0; k <= 36000; ++k) {
    ideal.state(at(0.01 * k), state);
    const BodyMotion &rod = state.bodies[kRodBody], &slider = state.bodies[kSliderBody];
    const BodyAcceleration &rod_a = state.acceleration[kRodBody], &slider_a = state.acceleration[kSliderBody];
    if (k < 18000 && -slider.v.x() > fastest) fastest = -slider.v.x(), fastest_at = 0.01 * k;
    if (k > 18000 && slider_a[0] > highest) highest = slider_a[0], highest_at = 0.01 * k;
    lowest = std::min(lowest, slider_a[0]);
    // The crank turns evenly about its own axis: what its drive gives goes into rod and slider.
    const double power = m.bodies[kRodBody].mass * rod.v.dot(rod_a.head<3>()) +
                         m.bodies[kRodBody].inertia(2, 2) * rod.w.z() * rod_a[5] +
                         m.bodies[kSliderBody].mass * slider.v.dot(slider_a.head<3>());
    const double moment = power / SliderCrankInTwoCoordinates::kSpeed;
    largest_moment = std::max(largest_moment, moment), smallest_moment = std::min(smallest_moment, moment);
    // Along the guide the pin pushes the slider; across it, it turns the rod about its crank pin, which
    // accelerates.
    const double fx = m.bodies[kSliderBody].mass * slider_a[0];
    const Vec3 to_pin = slider.p - rod.p, to_crank = -to_pin;  // the rod's centre is its middle
    const Vec3 moment_about_crank = Vec3(0.0, 0.0, m.bodies[kRodBody].inertia(2, 2) * rod_a[5]) +
                                    (-to_crank).cross(m.bodies[kRodBody].mass * Vec3(rod_a.head<3>()));
    const Vec3 lever = to_pin - to_crank;  // lever x (-fx, fy): the pin's force on the rod
    const double fy = (moment_about_crank.z() - lever.y() * fx) / lever.x();
    pin_force = std::max(pin_force, std::hypot(fx, fy));
  }
  const auto extreme = [](const char* name) { return reference::named("flores_slider_crank", "ideal extremes", name); };
  EXPECT_NEAR(fastest, extreme("fastest")[0], 2e-6);
  EXPECT_NEAR(fastest_at, extreme("fastest")[1], 0.015);
  EXPECT_NEAR(highest, extreme("highest")[0], 1e-3);
  EXPECT_NEAR(highest_at, extreme("highest")[1], 0.1);
  EXPECT_NEAR(lowest, -extreme("lowest")[0], 1e-3);
  EXPECT_NEAR(pin_force, extreme("pin")[0], 0.005);
  EXPECT_NEAR(largest_moment, extreme("largest_moment")[0], 1e-4);
  EXPECT_NEAR(smallest_moment, -extreme("smallest_moment")[0], 1e-4);
}

}  // namespace flores_slider_crank_test
}  // namespace boresight
