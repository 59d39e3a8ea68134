// The slider-crank of Flores et al. (2006) with clearance between rod and slider, event by event.
//
// The figures were computed for this project with two formulations of their own (two coordinates in long
// double, extrapolated; Cartesian coordinates with multipliers), which agree on the first four impacts to ten
// digits.
#include <gtest/gtest.h>

#include "boresight/rungs/ideal_simulation.hpp"
#include "boresight/rungs/rung.hpp"
#include "scenes.hpp"
#include "slider_crank_in_two_coordinates.hpp"

namespace boresight {
namespace {

using scenes::SliderCrankInTwoCoordinates;

enum Body { kCrankBody, kRodBody, kSliderBody };

MechanismDescription example(const std::vector<Setting>& settings = {}) {
  return read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/flores-slider-crank/flores-slider-crank.toml",
                        settings);
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
const Event kReference[] = {
    {2.272860320398e-4, 177.912104, 4.385783145, -2.121412, 5.343723e-5, 7.795222e-5, 45872.275, 3.911492579},
    {6.370564301669e-4, 116.926635, 2.756949153, -0.661306, 5.383416e-5, 4.612189e-5, 20869.93, 1.764880328},
    {7.497002798424e-4, 164.220525, 1.826699075, 2.195169, 6.545016e-5, 5.301500e-5, 25926.15, 2.133988216},
    {1.085947033914e-3, -142.996742, 1.101851178, -2.782712, 6.075807e-5, 2.131170e-5, 6557.871, 0.723053286},
    {1.205816127989e-3, -175.878822, 0.823800543, -4.698532, 2.850705e-4, 3.334060e-5, 12915.66, 0.312378321},
    {1.551486001305e-3, 70.048948, 0.270939413, -2.480307, 7.627137e-5, 8.533425e-6, 1672.212, 0.240737222},
    {1.715081786220e-3, 66.862387, 0.257277053, -0.805160, 5.776258e-4, 1.764696e-5, 4943.069, 0.141966360},
    {2.872495289603e-3, 38.807721, 3.780248875, -0.328257, 3.959673e-5, 4.877339e-5, 22693.03, 3.355042386},
    {3.169842912506e-3, -65.917076, 2.376260438, -0.798745, 5.936076e-5, 4.465573e-5, 19877.71, 1.873142254},
    {3.354093968756e-3, -3.908845, 2.261432508, 4.179028, 5.235291e-5, 4.445009e-5, 19801.55, 2.380327187},
    {3.871314910775e-3, 33.495238, 2.174331811, 0.537249, 4.690416e-5, 3.324948e-5, 12775.88, 1.823611855},
    {4.080193387848e-3, -21.358370, 1.821980396, -0.987327, 7.343032e-5, 4.552920e-5, 20494.37, 1.470795960}};

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
  const Event& r = kReference[k];
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
  for (int k = 0; k < 12; ++k)
    expect_impact(result, k, {1e-5, 1e-3, 0.05, 1e-3 * std::max(1.0, std::abs(kReference[k].sliding))});
}

// The same with Flores' law.
TEST(FloresSliderCrank, WithFloresLawStrikesAsHardAsComputedIndependently) {
  const RunResult result =
      follow(example({{"motion.duration", "0.8 ms"}, {"clearance.B.contact.law", "flores"}}));
  ASSERT_GE(result.events.size(), 3u);
  EXPECT_NEAR(result.events[0].max_penetration / 7.725263e-5, 1.0, 1e-5);
  EXPECT_NEAR(result.events[0].max_force / 45448.0, 1.0, 1e-5);
  EXPECT_NEAR(result.events[0].end_speed / 3.811473885, 1.0, 1e-5);
  EXPECT_NEAR(result.events[1].start / 6.311689571533e-4, 1.0, 1e-6);
  EXPECT_NEAR(result.events[1].start_speed / 2.783535190, 1.0, 1e-5);
  EXPECT_NEAR(result.events[2].start / 7.450885895003e-4, 1.0, 1e-6);
  EXPECT_NEAR(result.events[2].start_speed / 1.774022126, 1.0, 1e-5);
}

TEST(FloresSliderCrank, WithoutDampingStrikesAsComputedIndependently) {
  const RunResult elastic =
      follow(example({{"motion.duration", "0.7 ms"}, {"clearance.B.contact.law", "hertz"}}));
  ASSERT_GE(elastic.events.size(), 2u);
  EXPECT_NEAR(elastic.events[0].max_penetration / 8.106744e-5, 1.0, 1e-5);
  EXPECT_NEAR(elastic.events[0].max_force / 48248.54, 1.0, 1e-5);
  EXPECT_NEAR(elastic.events[0].end_speed / 4.365416561, 1.0, 1e-5);
  EXPECT_NEAR(elastic.events[1].start / 6.577531906150e-4, 1.0, 1e-6);
}

const double kLankaraniNikravesh = 0.75 * (1.0 - 0.9 * 0.9);

// The reference takes friction at the journal's own radius; what the two-coordinate formulation says about it
// below therefore rests on its numbers to every digit that the kinks of the friction's ramp leave.
TEST(FloresSliderCrank, WithFrictionIsTheReferenceWhereFrictionActsAtTheJournalsRadius) {
  SliderCrankInTwoCoordinates hand(kLankaraniNikravesh, true,
                                   [](double) { return SliderCrankInTwoCoordinates::kJournal; });
  const auto events = hand.events(0.9e-3, 2e-8);
  ASSERT_GE(events.size(), 3u);
  EXPECT_NEAR(events[0].force / 45922.94, 1.0, 1e-6);
  EXPECT_NEAR(events[0].end_speed / 3.927376514, 1.0, 1e-8);
  EXPECT_NEAR(events[1].start / 6.774504518e-4, 1.0, 1e-8);
  EXPECT_NEAR(events[1].speed / 3.372619948, 1.0, 1e-8);
  EXPECT_NEAR(events[2].start / 8.1405228703e-4, 1.0, 1e-7);
  EXPECT_NEAR(events[2].speed / 2.167520217, 1.0, 1e-6);
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
  SliderCrankInTwoCoordinates hand(
      kLankaraniNikravesh, true, [](double depth) { return SliderCrankInTwoCoordinates::kJournal - depth; });
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

// The ideal mechanism in closed form, at 5000 rpm: slider, force between rod and slider, moment that turns
// the crank.
TEST(FloresSliderCrank, HasTheClosedFormOfItsIdealMotion) {
  const Mechanism mechanism(example());
  const IdealMotion ideal = ideal_motion(mechanism, mechanism.parameters());
  const auto at = [](double degrees) { return degrees / 360.0 * 60.0 / 5000.0; };
  const double a[] = {-19419.3605, -14989.8650, -4020.9974, 6282.9524, 9686.7865, 8752.7132, 7996.2073};
  IdealState state;
  for (int k = 0; k < 7; ++k) {
    ideal.state(at(30.0 * k), state);
    EXPECT_NEAR(state.acceleration[kSliderBody][0] / a[k], 1.0, 1e-6) << 30 * k << " degrees";
  }
  ideal.state(at(60.0), state);
  EXPECT_NEAR(state.bodies[kSliderBody].v.x(), -27.737153, 1e-6);

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
  EXPECT_NEAR(fastest, 28.411330, 1e-6);
  EXPECT_NEAR(fastest_at, 70.171, 0.01);
  EXPECT_NEAR(highest, 9695.856, 1e-3);
  EXPECT_NEAR(highest_at, 238.0, 0.1);
  EXPECT_NEAR(lowest, -19419.361, 1e-3);
  EXPECT_NEAR(pin_force, 2718.71, 0.005);
  EXPECT_NEAR(largest_moment, 138.5217, 1e-4);
  EXPECT_NEAR(smallest_moment, -138.5217, 1e-4);
}

}  // namespace
}  // namespace boresight
