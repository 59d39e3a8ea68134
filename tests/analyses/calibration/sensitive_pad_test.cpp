// Derivatives of a tilting pad's motion, carried through its impacts, are those that differences of whole motions give.
#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight/slopes/sensitive_motion.hpp"

namespace boresight {
namespace sensitive_pad_test {

constexpr char kStage[] = R"toml(format = 1
name = "stage"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "stage"
mass = "2 kg"
center_of_mass = ["0 mm", "0 mm", "0 mm"]
inertia = ["0.0025 kg m^2", "0.003 kg m^2", "0.004 kg m^2"]
boresight = [0, 0, 1]
[[joint]]
name = "table"
type = "planar"
connects = ["ground", "stage"]
point = ["0 mm", "0 mm", "0 mm"]
axis = [0, 0, 1]
[motion]
duration = "40 ms"
[[clearance]]
joint = "table"
journal = "stage"
axial = "0.1 mm"
pad_radius = "40 mm"
axes = "free"
  [clearance.contact]
  restitution = 0.7
  stiffness_scale = 0.1
)toml";

TEST(SensitivePad, DerivativesThroughImpactsAreThoseOfRichardsonDifferences) {
  const Mechanism mechanism(read_mechanism_text(kStage, "stage.toml"));
  const PreparedScene prepared(mechanism, ideal_motion(mechanism, mechanism.parameters()), mechanism.parameters());
  const auto tables = prepared.tables(mechanism.parameters());
  const SceneLayout::Joint& pad = tables->layout.joints[0];
  std::vector<ParameterPath> paths;
  std::vector<double> values;
  for (const char* number : {"axial", "pad_radius", "contact.restitution", "contact.stiffness_scale"}) {
    paths.emplace_back(mechanism.description(), std::string("clearance.table.") + number);
    values.push_back(paths.back().get(mechanism.parameters()));
  }
  const auto at = [&](const std::vector<double>& v) {
    Parameters p = mechanism.parameters();
    for (std::size_t k = 0; k < paths.size(); ++k) paths[k].set(p, v[k]);
    return p;
  };
  MotionRequest request;
  request.end = 16e-3;
  request.times = {request.end};
  const int n = tables->layout.n;
  request.start_state = VecX::Zero(2 * n);
  // Tilted, and thrown down: it strikes with its rim, then with the other side of it.
  request.start_state[pad.source[1]] = 1e-5;
  request.start_state[pad.source[3]] = 2e-4;
  request.start_state[pad.source[4]] = -1e-4;
  request.start_state[n + pad.source[1]] = -0.03;
  request.tolerance = request.derivative_tolerance = 1e-13;
  const auto follow = [&](const std::vector<double>& v, bool derivatives) {
    MotionRequest r = request;
    r.by_parameters = derivatives;
    return follow_with_sensitivity(mechanism, at(v), tables, contact_numbers(mechanism, at, v), r);
  };
  const SensitiveMotion motion = follow(values, true);
  ASSERT_GE(motion.impact_speed.size(), 2u);
  ASSERT_TRUE(motion.grazing.empty());
  // Speeds count by the length of the motion.
  VecX unit = VecX::Ones(2 * n);
  unit.tail(n).setConstant(request.end);
  for (std::size_t d = 0; d < paths.size(); ++d) {
    const auto moved = [&](double share) {
      std::vector<double> v = values;
      v[d] *= 1.0 + share;
      return VecX(follow(v, false).state.col(0));
    };
    const auto central = [&](double h) { return VecX((moved(h) - moved(-h)) / (2.0 * h * values[d])); };
    const VecX exact = unit.cwiseProduct(motion.by[0].col(static_cast<Eigen::Index>(d)));
    double least = 1.0;
    for (const double h : {1e-3, 5e-4, 2e-4}) {
      const VecX difference = unit.cwiseProduct(VecX((4.0 * central(0.5 * h) - central(h)) / 3.0)) - exact;
      least = std::min(least, difference.norm() / exact.norm());
    }
    EXPECT_LT(least, 1e-5) << paths[d].path();
  }
}

}  // namespace sensitive_pad_test
}  // namespace boresight
