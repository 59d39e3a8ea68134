// A rest that nothing decides along part of its play, and by which loads on offsets it is found.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "boresight/contact_events/contact_jacobian.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/scene/clearance_scene.hpp"

namespace boresight {
namespace neutral_stage_test {

// A stage on two parallel guides, the second one with more play in its height: it leans over as far as that, and no load turns it about the vertical.
// moved: the drawing, along x [mm].
std::string on_two_guides(const std::string& second_gap, int moved = 0) {
  const auto guide = [](const std::string& joint, const std::string& gap) {
    return "[[clearance]]\njoint = \"" + joint +
           "\"\njournal = \"stage\"\nguide = \"rectangular\"\nwidth_gap = \"0.03 mm\"\n" + "height_gap = \"" + gap +
           R"toml("
height = "20 mm"
width = "20 mm"
length = "60 mm"
width_direction = [0, 1, 0]
axes = "free"
  [clearance.contact]
  law = "flores"
  restitution = 0.6
  young = ["207 GPa", "72 GPa"]
  poisson = [0.3, 0.33]
)toml";
  };
  return R"toml(format = 1
name = "stage on two guides"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "stage"
mass = "5 kg"
center_of_mass = [")toml" +
         std::to_string(moved + 10) + R"toml( mm", "5 mm", "20 mm"]
inertia = ["0.02 kg m^2", "0.02 kg m^2", "0.02 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "G1"
type = "prismatic"
connects = ["ground", "stage"]
point = [")toml" +
         std::to_string(moved) + R"toml( mm", "-100 mm", "0 mm"]
axis = [1, 0, 0]
driven = true
[[joint]]
name = "G2"
type = "prismatic"
connects = ["ground", "stage"]
point = [")toml" +
         std::to_string(moved) + R"toml( mm", "100 mm", "0 mm"]
axis = [1, 0, 0]
[motion]
duration = "50 ms"
drives = { G1 = "0*t" }
)toml" + guide("G1", "0.02 mm") +
         guide("G2", second_gap);
}

TEST(NeutralStage, IsTurnedByNothingWhereItLeans) {
  for (const int moved : {0, 1000})
    for (const char* gap : {"0.02 mm", "0.0201 mm", "0.021 mm", "0.025 mm", "0.03 mm"}) {
      const auto mechanism =
          std::make_shared<const Mechanism>(read_mechanism_text(on_two_guides(gap, moved), "two-guides.toml"));
      const IdealMotion ideal = ideal_motion(*mechanism, mechanism->parameters());
      EXPECT_EQ(ClearanceScene::at_start(*mechanism, ideal, mechanism->parameters()).layout.undecided,
                (std::vector<int>{0, 1}))
          << gap;
      RunOptions options;
      options.sample_spacing = 0.0;
      // It pitches by less than a micrometre over its length; turned to the end of its play, its boresight errs by a milliradian.
      for (const char* rung : {"quasistatic", "perturbation", "multibody"})
        EXPECT_LT(make_rung(rung, mechanism)->run(mechanism->parameters(), options).index.boresight_error.max, 5e-6)
            << rung << ' ' << gap;
    }
}

// What a moment about the insert was made of.
TEST(CouplesOf, AreThoseThatMadeTheMoment) {
  PlayMotion<double> m;
  m.slope = {0.3, -0.2};
  const Vec3 couples(1.5, -0.7, 2.2);
  const Vec3 moment = moment_of_couple(couples[0], couples[1], m) + couples[2] * roll_axis(m);
  EXPECT_LT((couples_of(moment, m) - couples).norm(), 1e-14);
}

// An elastic energy has a second derivative: a slider that leans, is turned and rolled in its guide.
TEST(OffsetJacobian, IsSymmetricWhereContactIsElastic) {
  const Mechanism mechanism(read_mechanism_text(on_two_guides("0.025 mm"), "two-guides.toml"));
  const JointPlay slider = joint_plays(mechanism.description(), mechanism.parameters())[0].elastic_only();
  PlayOffsets offsets;
  offsets << 20e-6, 0.0, -21e-6, 8e-4, 3e-4, 2e-4;
  OffsetJacobian by;
  offset_jacobian(slider, at_rest_at(offsets), kSlowImpacts, by);
  ASSERT_GT(by.norm(), 0.0);
  EXPECT_GT(by.bottomRightCorner(3, 3).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LT((by - by.transpose()).norm(), 1e-12 * by.norm());
}

}  // namespace neutral_stage_test
}  // namespace boresight
