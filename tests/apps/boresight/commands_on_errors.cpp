#include <gmock/gmock.h>

#include <map>
#include <string>

#include "command_claims.hpp"
#include "command_table.hpp"

namespace boresight::app {

std::vector<TableCommand> commands_on_errors() {
  using testing::HasSubstr;
  return {
      // An independent program's loop closure: 0.1 mrad in A3 turns the platform by up to 0.104 mrad, and moves it by 0.077 mm.
      {.text = "boresight check examples/3-rrcpr/tolerances.toml",
       .claims =
           [](const Left& left) {
             freedoms(6, 0)(left);
             const auto& errors = left.summary["standing_errors"];
             ASSERT_EQ(errors.size(), 53u);
             EXPECT_NEAR(errors["A3.zero"]["position"].get<double>(), 7.718742e-5 / 1e-4, 1e-3 * 0.7718742);
             EXPECT_GT(errors["A3.zero"]["boresight"].get<double>(), 0.9);
             EXPECT_EQ(errors["rod1.length"]["boresight"].get<double>(), 0.0);
             EXPECT_NEAR(errors["rod1.length"]["position"].get<double>(), 3.881242e-5 / 20e-6, 0.2);
             const nlohmann::json valued = left.again({"--set", "error.A3.zero=0.1mrad"});
             EXPECT_EQ(valued["standing_errors"]["A3.zero"]["value"].get<double>(), 1e-4);
           }},
      // "a tenth of a milliradian in one of the six drives turns the boresight by 95 urad. The play ... turns it by nothing"
      {.text = "boresight run examples/3-rrcpr/tolerances.toml --set error.A3.zero=0.1mrad",
       .shorter = {"--step-error", "off"},
       .claims =
           [](const Left& left) {
             EXPECT_NEAR(largest(left.summary, "boresight_error"), 95e-6, 0.5e-6);
             EXPECT_LT(largest(left.again({"--set", "error.A3.zero=0mrad"}), "boresight_error"), 1e-10);
           }},
      // "the axes of C, P and F not being square to each other, some of it from where the A drives count from. Lengths and temperatures
      // turn nothing"
      {.text = "boresight sensitivity examples/3-rrcpr/tolerances-study.toml",
       .shorter = {"--rung", "quasistatic", "--set", "motion.duration=20ms"},
       .claims =
           [](const Left& left) {
             const auto& sobol = left.summary["sobol"];
             ASSERT_EQ(sobol.size(), 54u);
             double square = 0.0, sum = 0.0;
             for (const auto& [path, index] : sobol.items()) {
               const double total = index["total"]["value"];
               sum += total;
               if (path.ends_with(".squareness") && !path.starts_with("error.B")) square += total;
               const bool turns_nothing =
                   path.ends_with(".length") || path.ends_with(".warming") || path.find(".radius") != std::string::npos;
               EXPECT_LT(turns_nothing ? total : 0.0, 1e-3) << path;
               const bool counts_from = path.ends_with(".zero") && path.starts_with("error.A");
               EXPECT_GT(counts_from ? total : 1.0, 5e-3) << path;
             }
             EXPECT_GT(square, 0.7 * sum);
             EXPECT_THAT(left.file("report.html"), HasSubstr("Tornado"));
           },
       .edits = {{"3-rrcpr/tolerances-study.toml", "samples = 64", "samples = 16"}}},
      {.text = "boresight montecarlo examples/3-rrcpr/tolerances-study.toml",
       .shorter = {"--rung", "quasistatic", "--set", "motion.duration=20ms"},
       .claims = [](const Left& left) { EXPECT_TRUE(left.summary["requirement"]["met"].get<bool>()); },
       .edits = {{"3-rrcpr/tolerances-study.toml", "samples = 1000", "samples = 400"}}},
      {.text = "boresight allocate examples/3-rrcpr/allocate-tolerances.toml",
       .shorter = {"--set", "motion.duration=4ms"},
       .claims =
           [](const Left& left) {
             EXPECT_EQ(left.summary["chosen"]["choice"].size(), 57u);
             EXPECT_LT(left.summary["chosen"]["bound"].get<double>(),
                       left.summary["chosen"]["price"].get<double>() * (1.0 + 1e-9));
             EXPECT_THAT(left.file("allocation.csv"), HasSubstr("\nerror.rod1.length,"));
           },
       .edits = {{"3-rrcpr/allocate-tolerances.toml", "samples = 1000", "samples = 200"},
                 {"3-rrcpr/allocate-tolerances.toml", "front = 4", "front = 0"}}},
      // "the drift between the two windows (PDE) comes from it and from the play in F1, and hardly from lengths"
      {.text = "boresight budget examples/3-rrcpr/tolerances-budget.toml --rung quasistatic",
       .claims =
           [](const Left& left) {
             std::map<std::string, double> share;
             for (const auto& one : left.summary["contributions"]) share[one["name"]] = one["share"].get<double>();
             EXPECT_GT(share["sun on leg 1"], 0.3);
             EXPECT_GT(share["F1"], 0.3);
             EXPECT_LT(share["lengths"], 0.08);
             EXPECT_TRUE(left.summary["requirements"][0]["met"].get<bool>());
           },
       .edits = {{"3-rrcpr/tolerances-budget.toml", "members = 200", "members = 60"},
                 {"3-rrcpr/tolerances-budget.toml", "attribution = 40", "attribution = 12"}}},
      {.text = "boresight run examples/altaz-gimbal/altaz-gimbal.toml",
       .shorter = {"--step-error", "off"},
       .claims = [](const Left& left) { EXPECT_GT(largest(left.summary, "boresight_error"), 1e-4); }},
      {.text = "boresight montecarlo examples/altaz-gimbal/montecarlo.toml",
       .shorter = {"--set", "motion.duration=20ms"},
       .claims =
           [](const Left& left) {
             EXPECT_EQ(left.summary["failed"], 0);
             EXPECT_EQ(left.summary["rung"], "quasistatic");
           },
       .status = 1},  // so short a part of the sky leaves the limit open
      // "The index of elevation, the tilts and the ripple are found to some tenths of one. The index of azimuth, collimation and the
      // perpendicularity of the axes are found to some two"
      {.text = "boresight calibrate examples/altaz-gimbal/calibrate.toml",
       .claims =
           [](const Left& left) {
             const double arcsec = 4.84813681109536e-6;
             const auto error_of = [&](const char* name) {
               return left.summary["standard_error"][std::string("error.") + name].get<double>() / arcsec;
             };
             for (const char* name : {"IE", "AN", "AW"}) EXPECT_LT(error_of(name), 0.6) << name;
             for (const char* name : {"IA", "CA", "NPAE"}) {
               EXPECT_GT(error_of(name), 0.8) << name;
               EXPECT_LT(error_of(name), 3.5) << name;
             }
           }},
      {.text = "boresight calibrate examples/altaz-gimbal/calibrate.toml --make-data \"1 arcsec\" --make-samples 50 "
               "--make-seed 3"},
      // "The limit of the longest exposure is not met"; "They agree"
      {.text = "boresight budget examples/altaz-gimbal/jitter.toml --set motion.drives.azimuth=0.3 --set "
               "motion.drives.elevation=pi/4",
       .claims =
           [](const Left& left) {
             const auto& asked = left.summary["requirements"];
             ASSERT_EQ(asked.size(), 4u);
             EXPECT_TRUE(asked[0]["met"].get<bool>());
             EXPECT_TRUE(asked[1]["met"].get<bool>());
             EXPECT_FALSE(asked[2]["met"].get<bool>());
             for (const auto& one : left.summary["spectra"]) EXPECT_FALSE(one["differs"].get<bool>()) << one;
             EXPECT_EQ(left.summary["parts"].size(), 5u);
           },
       .status = 1},
      // "says which errors use up play"
      {.text = "boresight check examples/altaz-gimbal/bearing-pairs.toml",
       .claims =
           [](const Left& left) {
             for (const auto& [name, error] : left.summary["standing_errors"].items()) {
               EXPECT_EQ(error["uses_play"], name == "upper.seat" || name == "far.seat") << name;
               EXPECT_FALSE(error["does_nothing"]) << name;
             }
           }},
      // "agree on the boresight to three digits"
      {.text = "boresight run examples/altaz-gimbal/bearing-pairs.toml",
       .shorter = {"--step-error", "off", "--set", "motion.duration=0.3 s"},
       .claims =
           [](const Left& left) {
             const auto rms = [](const nlohmann::json& summary) {
               return summary["index"]["boresight_error"]["rms"].get<double>();
             };
             const double exact = rms(left.summary);
             EXPECT_NEAR(rms(left.again({"--rung", "perturbation"})), exact, 5e-4 * exact);
           }},
      {.text = "boresight run examples/altaz-gimbal/bearing-pairs.toml --rung perturbation",
       .shorter = {"--step-error", "off", "--set", "motion.duration=0.1 s"}},
      {.text = "boresight sensitivity examples/altaz-gimbal/bearing-pairs-study.toml",
       .shorter = {"--set", "motion.duration=20ms", "--rung", "perturbation"},
       .claims = [](const Left& left) { EXPECT_EQ(left.summary["morris"].size(), 14u); },
       .edits = {{"altaz-gimbal/bearing-pairs-study.toml", "samples = 32  ", "samples = 16  "}}},
      {.text = "boresight montecarlo examples/altaz-gimbal/bearing-pairs-study.toml",
       .shorter = {"--set", "motion.duration=20ms", "--rung", "perturbation"},
       .claims = [](const Left& left) { EXPECT_EQ(left.summary["failed"], 0); },
       .edits = {{"altaz-gimbal/bearing-pairs-study.toml", "samples = 200", "samples = 60"}},
       .status = 1},  // so few leave the limit open
      {.text = "boresight sensitivity examples/hexapod/dimensions.toml",
       .shorter = {"--set", "motion.duration=0.1s"},
       .claims =
           [](const Left& left) {
             const auto of = [&](const char* name) {
               return left.summary["morris"][std::string("error.") + name]["mu_star"]["value"].get<double>();
             };
             EXPECT_EQ(left.summary["rung"], "quasistatic");
             for (const char* along : {"leg1a.length", "leg3b.length", "base2a.height", "platform1b.height"})
               EXPECT_GT(of(along), 2.0 * of("platform1a.radius")) << along;
           }},
      {.text = "boresight check examples/hexapod/hexapod.toml", .claims = freedoms(6, 0)},
      // "one leg longer by 20 um moves the platform by 20 um and turns its boresight by 34 urad"
      {.text = "boresight run examples/hexapod/hexapod.toml --set error.leg1a.length=20um",
       .shorter = {"--step-error", "off", "--rung", "perturbation"},
       .claims =
           [](const Left& left) {
             EXPECT_NEAR(largest(left.summary, "position_error"), 20e-6, 0.5e-6);
             EXPECT_NEAR(largest(left.summary, "boresight_error"), 34e-6, 0.5e-6);
           }},
      {.text = "boresight montecarlo examples/hexapod/dimensions.toml",
       .shorter = {"--set", "motion.duration=0.1s"},
       .claims =
           [](const Left& left) {
             EXPECT_TRUE(left.summary["requirement"]["met"].get<bool>());
             EXPECT_EQ(left.summary["failed"], 0);
           }},
  };
}

}  // namespace boresight::app
