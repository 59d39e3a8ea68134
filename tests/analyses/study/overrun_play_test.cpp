// Plays that another bearing holds, and seats that are built further off than they give room.
#include "boresight_analyses/study/overrun_play.hpp"

#include <gmock/gmock.h>

#include "bearing_pair_scenes.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "error_scenes.hpp"

namespace boresight {
namespace overrun_play_test {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A shaft in A1 and A2; A2's seat in the ground stands off along x by so much.
std::vector<std::string> said(const std::vector<std::string>& with_play, double radial, double off,
                              JournalAxes axes = JournalAxes::free) {
  MechanismDescription m = scenes::gimbal(with_play, axes);
  for (ClearanceDescription& c : m.clearances) c.parameters.radial = radial;
  m.errors = {scenes::frame_error(m, ErrorDescription::Kind::translation, "A2", "", Vec3::UnitX())};
  const Mechanism mechanism(m);
  Parameters sample = mechanism.parameters();
  sample.error = {off};
  return overrun_plays(mechanism, sample, ideal_motion(mechanism, sample));
}

TEST(OverrunPlay, IsSaidWhereASeatIsFurtherOffThanTheHeldClearance) {
  EXPECT_THAT(said({"A2"}, 100e-6, 130e-6), ElementsAre(AllOf(HasSubstr("\"A2\""), HasSubstr(" 30 µm"))));
  EXPECT_THAT(said({"A2"}, 100e-6, -130e-6), ElementsAre(HasSubstr(" 30 µm")));
}

TEST(OverrunPlay, IsNotSaidWhereThereIsRoomOrThePlayMoves) {
  EXPECT_THAT(said({"A2"}, 100e-6, 90e-6), IsEmpty());
  EXPECT_THAT(said({"A2"}, 100e-6, 0.0), IsEmpty());
  EXPECT_THAT(said({"A1", "A2"}, 100e-6, 130e-6), IsEmpty());
}

// A journal that is kept parallel cannot lie askew: two gaps of 0.1 mm leave 0.2 mm, and both journals give way to the rest alike.
TEST(OverrunPlay, IsSaidOfPlaysThatLeaveTooLittleRoomTogether) {
  const auto five = said({"A1", "A2"}, 100e-6, 1000e-6, JournalAxes::parallel);
  EXPECT_THAT(five,
              ElementsAre(AllOf(HasSubstr("5 times the room that the clearances of \"A1\", \"A2\" leave together"),
                                HasSubstr("pressed some 400 µm into its sleeve"), HasSubstr(" kN"))));
  EXPECT_THAT(said({"A1", "A2"}, 100e-6, -1000e-6, JournalAxes::parallel), ElementsAre(HasSubstr("5 times the room")));
  EXPECT_THAT(said({"A1", "A2"}, 100e-6, 190e-6, JournalAxes::parallel), IsEmpty());
}

// A shaft that may lie askew finds room in its bearings until its tilt fills their sleeves.
TEST(OverrunPlay, IsNotSaidOfAShaftThatLiesAskewInItsBearings) {
  EXPECT_THAT(said({"A1", "A2"}, 100e-6, 200e-6), IsEmpty());
  EXPECT_THAT(said({"A1", "A2"}, 100e-6, 2000e-6), ElementsAre(HasSubstr("times the room")));
}

}  // namespace overrun_play_test
}  // namespace boresight
