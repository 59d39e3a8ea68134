// Play of every kind beside a rigid joint that holds the same parts: it cannot move, and is named before anything is followed.
#include <gmock/gmock.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/generic_instant.hpp"
#include "boresight/mechanism/play_mobility.hpp"
#include "play_kinds.hpp"
#include "scenes.hpp"

namespace boresight {
namespace held_play_of_every_kind_test {

using scenes::PlayKind;
using testing::HasSubstr;

// A joint of the same type between the same bodies: farther along its axis, elsewhere in its plane, or at the same point.
std::string with_rigid_sibling(const PlayKind& kind, std::string text) {
  const std::string type = kind.type;
  std::string joint =
      "[[joint]]\nname = \"rigid\"\ntype = \"" + type + "\"\nconnects = [\"ground\", \"arm\"]\npoint = ";
  joint += type == "spherical" || type == "universal" ? "[\"0 mm\", \"0 mm\", \"0 mm\"]\n"
           : type == "planar"                         ? "[\"50 mm\", \"20 mm\", \"0 mm\"]\n"
                                                      : "[\"100 mm\", \"0 mm\", \"0 mm\"]\n";
  if (type != "spherical") joint += type == "planar" ? "axis = [0, 0, 1]\n" : "axis = [1, 0, 0]\n";
  if (type == "universal") joint += "second_axis = [0, 1, 0]\n";
  return text.insert(text.find("[motion]"), joint);
}

std::vector<PlayKind> kinds() { return scenes::play_kinds(); }

class HeldPlay : public testing::TestWithParam<PlayKind> {};

TEST_P(HeldPlay, IsNamedWhateverItsKind) {
  const bool universal = std::string(GetParam().type) == "universal";
  for (const bool tilts : {false, true}) {
    if (tilts && !GetParam().tilts) continue;
    const auto mechanism = scenes::build(read_mechanism_text(
        with_rigid_sibling(GetParam(),
                           scenes::play_file(GetParam(), {.tilts = tilts, .friction = 0.0, .duration = 0.02})),
        "play.toml"));
    const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
    IdealState state;
    ideal.state(generic_instant(0.0, ideal.duration()), state);
    const PlayMobility play = analyse_play(*mechanism, state.bodies);
    const RunResult run = make_rung("multibody", mechanism)->run(mechanism->parameters(), {});
    if (universal) {  // its cross is free between its journals, the arm is not
      EXPECT_THAT(bound_plays(*mechanism, play),
                  testing::ElementsAre(HasSubstr("the plays of \"J.first\" and \"J.second\" move together")));
      EXPECT_LT(run.index.position_error.max, 1e-9);
      continue;
    }
    const std::vector<std::string> held = held_plays(*mechanism, play);
    ASSERT_EQ(held.size(), static_cast<std::size_t>(mechanism->clearances()));
    for (const std::string& sentence : held)
      EXPECT_THAT(sentence, HasSubstr("cannot move: \"rigid\" holds the same parts without play"));
    EXPECT_EQ(run.warnings, held);
    EXPECT_LT(run.index.position_error.max, 1e-12);
  }
}

// What pushes its coordinates is rounding, and no sign of a pose that is singular.
TEST_P(HeldPlay, DoesNotMoveOnTheOpenedMechanism) {
  const auto mechanism = scenes::build(read_mechanism_text(
      with_rigid_sibling(GetParam(), scenes::play_file(GetParam(), {.friction = 0.1, .duration = 0.5})), "play.toml"));
  const auto off = [&](const char* rung) {
    return make_rung(rung, mechanism)->run(mechanism->parameters(), {}).index.position_error.max;
  };
  if (std::string(GetParam().type) == "universal") {
    // Its cross is free between its journals, and rubs on an arm that nothing drives.
    const double by_multibody = off("multibody");
    EXPECT_NEAR(off("perturbation"), by_multibody, 0.01 * by_multibody);
    return;
  }
  EXPECT_LT(off("perturbation"), 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Ladder, HeldPlay, testing::ValuesIn(kinds()),
                         [](const testing::TestParamInfo<PlayKind>& of) { return std::string(of.param.name); });

}  // namespace held_play_of_every_kind_test
}  // namespace boresight
