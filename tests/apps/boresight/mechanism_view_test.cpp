// The report's view shows what the run found: joints stay closed but for their clearance, and the boresight
// is where it was.
#include "report_parts/mechanism_view.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "report/contract.hpp"

namespace boresight::app {
namespace mechanism_view_test {

std::shared_ptr<const Mechanism> example(const std::string& file) {
  return std::make_shared<const Mechanism>(
      read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + file, {{"motion.duration", "20 ms"}}));
}

RunResult run_with_frames(const std::shared_ptr<const Mechanism>& mechanism) {
  RunOptions options;
  options.sample_spacing = 1e-4;
  options.frame_spacing = view_frame_spacing(*mechanism);
  return make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
}

double along(const report::Numbers& track, std::size_t i) {
  return track.empty() ? 0.0 : track[track.size() == 1 ? 0 : i];
}
Vec3 ideal(const report::ViewPoint& p, std::size_t i) { return {along(p.x, i), along(p.y, i), along(p.z, i)}; }
Vec3 deviation(const report::ViewPoint& p, std::size_t i) { return {along(p.dx, i), along(p.dy, i), along(p.dz, i)}; }

TEST(MechanismView, KeepsJointsClosedButForTheirClearance) {
  const auto mechanism = example("3-rrcpr/3-rrcpr.toml");
  const RunResult result = run_with_frames(mechanism);
  const report::View view = mechanism_view(*mechanism, result);
  ASSERT_EQ(view.time.size(), result.frames.size());
  ASSERT_EQ(view.joints.size(), static_cast<std::size_t>(mechanism->joints()));
  double moved = 0.0;
  for (int j = 0; j < mechanism->joints(); ++j) {
    const report::ViewJoint& joint = view.joints[j];
    const JointType type = mechanism->description().joints[j].type;
    const int c = mechanism->clearance_of(j);
    EXPECT_EQ(joint.clearance.has_value(), c >= 0) << joint.name;
    for (std::size_t i = 0; i < view.time.size(); ++i) {
      const report::ViewPoint &first = view.points[joint.first], &second = view.points[joint.second];
      const Vec3 apart = deviation(second, i) - deviation(first, i);
      moved = std::max(moved, deviation(first, i).norm());
      if (c >= 0) {
        EXPECT_NEAR(apart.norm(), 1e3 * result.clearances[c][result.frames[i].sample].offset.norm(), 1e-9)
            << joint.name;
      } else if (type != JointType::prismatic && type != JointType::cylindrical && type != JointType::planar) {
        EXPECT_LT((ideal(second, i) - ideal(first, i)).norm(), 1e-6) << joint.name;
        EXPECT_LT(apart.norm(), 1e-6) << joint.name;
      }
    }
  }
  EXPECT_GT(moved, 1e-3);  // there is something to see [mm]
}

// The middle of the room goes with the part that slides: from it, the part's centre is off by its offset, in a guide's width and height
// and along a slot's normal, however far the part has slid.
TEST(MechanismView, DrawsTheRoomOfAPadAndOfASliderWhereTheyAre) {
  int pads = 0, sliders = 0;
  for (const std::string file :
       {BORESIGHT_CORPUS "/xy-stage.toml", BORESIGHT_EXAMPLES "/flores-slider-crank/slider-in-guide.toml"}) {
    const auto mechanism = std::make_shared<const Mechanism>(read_mechanism(file, {{"motion.duration", "60 ms"}}));
    const RunResult result = run_with_frames(mechanism);
    const report::View view = mechanism_view(*mechanism, result);
    double slid = 0.0;
    for (int c = 0; c < mechanism->clearances(); ++c) {
      const ClearanceDescription& play = mechanism->description().clearances[c];
      const report::ViewJoint& joint = view.joints[play.joint];
      const bool pad = mechanism->description().joints[play.joint].type == JointType::planar,
                 slider = play.guide == GuideShape::rectangular;
      ASSERT_TRUE(joint.clearance.has_value());
      ASSERT_GE(joint.room, 0);
      pads += pad;
      sliders += slider;
      EXPECT_EQ(joint.side >= 0, slider);
      EXPECT_DOUBLE_EQ(joint.clearance->pad, 1e3 * play.parameters.pad_radius);
      EXPECT_DOUBLE_EQ(joint.clearance->width, 1e3 * play.parameters.width_gap);
      EXPECT_DOUBLE_EQ(joint.clearance->height, 1e3 * play.parameters.height_gap);
      const report::ViewPoint &first = view.points[joint.first], &second = view.points[joint.second],
                              &room = view.points[joint.room], &tip = view.points[joint.tip];
      for (std::size_t i = 0; i < view.time.size(); ++i) {
        EXPECT_LT((ideal(room, i) - ideal(second, i)).norm(), 1e-9) << joint.name;
        slid = std::max(slid, (ideal(second, i) - ideal(first, i)).norm());
        const Vec3 off = deviation(second, i) - deviation(room, i);
        const Vec3 offset = 1e3 * result.clearances[c][result.frames[i].sample].offset;
        const Vec3 normal = (ideal(tip, i) - ideal(first, i)).normalized();
        // The real axis is turned by some 1e-4 from the ideal one.
        if (pad) {
          EXPECT_NEAR(off.dot(normal), offset.y(), 1e-3 * offset.norm() + 1e-9) << joint.name;
        }
        if (slider) {
          const Vec3 side = (ideal(view.points[joint.side], i) - ideal(first, i)).normalized();
          EXPECT_NEAR(off.dot(side), offset.x(), 1e-3 * offset.norm() + 1e-9) << joint.name;
          EXPECT_NEAR(off.dot(side.cross(normal)), offset.z(), 1e-3 * offset.norm() + 1e-9) << joint.name;
        }
      }
    }
    EXPECT_GT(slid, 1.0) << file;  // [mm]
  }
  EXPECT_EQ(pads, 1);
  EXPECT_EQ(sliders, 1);
}

TEST(MechanismView, PointsWhereTheBodyPoints) {
  const auto mechanism = example("3-rrcpr/3-rrcpr.toml");
  const RunResult result = run_with_frames(mechanism);
  const report::View view = mechanism_view(*mechanism, result);
  ASSERT_EQ(view.rays.size(), 1u);
  for (std::size_t i = 0; i < view.time.size(); ++i) {
    const PoseSample& sample = result.boresight.samples[result.frames[i].sample];
    const report::ViewPoint &from = view.points[view.rays[0].from], &to = view.points[view.rays[0].to];
    EXPECT_NEAR((deviation(from, i) - 1e3 * sample.error.displacement).norm(), 0.0, 1e-9);
    const Vec3 ray = ideal(to, i) + deviation(to, i) - ideal(from, i) - deviation(from, i);
    EXPECT_NEAR((ray.normalized() - sample.pose.q * mechanism->boresight_B()).norm(), 0.0, 1e-9);
  }
}

TEST(MechanismView, OfEveryExampleKeepsTheReportSmall) {
  for (const char* file :
       {"3-rrcpr/3-rrcpr.toml", "2-us-pointing/2-us-pointing.toml", "pendulum/pendulum.toml", "bricard/bricard.toml"}) {
    const auto mechanism = example(file);
    const report::View view = mechanism_view(*mechanism, run_with_frames(mechanism));
    const nlohmann::json document = {
        {"title", "T"}, {"sections", {{{"id", "s"}, {"title", "S"}, {"items", nlohmann::json::array({view})}}}}};
    EXPECT_NO_THROW(report::check(document)) << file;
    EXPECT_LT(report::rounded(document).dump().size(), 1'000'000u) << file;
    EXPECT_GE(view.time.size(), 40u) << file;
  }
}

}  // namespace mechanism_view_test
}  // namespace boresight::app
