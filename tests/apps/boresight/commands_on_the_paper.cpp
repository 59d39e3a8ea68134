// What the commands on the paper's mechanism do.
#include <gmock/gmock.h>

#include <cmath>

#include "command_claims.hpp"
#include "command_table.hpp"

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

}  // namespace

std::vector<TableCommand> commands_on_the_paper() {
  return {
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
  };
}

}  // namespace boresight::app
