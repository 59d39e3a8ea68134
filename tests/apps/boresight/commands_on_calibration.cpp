// What the commands on calibration do.
#include <gmock/gmock.h>

#include "command_claims.hpp"
#include "command_table.hpp"

namespace boresight::app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

}  // namespace

std::vector<TableCommand> commands_on_calibration() {
  return {
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
  };
}

}  // namespace boresight::app
