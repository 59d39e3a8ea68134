// What the commands on mechanisms from other programs do.
#include <gmock/gmock.h>

#include "command_claims.hpp"
#include "command_table.hpp"

namespace boresight::app {
namespace {

using testing::HasSubstr;

const char kImport[] =
    "boresight import examples/from-urdf/gimbal.urdf --boresight optical_frame:z --drive \"pan=0.4*sin(2*t); "
    "tilt=0.3*sin(3*t)\" "
    "--duration 0.5s";

}  // namespace

std::vector<TableCommand> commands_on_imports() {
  return {
      {.text = kImport,
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.ended.out,
                         HasSubstr("gimbal.toml: 2 bodies of 1.47 kg together, 2 joints, 2 of them driven"));
             EXPECT_THAT(left.ended.out, HasSubstr("shapes"));
             EXPECT_THAT(left.ended.out, HasSubstr("limits"));
             EXPECT_THAT(left.ended.out, HasSubstr("damping"));
           }},
      {.text = "boresight check gimbal.toml", .claims = freedoms(2, 0), .before = {kImport}},
      // "the zeros of the encoders make most of the budget; the play adds hardly anything"
      {.text = "boresight budget examples/from-urdf/budget.toml --rung quasistatic",
       .claims =
           [](const Left& left) {
             EXPECT_THAT(left.ended.out, HasSubstr("APE"));
             double zeros = 0.0, play = 0.0;
             for (const auto& part : left.summary["contributions"]) {
               const std::string name = part["name"];
               if (name.starts_with("error.")) zeros += part["share"].get<double>();
               if (name.find("tilt.radial") != std::string::npos || name == "tilt") play += part["share"].get<double>();
             }
             EXPECT_GT(zeros, 0.5);
             EXPECT_LT(std::abs(play), 0.05);
           },
       .edits = {{"from-urdf/budget.toml", "attribution = 32", "attribution = 12"}}},
      {.text = "boresight convert examples/from-urdf/gimbal.toml --to gimbal.sdf",
       .claims = [](const Left& left) { EXPECT_THAT(left.ended.out, HasSubstr("play: joints are ideal")); }},
  };
}

}  // namespace boresight::app
