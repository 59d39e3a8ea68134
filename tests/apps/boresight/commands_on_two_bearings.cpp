// What the commands on bearing pairs do.
#include <gmock/gmock.h>

#include "command_claims.hpp"
#include "command_table.hpp"

namespace boresight::app {
namespace {

using testing::HasSubstr;

double boresight_rms(const Left& left) { return left.summary["index"]["boresight_error"]["rms"].get<double>(); }

}  // namespace

std::vector<TableCommand> commands_on_two_bearings() {
  return {
      // "the plays of one shaft move together"
      {.text = "boresight check examples/bearing-pairs/gimbal.toml",
       .claims =
           [](const Left& left) {
             freedoms(2, 8)(left);
             EXPECT_THAT(left.ended.out, HasSubstr("the plays of \"pitch\" and \"pitch.floating\" move together"));
           }},
      {.text = "boresight run examples/bearing-pairs/gimbal.toml",
       .shorter = {"--step-error", "off"},
       .claims = [](const Left& left) { EXPECT_NEAR(boresight_rms(left) / 0.162e-3, 1.0, 0.05); }},
      // "the boresight error (RMS) is two thirds of what it was"
      {.text = "boresight run examples/bearing-pairs/gimbal.toml --set \"clearance.yaw.span=100 mm\"",
       .shorter = {"--step-error", "off"},
       .claims = [](const Left& left) { EXPECT_NEAR(boresight_rms(left) / 0.162e-3, 2.0 / 3.0, 0.05); }},
      {.text = "boresight montecarlo examples/bearing-pairs/montecarlo.toml --rung perturbation",
       .claims = [](const Left& left) { EXPECT_EQ(left.summary["failed"], 0); }},
      // "The platform sinks by 33 um and turns its boresight by less than 1 urad"
      {.text = "boresight run examples/hexapod/play.toml --rung perturbation",
       .shorter = {"--step-error", "off"},
       .claims =
           [](const Left& left) {
             EXPECT_NEAR(largest(left.summary, "position_error"), 33.4e-6, 0.5e-6);
             EXPECT_LT(largest(left.summary, "boresight_error"), 1e-6);
           }},
      // "the yaw bearings need the closer ones"
      {.text = "boresight allocate examples/bearing-pairs/allocate.toml",
       .claims = [](const Left& left) { EXPECT_THAT(left.ended.out, HasSubstr("the requirement is met")); }},
      // "with 100 N the boresight error (RMS) is half of what it is with 1 N"
      {.text = "boresight sweep examples/bearing-pairs/preload.toml --rung perturbation",
       .claims =
           [](const Left& left) {
             const auto& points = left.summary["points"];
             ASSERT_EQ(points.size(), 4u);
             const auto error = [&](int k) { return points[k]["index"]["boresight_error"]["rms"].get<double>(); };
             for (int k = 1; k < 4; ++k) EXPECT_LT(error(k), error(k - 1));
             EXPECT_NEAR(error(3) / error(0), 0.5, 0.05);
           }},
  };
}

}  // namespace boresight::app
