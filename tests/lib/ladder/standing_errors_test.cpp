// Standing errors: the built mechanism held against figures of an independent program, against geometry, and against its own linear
// columns of influence.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "bearing_pair_scenes.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/error_influence.hpp"
#include "boresight/mechanism/ideal_solver.hpp"
#include "error_scenes.hpp"
#include "scenes.hpp"

namespace boresight {
namespace standing_errors_test {

using scenes::drive_error, scenes::frame_error, scenes::with_every_error;
using Kind = ErrorDescription::Kind;

std::shared_ptr<const IdealMotion> commanded_of(const Mechanism& mechanism) {
  return std::make_shared<const IdealMotion>(ideal_motion(mechanism, mechanism.parameters()));
}

// Position and orientation errors of a sample's built mechanism without clearance, exactly, at 201 instants.
struct Course {
  Statistics position, orientation;
};
Course exact_course(const std::shared_ptr<const Mechanism>& mechanism, const Parameters& sample) {
  const auto commanded = commanded_of(*mechanism);
  const BuiltMotion built = built_motion(mechanism, commanded, sample);
  StatisticsOverTime position, orientation;
  for (int i = 0; i <= 200; ++i) {
    const double t = mechanism->duration() * i / 200.0;
    const int b = mechanism->boresight_body();
    const BodyMotion is = built.motion->body(t, b), should = commanded->body(t, b);
    const PoseError error = pose_error({is.p, Quat(is.R)}, {should.p, Quat(should.R)}, mechanism->pointing());
    position.add(t, error.position);
    orientation.add(t, error.orientation);
  }
  return {position.result(), orientation.result()};
}

MechanismDescription without_play() {
  MechanismDescription m = scenes::rrcpr();
  m.clearances.clear();
  return m;
}

// Design page "Every source of pointing error", section 1: an independent program's loop closure of the default mechanism, printed to seven
// digits, its maxima and means over 201 instants from 0 to 1 s (found out here: maxima of a finer grid are up to 6e-6 larger).
TEST(StandingErrors, ArePrintedByAnIndependentProgramToSevenDigits) {
  struct Row {
    ErrorDescription error;
    double value, position_max, position_rms, orientation_max, orientation_rms;
  };
  const MechanismDescription m = without_play();
  const Row rows[] = {
      {frame_error(m, Kind::translation, "F1", "platform", Vec3::UnitX()), 0.05e-3, 3.480153e-5, 3.371288e-5, 0.0, 0.0},
      {drive_error(m, "A3", "1"), 0.1e-3, 7.718742e-5, 7.079130e-5, 1.041764e-4, 1.022173e-4},
      {drive_error(m, "P2", "1"), 20e-6, 3.881242e-5, 3.754843e-5, 0.0, 0.0},
      {drive_error(m, "P1", "q"), 1e-4, 1.146803e-5, 6.756977e-6, 0.0, 0.0}};
  for (const Row& row : rows) {
    MechanismDescription with = m;
    with.errors.push_back(row.error);
    with.errors.back().value = row.value;
    const auto mechanism = scenes::build(with);
    const Course course = exact_course(mechanism, mechanism->parameters());
    EXPECT_NEAR(course.position.max, row.position_max, 1e-6 * row.position_max) << row.error.name;
    EXPECT_NEAR(course.position.rms, row.position_rms, 1e-6 * row.position_rms) << row.error.name;
    EXPECT_NEAR(course.orientation.max, row.orientation_max, 1e-6 * row.orientation_max + 1e-12) << row.error.name;
    EXPECT_NEAR(course.orientation.rms, row.orientation_rms, 1e-6 * row.orientation_rms + 1e-12) << row.error.name;
    // The linear rungs, to what they state.
    for (const char* name : {"envelope", "quasistatic", "perturbation", "multibody"}) {
      RunOptions options;
      options.sample_spacing = 0.0;
      const RunResult result = make_rung(name, mechanism)->run(mechanism->parameters(), options);
      EXPECT_NEAR(result.index.position_error.rms, row.position_rms,
                  (1e-6 + 1.5 * result.error.model_of(PointingQuantity::position_error)) * row.position_rms)
          << name;
      EXPECT_NEAR(
          result.index.orientation_error.rms, row.orientation_rms,
          (1e-6 + 1.5 * result.error.model_of(PointingQuantity::orientation_error)) * row.orientation_rms + 1e-12)
          << name;
      EXPECT_LT(result.error.largest_model(), 2e-4) << name;
    }
  }
}

// The linear columns against differences of the exact closure (fourth order), at some instants.
struct Count {
  int compared = 0, strained = 0, bent = 0;
};
void compare_influence(const std::string& name, const MechanismDescription& description, Count& count) {
  const auto mechanism = scenes::build(with_every_error(description));
  const auto commanded = commanded_of(*mechanism);
  const double length = mechanism->characteristic_length();
  for (int e = 0; e < static_cast<int>(mechanism->description().errors.size()); ++e) {
    const ErrorDescription& error = mechanism->description().errors[e];
    const double step = error.kind == Kind::expansion ? 100.0 : error.kind == Kind::translation ? 1e-3 * length : 1e-3;
    std::vector<bool> wanted(mechanism->description().errors.size(), false);
    wanted[e] = true;
    ErrorInfluence influence(*mechanism, *commanded);
    MatX G;
    bool strains = false;
    try {
      influence.at(0.3 * mechanism->duration(), wanted, G);
    } catch (const ComputationError& refusal) {
      strains = true;
      EXPECT_NE(std::string(refusal.what()).find(error.name), std::string::npos) << refusal.what();
    }
    // Bodies of the built mechanism at t, exactly.
    const auto at = [&](double steps, double t) {
      Parameters p = mechanism->parameters();
      p.error[e] = steps * step;
      const auto built = built_mechanism(*mechanism, p, commanded);
      IdealState state;
      commanded->state(t, state);
      if (!IdealSolver(*built).solve(t, state)) throw ComputationError("does not close");
      return state.bodies;
    };
    if (strains) {
      ++count.strained;
      EXPECT_THROW(at(1.0, 0.3 * mechanism->duration()), ComputationError) << name << ", " << error.name;
      continue;
    }
    constexpr double places[] = {-2.0, -1.0, 1.0, 2.0}, weights[] = {1.0 / 12.0, -8.0 / 12.0, 8.0 / 12.0, -1.0 / 12.0};
    for (const double share : {0.0, 0.3, 0.77}) {
      const double t = share * mechanism->duration();
      influence.at(t, wanted, G);
      std::vector<BodyMotion> bodies[4];
      try {
        for (int k = 0; k < 4; ++k) bodies[k] = at(places[k], t);
      } catch (const ComputationError&) {
        // What closes to first order strains to second.
        ++count.bent;
        continue;
      }
      double worst = 0.0, largest = 0.0;
      for (int b = 0; b < mechanism->bodies(); ++b) {
        const Mat3 R = commanded->body(t, b).R;
        Vec6 difference = Vec6::Zero();
        for (int k = 0; k < 4; ++k) {
          const Eigen::AngleAxisd turn(bodies[k][b].R * R.transpose());
          difference.head<3>() += weights[k] / step * bodies[k][b].p;
          difference.tail<3>() += weights[k] / step * turn.angle() * turn.axis();
        }
        Vec6 scale;
        scale << Vec3::Constant(1.0 / length), Vec3::Ones();
        const Vec6 column = G.block<6, 1>(6 * b, e);
        worst = std::max(worst, scale.cwiseProduct(difference - column).cwiseAbs().maxCoeff());
        largest = std::max(largest, scale.cwiseProduct(column).cwiseAbs().maxCoeff());
      }
      // Rounding of a joint's closure (1e-13 of the lengths) over the step, and the differences' own fourth order.
      EXPECT_LE(worst, 1e-6 * largest + 1e-9 / step) << name << ", " << error.name << " at " << t;
      ++count.compared;
    }
  }
}

TEST(StandingErrors, MoveEveryBodyOfEveryKindOfJointAsTheirColumnsSay) {
  Count count;
  compare_influence("default", without_play(), count);
  EXPECT_EQ(count.strained + count.bent, 0);
  for (const char* file : {"hexapod-6-ups", "universal-joint-shaft", "tip-tilt-mirror", "spherical-wrist", "lens-focus",
                           "planar-3-rrr", "two-axis-gimbal", "delta"}) {
    MechanismDescription m = read_mechanism(std::string(BORESIGHT_CORPUS) + "/" + file + ".toml");
    m.clearances.clear();
    const Mechanism drawn(m);
    if (!is_kinematic(drawn)) continue;
    compare_influence(file, m, count);
  }
  EXPECT_GT(count.compared, 2000);
  EXPECT_GT(count.strained, 50);
  EXPECT_LT(count.bent, count.compared / 20);
}

// A rod longer by d carries the platform to where its drive longer by d does; and the other way round with the other sign.
TEST(StandingErrors, OfARodsLengthAreThoseOfItsDrive) {
  MechanismDescription m = without_play();
  const auto point = [&](const std::string& name) {
    for (const JointDescription& j : m.joints)
      if (j.name == name) return j.point;
    return Vec3(Vec3::Zero());
  };
  const Vec3 along = (point("F1") - point("P1")).normalized();
  m.errors.push_back(frame_error(m, Kind::translation, "F1", "rod1", along));
  m.errors.push_back(drive_error(m, "P1", "1"));
  const auto mechanism = scenes::build(m);
  const auto commanded = commanded_of(*mechanism);
  Parameters longer = mechanism->parameters(), driven = longer, both = longer;
  longer.error[0] = driven.error[1] = both.error[0] = 1e-3;
  both.error[1] = -1e-3;
  const int b = mechanism->boresight_body();
  const BuiltMotion by_length = built_motion(mechanism, commanded, longer),
                    by_drive = built_motion(mechanism, commanded, driven),
                    neither = built_motion(mechanism, commanded, both);
  for (const double t : {0.0, 0.2, 0.6, 1.0}) {
    const BodyMotion x = by_length.motion->body(t, b), y = by_drive.motion->body(t, b), z = neither.motion->body(t, b),
                     ideal = commanded->body(t, b);
    EXPECT_GT((x.p - ideal.p).norm(), 5e-4);
    EXPECT_LT((x.p - y.p).norm(), 1e-12);
    EXPECT_LT((x.R - y.R).norm(), 1e-12);
    EXPECT_LT((z.p - ideal.p).norm(), 1e-12);
  }
}

// With play and errors together, the linear rung follows the exact one.
TEST(StandingErrors, StandBesidePlayOnEveryRung) {
  MechanismDescription m = scenes::rrcpr({{"motion.duration", "0.2 s"}});
  m.errors.push_back(drive_error(m, "A3", "1"));
  m.errors.back().value = 0.1e-3;
  m.errors.push_back(frame_error(m, Kind::rotation, "B2", "carriage2", Vec3(0.6, 0.0, 0.8)));
  m.errors.back().value = 0.2e-3;
  const auto mechanism = scenes::build(m);
  RunOptions options;
  options.sample_spacing = 0.0;
  options.step = 1e-5;
  const PointingIndices linear = make_rung("perturbation", mechanism)->run(mechanism->parameters(), options).index;
  Parameters drawn = mechanism->parameters();
  drawn.error = {0.0, 0.0};
  const PointingIndices play = make_rung("perturbation", mechanism)->run(drawn, options).index;
  for (const char* formulation : {"tree", "paper"}) {
    RunOptions exactly = options;
    exactly.formulation = formulation;
    const PointingIndices exact = make_rung("multibody", mechanism)->run(mechanism->parameters(), exactly).index;
    EXPECT_NEAR(linear.position_error.rms, exact.position_error.rms, 2e-4 * exact.position_error.rms);
    EXPECT_NEAR(linear.position_error.max, exact.position_error.max, 1e-3 * exact.position_error.max);
    EXPECT_NEAR(linear.orientation_error.rms, exact.orientation_error.rms, 1e-4 * exact.orientation_error.rms);
  }
  EXPECT_GT(std::abs(linear.position_error.rms - play.position_error.rms), 0.1 * play.position_error.rms);
  EXPECT_LT(play.orientation_error.rms, 1e-9);
}

// A shaft in two bearings, both with play: the seat of one sits higher than drawn. That uses up play, and the shaft lies askew by the height
// over the span, on multibody, whose built geometry has no pose in which all four bearings are concentric, as on the linear rung.
TEST(StandingErrors, OfABearingsSeatTiltTheShaftWithinTheirPlay) {
  for (const JournalAxes axes : {JournalAxes::free, JournalAxes::parallel}) {
    MechanismDescription m = scenes::gimbal({"A1", "A2", "E1", "E2"}, axes);
    m.errors.push_back(frame_error(m, Kind::translation, "E2", "yoke", Vec3::UnitZ()));
    const auto mechanism = scenes::build(m);
    RunOptions options;
    options.sample_spacing = 0.0;
    double drawn = 0.0, drawn_at_rest = 0.0;
    for (const double height : {0.0, 0.02e-3, 0.06e-3}) {
      Parameters sample = mechanism->parameters();
      sample.error[0] = height;
      const RunResult linear = make_rung("perturbation", mechanism)->run(sample, options);
      const RunResult exact = make_rung("multibody", mechanism)->run(sample, options);
      const double position = exact.index.position_error.rms, turn = exact.index.orientation_error.rms;
      EXPECT_TRUE(linear.warnings.empty() && exact.warnings.empty());
      if (axes == JournalAxes::parallel) {
        EXPECT_LT(linear.error.largest_model(), 1e-5) << height;
        EXPECT_NEAR(linear.index.position_error.rms, position, 1e-5 * position) << height;
      } else {
        EXPECT_LT(linear.error.largest_model(), 0.2) << height;
        EXPECT_NEAR(linear.index.position_error.rms, position,
                    linear.error.model_of(PointingQuantity::position_error) * position)
            << height;
        EXPECT_NEAR(linear.index.orientation_error.rms, turn,
                    linear.error.model_of(PointingQuantity::orientation_error) * turn)
            << height;
      }
      if (height == 0.0)
        drawn = position;
      else
        EXPECT_GT(std::abs(position - drawn), 0.15 * height);
      const RunResult resting = make_rung("quasistatic", mechanism)->run(sample, options);
      EXPECT_NEAR(resting.index.position_error.rms, position,
                  resting.error.model_of(PointingQuantity::position_error) * position)
          << height;
      if (axes == JournalAxes::parallel) {
        if (height == 0.0) drawn_at_rest = resting.index.position_error.rms;
        EXPECT_NEAR(resting.index.position_error.rms - drawn_at_rest, position - drawn, 0.06 * height);
        EXPECT_LT(resting.error.largest_model(), 0.1) << height;
      }
      const RunResult bound = make_rung("envelope", mechanism)->run(sample, options);
      EXPECT_GT(bound.index.position_error.max, exact.index.position_error.max) << height;
    }
  }
}

}  // namespace standing_errors_test
}  // namespace boresight
