// What the commands on the starter template and on the other examples do.
#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "command_claims.hpp"
#include "command_table.hpp"

namespace boresight::app {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

}  // namespace

std::vector<TableCommand> commands_on_other_examples() {
  return {
      {.text = "boresight new antenna",
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.ended.out, AllOf(HasSubstr("boresight check antenna/mechanism.toml"),
                                               HasSubstr("boresight montecarlo antenna/montecarlo.toml")));
           }},
      {.text = "boresight check antenna/mechanism.toml", .claims = freedoms(1, 0), .before = {"boresight new antenna"}},
      {.text = "boresight run antenna/mechanism.toml",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             expect_error_follows_play(left, "clearance.elevation.radial=0.015mm", "boresight_error");
           },
       .before = {"boresight new antenna"}},
      {.text = "boresight run antenna/mechanism.toml --set clearance.elevation.radial=0.06mm --compare",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.ended.out,
                         AllOf(HasSubstr("envelope "), HasSubstr("quasistatic "), HasSubstr("perturbation ")));
           },
       .before = {"boresight new antenna"}},
      {.text = "boresight montecarlo antenna/montecarlo.toml",
       .claims = [](const Left& left) { EXPECT_TRUE(left.summary["requirement"]["met"].get<bool>()); },
       .before = {"boresight new antenna"}},
      {.text = "boresight check examples/2-us-pointing/2-us-pointing.toml", .claims = freedoms(2, 0)},
      // "The boresight error is the play over the distance to the rods' joints, and the second run shows it shrink with the play."
      {.text = "boresight run examples/2-us-pointing/2-us-pointing.toml",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             EXPECT_LT(largest(left.again({"--set", "clearance.Y.radial=20um"}), "boresight_error"),
                       0.5 * largest(left.summary, "boresight_error"));
           }},
      {.text = "boresight run examples/2-us-pointing/2-us-pointing.toml --set clearance.Y.radial=20um",
       .shorter = kOnce},
      // "counts three freedoms and six redundant rows"
      {.text = "boresight check examples/3-rrr/3-rrr.toml", .claims = freedoms(3, 6)},
      {.text = "boresight run examples/3-rrr/3-rrr.toml --compare",
       .shorter = kOnce,
       .claims =
           [](const Left& left) { expect_error_follows_play(left, "clearance.C1.radial=50um", "position_error"); }},
      {.text = "boresight check examples/andrews-squeezer/andrews-squeezer.toml", .claims = freedoms(1, 9)},
      {.text =
           "boresight run examples/andrews-squeezer/andrews-squeezer.toml --rung multibody --step \"10 us\" --pose K5",
       .shorter = kOnce},
      {.text = "boresight check examples/bricard/bricard.toml", .claims = freedoms(1, 1)},
      {.text = "boresight run examples/bricard/bricard.toml --rung multibody",
       .shorter = {"--step-error", "off", "--set", "motion.duration=2s"}},
      {.text = "boresight check examples/crank-slider/crank-slider.toml", .claims = freedoms(1, 0)},
      // The slider's guide keeps its direction: the play moves it and turns nothing.
      {.text = "boresight run examples/crank-slider/crank-slider.toml",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             EXPECT_LT(largest(left.summary, "boresight_error"), 1e-10);
             expect_error_follows_play(left, "clearance.*.radial=25um", "position_error");
           }},
      {.text = "boresight run examples/crank-slider/crank-slider.toml --set 'clearance.*.radial=0.2mm'",
       .shorter = kOnce},
      {.text = "boresight check examples/double-four-bar/double-four-bar.toml", .claims = freedoms(1, 6)},
      // "the first rod's centre is at half of the published end point ... after 10 s, to 1e-6 m"
      {.text = "boresight run examples/double-four-bar/double-four-bar.toml --rung multibody",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             expect_numbers(numbers(left.file("timeseries.csv"), 10000, "x", 2), {0.164229056, 0.472259269}, 1e-6);
           }},
      {.text = "boresight check examples/flores-slider-crank/flores-slider-crank.toml", .claims = freedoms(1, 3)},
      // "first after 0.22728603 ms with 4.3858 m/s and 45,872 N"; "twelve impacts in the first 4.1 ms"
      {.text = "boresight run examples/flores-slider-crank/flores-slider-crank.toml --rung multibody --step \"100 ns\" "
               "--set motion.duration=4.2ms --sample \"10 us\"",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             std::istringstream events(left.file("events.csv"));
             std::string line;
             std::getline(events, line);
             std::getline(events, line);
             double start = 0.0, speed = 0.0, duration = 0.0, depth = 0.0, force = 0.0;
             ASSERT_EQ(
                 std::sscanf(line.c_str(), "B,radial,%lf,%lf,%lf,%lf,%lf", &start, &speed, &duration, &depth, &force),
                 5)
                 << line;
             EXPECT_NEAR(start, 0.22728603e-3, 1e-11);
             EXPECT_NEAR(speed, 4.3858, 5e-5);
             EXPECT_NEAR(force, 45872.0, 0.5);
             int impacts = 1;
             while (std::getline(events, line)) ++impacts;
             EXPECT_EQ(impacts, 12);
             EXPECT_THAT(left.ended.out, HasSubstr("is used outside of its range"));
           }},
      {.text = "boresight check examples/flores-slider-crank/slider-in-guide.toml",
       .claims =
           [](const Left& left) {
             EXPECT_EQ(left.summary["kinematics"]["mobility"], 1);
             EXPECT_EQ(left.summary["kinematics"]["redundant_rows"], 3);
           }},
      {.text = "boresight laws examples/flores-slider-crank/flores-slider-crank.toml",
       .claims = [](const Left& left) { EXPECT_THAT(left.ended.out, HasSubstr("lankarani-nikravesh")); }},
      // "neighbouring states part e-fold every 4 ms"
      {.text = "boresight run examples/flores-slider-crank/flores-slider-crank.toml --rung perturbation --set "
               "motion.duration=2.4s --nonlinear \"12 ms\" --sample \"0.2 ms\"",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             const auto& joint = left.summary["nonlinear"]["joints"]["B"];
             EXPECT_TRUE(joint["period"].is_null()) << "the motion never repeats";
             EXPECT_NEAR(1.0 / joint["lyapunov"]["value"].get<double>(), 4e-3, 0.5e-3);
           }},
      {.text = "boresight check examples/four-bar/four-bar.toml", .claims = freedoms(1, 0)},
      {.text = "boresight run examples/four-bar/four-bar.toml",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {  // "Then change the play": four times the radial one, the same along the axis
             EXPECT_GT(largest(left.again({"--set", "clearance.*.radial=0.2mm"}), "boresight_error"),
                       2.0 * largest(left.summary, "boresight_error"));
           }},
      {.text = "boresight run examples/four-bar/four-bar.toml --set 'clearance.*.radial=0.2mm'", .shorter = kOnce},
      // "overconstrained three times; check says so, and the motion is none the worse"
      {.text = "boresight check examples/four-bar/planar.toml",
       .claims =
           [](const Left& left) {
             freedoms(1, 3)(left);
             EXPECT_THAT(left.ended.out, HasSubstr("3 constraint row(s) are redundant"));
           }},
      {.text = "boresight run examples/four-bar/planar.toml",
       .shorter = kOnce,
       .claims = [](const Left& left) { EXPECT_LT(left.summary["constraint_drift"].get<double>(), 1e-10); }},
      {.text = "boresight check examples/free-body/free-body.toml", .claims = freedoms(3, 0)},
      {.text = "boresight run examples/free-body/free-body.toml --rung multibody",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             expect_numbers(numbers(left.file("timeseries.csv"), 1000, "qw", 4),
                            {0.6874647330, 0.1752015920, 0.5407172524, 0.4520193536}, 1e-9);
             expect_numbers(numbers(left.file("timeseries.csv"), 10000, "qw", 4),
                            {0.4625454406, -0.3143351451, 0.0494296313, 0.8275275485}, 1e-9);
           }},
      {.text = "boresight check examples/heavy-top/heavy-top.toml", .claims = freedoms(3, 0)},
      {.text = "boresight run examples/heavy-top/heavy-top.toml --rung multibody",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             const std::string table = left.file("timeseries.csv");
             expect_numbers(numbers(table, 500, "x", 3), {-0.7024682971, -0.0211651847, -0.7114002577}, 1e-8);
             expect_numbers(numbers(table, 1000, "x", 3), {0.1733439641, 0.6400885921, -0.7484907911}, 1e-8);
             expect_numbers(numbers(table, 2000, "x", 3), {-0.1504168227, -0.7241655916, -0.6730222696}, 1e-8);
           }},
      {.text = "boresight check examples/pendulum/pendulum.toml", .claims = freedoms(1, 0)},
      {.text = "boresight run examples/pendulum/pendulum.toml --rung multibody",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             expect_numbers(numbers(left.file("timeseries.csv"), 1000, "x", 2), {0.9862917511, -0.1650108531}, 1e-9);
             expect_numbers(numbers(left.file("timeseries.csv"), 10000, "x", 2), {-0.2750874626, -0.9614192051}, 1e-9);
           }},
      {.text = "boresight check examples/spatial-double-crank/spatial-double-crank.toml", .claims = freedoms(1, 0)},
      {.text = "boresight run examples/spatial-double-crank/spatial-double-crank.toml",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             const json half = left.again({"--set", "clearance.*.radial=50um", "--set", "clearance.*.axial=50um"});
             EXPECT_NEAR(largest(half, "position_error") / largest(left.summary, "position_error"), 0.5, 0.05);
           }},
      {.text = "boresight check examples/spatial-slider-crank/spatial-slider-crank.toml", .claims = freedoms(1, 0)},
      // "the shaft tilts and bears on both ends of its sleeve at once": contacts radial- and radial+.
      {.text = "boresight run examples/spatial-slider-crank/spatial-slider-crank.toml",
       .shorter = {"--step-error", "off", "--set", "motion.duration=0.1s"},
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.file("events.csv"), AllOf(HasSubstr("\nO,radial-,"), HasSubstr("\nO,radial+,")));
           }},
      {.text = "boresight run examples/spatial-slider-crank/spatial-slider-crank.toml --set clearance.O.axes=parallel",
       .shorter = {"--step-error", "off", "--set", "motion.duration=0.1s"},
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.file("events.csv"), AllOf(Not(HasSubstr("radial-")), HasSubstr("\nO,radial,")));
           }},
  };
}

}  // namespace boresight::app
