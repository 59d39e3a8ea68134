#include "command_table.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "command_claims.hpp"

namespace boresight::app {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// The whole motion in multibody and perturbation, without further runs for the steps' error.
const std::vector<std::string> kOnce = {"--step-error", "off"};

}  // namespace

std::vector<TableCommand> commands() {
  std::vector<TableCommand> all = {
      {.text = "boresight help clearance.friction",
       .claims = [](const Left& left) { EXPECT_THAT(left.ended.out, HasSubstr("static_coefficient")); }},
      {.text = "boresight paths examples/3-rrcpr/3-rrcpr.toml",
       .claims = [](const Left& left) { EXPECT_THAT(left.ended.out, HasSubstr("clearance.F1.radial")); }},
      {.text = "boresight check examples/3-rrcpr/3-rrcpr.toml", .claims = freedoms(6, 0)},
      // "near the clearance times 1.9 and breaks down four times"; "The orientation error is zero to rounding."
      {.text = "boresight run examples/3-rrcpr/3-rrcpr.toml",
       .shorter = kOnce,
       .claims =
           [](const Left& left) {
             EXPECT_NEAR(left.summary["index"]["position_error"]["rms"].get<double>() / 1.9e-4, 1.0, 0.05);
             EXPECT_LT(largest(left.summary, "orientation_error"), 1e-10);
             bool low = true;
             int breakdowns = 0;
             for (const auto& [t, row] : rows_by_millisecond(left.file("timeseries.csv"))) {
               const bool broken = std::hypot(row[1], row[2], row[3]) < 0.8e-4;
               if (t > 0 && broken && !low) ++breakdowns;  // it begins in the middle
               low = broken;
             }
             EXPECT_EQ(breakdowns, 4);
             EXPECT_THAT(left.file("report.html"), HasSubstr("\"kind\":\"view\""));
           }},
      {.text = "boresight run examples/3-rrcpr/3-rrcpr.toml --set clearance.F1.radial=0.2mm --set payload.mass=250kg",
       .shorter = kOnce,
       .claims = [](const Left& left) { EXPECT_GT(largest(left.summary, "position_error"), 2.0 * 2.31e-4); }},
      {.text = "boresight run examples/3-rrcpr/3-rrcpr.toml --set clearance.F1.radial=0.2mm",
       .shorter = kOnce,
       .claims = [](const Left& left) { EXPECT_NEAR(largest(left.summary, "position_error") / 2.31e-4, 2.0, 0.15); }},
      // "error grows in proportion to the clearance; the peaks of acceleration grow faster": from 0.1 to 0.3 mm that of x by more than a half.
      {.text = "boresight sweep examples/3-rrcpr/clearance-sweep.toml",
       .shorter = {"--rung", "perturbation"},
       .claims =
           [](const Left& left) {
             const auto& points = left.summary["points"];
             ASSERT_EQ(points.size(), 3u);
             const auto error = [&](int k) { return points[k]["index"]["position_error"]["max"].get<double>(); };
             EXPECT_NEAR(error(1) / error(0), 2.0, 0.15);
             EXPECT_NEAR(error(2) / error(0), 3.0, 0.25);
             EXPECT_GT(points[2]["platform_acceleration_max"][0].get<double>(),
                       1.5 * points[0]["platform_acceleration_max"][0].get<double>());
             EXPECT_THAT(left.file("report.html"), HasSubstr("What the paper found"));
           }},
      // "error grows much less than load, by Hertz' law; the peak acceleration falls with load while impacts get faster and their forces larger"
      {.text = "boresight sweep examples/3-rrcpr/load-sweep.toml",
       .shorter = {"--rung", "perturbation"},
       .claims =
           [](const Left& left) {
             const auto& points = left.summary["points"];
             ASSERT_EQ(points.size(), 3u);
             EXPECT_LT(points[2]["index"]["position_error"]["max"].get<double>(),
                       2.0 * points[0]["index"]["position_error"]["max"].get<double>());
             EXPECT_LT(points[2]["platform_acceleration_max"][0].get<double>(),
                       0.7 * points[0]["platform_acceleration_max"][0].get<double>());
             for (const char* grows : {"max_impact_speed", "max_force"})
               EXPECT_GT(points[2]["contact"]["F1"][grows].get<double>(),
                         points[0]["contact"]["F1"][grows].get<double>())
                   << grows;
             EXPECT_THAT(left.file("report.html"), HasSubstr("What the paper found"));
           }},
      // "the error scatters by a tenth of itself"
      {.text = "boresight montecarlo examples/3-rrcpr/montecarlo.toml",
       .shorter = {"--rung", "perturbation"},
       .claims =
           [](const Left& left) {
             EXPECT_EQ(left.summary["failed"], 0);
             EXPECT_NEAR(left.summary["index"]["sd"]["value"].get<double>() /
                             left.summary["index"]["mean"]["value"].get<double>(),
                         0.1, 0.01);
             EXPECT_TRUE(left.summary["requirement"]["met"].get<bool>());
             // "The 99.73 % level, 0.283 mm, is uncertain by sampling before anything else."
             EXPECT_NEAR(left.summary["index"]["p99.73"]["value"].get<double>(), 0.283e-3, 0.002e-3);
             EXPECT_THAT(left.ended.out, HasSubstr("sampling dominates"));
           }},
      {.text = "boresight montecarlo examples/3-rrcpr/montecarlo.toml --resume",
       .shorter = {"--rung", "perturbation", "--set", "motion.duration=20ms"},
       .claims = [](const Left& left) { EXPECT_THAT(left.ended.out, HasSubstr("all samples computed")); }},
      {.text = "boresight export results/montecarlo",
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.ended.out, HasSubstr("2000 samples: results/montecarlo/samples.csv"));
           },
       .before =
           {"boresight montecarlo examples/3-rrcpr/montecarlo.toml --rung perturbation --set motion.duration=20ms"}},
      // "the clearance makes nearly all of the variance; restitution and friction together some hundredths"
      {.text = "boresight sensitivity examples/3-rrcpr/sensitivity.toml",
       .shorter = {"--rung", "perturbation"},
       .claims =
           [](const Left& left) {
             const auto total = [&](const char* path) {
               return left.summary["sobol"][path]["total"]["value"].get<double>();
             };
             EXPECT_GT(total("clearance.F1.radial"), 0.95);
             EXPECT_LT(total("clearance.F1.contact.restitution") + total("clearance.F1.friction.coefficient"), 0.09);
             // "There is no slope by any of them worth the name"
             for (const char* path : {"clearance.F1.contact.restitution", "clearance.F1.friction.coefficient"})
               EXPECT_FALSE(left.summary["local"][path]["meaningful"].get<bool>()) << path;
           }},
      {.text = "boresight montecarlo examples/3-rrcpr/fidelities.toml",
       .shorter = {"--set", "motion.duration=50ms"},
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.ended.out, AllOf(HasSubstr("forecast: variance"), HasSubstr("unbiased for multibody")));
             EXPECT_GT(left.summary["fidelities"]["gain"]["forecast"].get<double>(), 1.0);
           },
       .edits = {{"3-rrcpr/fidelities.toml", "budget = \"60 s\", pilot = 40", "budget = \"3 s\", pilot = 10"}}},
      {.text = "boresight montecarlo examples/3-rrcpr/tail.toml",
       .shorter = {"--set", "motion.duration=20ms"},
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.ended.out, AllOf(HasSubstr("unbiased for perturbation"),
                                               HasSubstr("plain Monte Carlo for the same CPU")));
             EXPECT_LE(left.summary["tail"]["exceedance"]["low"].get<double>(),
                       left.summary["tail"]["exceedance"]["high"].get<double>());
             EXPECT_EQ(left.summary["requirement"]["met"].get<bool>(), left.ended.status == 0);
           },
       .edits = {{"3-rrcpr/tail.toml", "budget = \"60 s\", pilot = 50", "budget = \"0.2 s\", pilot = 20"}},
       .status = 1},
      {.text = "boresight match examples/3-rrcpr/match.toml",
       .shorter = {"--rung", "perturbation", "--integrator", "rosenbrock", "--set", "motion.duration=100ms"},
       .claims =
           [](const Left& left) {
             EXPECT_EQ(left.summary["descents"].size(),
                       2u);  // the box and one start; "Three starts end there" is told in full
             EXPECT_TRUE(left.summary["optimum"].contains("payload.mass"));
           },
       .edits = {{"3-rrcpr/match.toml", "starts = [\"1 kg\", \"60 kg\", \"140 kg\"]", "starts = [\"1 kg\"]"}}},
      {.text = "boresight allocate examples/3-rrcpr/allocate.toml",
       .shorter = {"--set", "motion.duration=20ms"},
       .claims =
           [](const Left& left) {
             EXPECT_EQ(left.summary["chosen"]["choice"].size(), 12u);
             EXPECT_LT(left.summary["chosen"]["price"].get<double>(),
                       left.summary["worst_case"]["price"].get<double>());
           },
       .edits = {{"3-rrcpr/allocate.toml", "samples = 1000", "samples = 200"},
                 {"3-rrcpr/allocate.toml", "front = 6", "front = 0"}}},
      {.text = "boresight budget examples/3-rrcpr/budget.toml --set clearance.F1.axes=free",
       .shorter = {"--rung", "perturbation", "--integrator", "rosenbrock", "--set", "motion.duration=1s"},
       .claims =
           [](const Left& left) {
             EXPECT_EQ(left.summary["tighten_first"][0]["name"], "F1");
             double share = 0.0;
             for (const auto& c : left.summary["contributions"]) share += c["share"].get<double>();
             EXPECT_NEAR(share, 1.0, 1e-9);
           },
       .edits = {{"3-rrcpr/budget.toml", "members = 400", "members = 24"},
                 {"3-rrcpr/budget.toml", "attribution = 64", "attribution = 4"}},
       .status = 1},
      {.text = "boresight chart examples/3-rrcpr/3-rrcpr.toml",
       .shorter = {"--time", "2 s", "--set", "motion.duration=50ms"},
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.ended.out,
                         AllOf(HasSubstr("Pareto front"), HasSubstr("the setting of Sun, Song and Wang")));
           }},
      {.text = "boresight stability examples/3-rrcpr/3-rrcpr.toml",
       .shorter = {"--set", "motion.duration=50ms"},
       .claims =
           [](const Left& left) { EXPECT_LT(left.summary["largest_difference_from_theory"].get<double>(), 0.02); }},
      {.text = "boresight laws examples/3-rrcpr/3-rrcpr.toml",
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.ended.out,
                         AllOf(HasSubstr("flores"), HasSubstr("modified-coulomb"), HasSubstr("johnson fits")));
           }},
      // Its figures are held by CalibrateProgram.LongRecoversTheExamplesTruth...
      {.text = "boresight calibrate examples/calibration/calibrate.toml",
       .claims =
           [](const Left& left) {
             EXPECT_NEAR(left.summary["optimum"]["clearance.D.radial"].get<double>(), 0.2e-3, 4e-6);
             EXPECT_THAT(left.file("posterior.toml"), AllOf(HasSubstr("[[random]]")));
           },
       .edits = {{"calibration/calibrate.toml", "starts = ", "starts = 1 # "},
                 {"calibration/calibrate.toml", "[calibrate]", "[calibrate]\nprofile = false"}}},
      // The fit of the first example; its draws are held by PosteriorDrawsLong.
      {.text = "boresight calibrate examples/calibration/posterior.toml",
       .claims =
           [](const Left& left) {
             const nlohmann::json& drawn = left.summary["posterior"];
             EXPECT_EQ(drawn["draws"].get<int>(), 64);
             const nlohmann::json& radial = drawn["quantities"]["clearance.D.radial"];
             EXPECT_NEAR(radial["mean"].get<double>(), 0.2e-3, 4e-6);
             EXPECT_THAT(left.file("posterior.toml"), HasSubstr("rows = { file = \"posterior.csv\" }"));
             EXPECT_THAT(left.file("posterior.csv"), HasSubstr("clearance.D.radial,"));
           },
       .edits = {{"calibration/posterior.toml", "starts = ", "starts = 1 # "},
                 {"calibration/posterior.toml", "draws = 1600", "draws = 64"},
                 {"calibration/posterior.toml", "warm_up = 150", "warm_up = 50"},
                 {"calibration/posterior.toml", "temperatures = 5", "temperatures = 3"}},
       .status = 1},
      // Half of the data that the example above takes: the truth lies within twice its errors.
      {.text = "boresight calibrate examples/calibration/sensors.toml",
       .claims =
           [](const Left& left) {
             EXPECT_NEAR(left.summary["optimum"]["clearance.D.radial"].get<double>(), 0.2e-3, 4e-6);
             EXPECT_NEAR(left.summary["optimum"]["clearance.D.contact.restitution"].get<double>(), 0.6, 0.02);
             EXPECT_EQ(left.summary["data"].size(), 2u);
           },
       .edits = {{"calibration/sensors.toml", "starts = ", "starts = 1 # "}}},
      {.text = "boresight calibrate examples/calibration/calibrate.toml --make-data \"1 %\" --make-offset \"5 um\" "
               "--make-seed 7"},
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
  for (TableCommand& c : commands_on_errors()) all.push_back(std::move(c));
  for (TableCommand& c : commands_on_imports()) all.push_back(std::move(c));
  for (TableCommand& c : commands_on_two_bearings()) all.push_back(std::move(c));
  return all;
}

}  // namespace boresight::app
