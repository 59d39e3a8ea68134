// What is over within a millisecond of a motion is nobody's to pass over: neither tables nor steps nor samples of lanes.
#include <gtest/gtest.h>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/lanes/perturbation_lanes.hpp"
#include "boresight/mechanism/load_time.hpp"

namespace boresight {
namespace short_event_test {

// A balanced arm in a journal with play, whose drive and load are given.
std::shared_ptr<const Mechanism> arm(const std::string& drive, const std::string& force) {
  const std::string text = R"toml(
format = 1
name = "arm"
gravity = ["0 m/s^2", "0 m/s^2", "-9.81 m/s^2"]
[[body]]
name = "arm"
mass = "2 kg"
center_of_mass = ["0.1 m", "0 m", "0 m"]
inertia = ["2e-3 kg m^2", "8e-3 kg m^2", "8e-3 kg m^2"]
boresight = [1, 0, 0]
[[joint]]
name = "A"
type = "revolute"
connects = ["ground", "arm"]
point = ["0 m", "0 m", "0 m"]
axis = [0, 1, 0]
driven = true
[motion]
duration = "0.6 s"
drives = { A = ")toml" + drive +
                           R"toml(" }
[[load]]
body = "arm"
point = ["0.1 m", "0 m", "0 m"]
force = ["0", "0", ")toml" +
                           force + R"toml("]
[[clearance]]
joint = "A"
journal = "arm"
radial = "0.1 mm"
axial = "0.1 mm"
journal_radius = "10 mm"
cap_radius = "15 mm"
sleeve_length = "30 mm"
axes = "parallel"
  [clearance.contact]
  law = "flores"
  restitution = 0.5
  young = ["72 GPa", "72 GPa"]
  poisson = [0.33, 0.33]
  [clearance.friction]
  coefficient = 0.05
)toml";
  return std::make_shared<const Mechanism>(read_mechanism_text(text, "arm.toml", {}));
}

double largest(const std::string& rung, const std::shared_ptr<const Mechanism>& mechanism,
               const std::string& integrator = "", double step = 0.0) {
  RunOptions options;
  options.step = step;
  options.sample_spacing = 0.0;
  options.integrator = integrator;
  return make_rung(rung, mechanism)->run(mechanism->parameters(), options).index.position_error.max;
}

// Of a sinusoid 2 / omega; of exp(-(t / s)^2) its height over sqrt(2 / e) / s.
TEST(LoadTime, IsTheRangeOverTheLargestRate) {
  EXPECT_NEAR(load_time(*arm("0.1*t", "3*sin(20*t)")), 0.1, 1e-4);
  EXPECT_NEAR(load_time(*arm("0.1*t", "4000*exp(-((t-0.41373)/0.0002)^2)")), 0.0002 / std::sqrt(2.0 / std::exp(1.0)),
              1e-6);
  EXPECT_EQ(load_time(*arm("0.1*t", "5")), std::numeric_limits<double>::infinity());
  EXPECT_EQ(load_time(*arm("0.1*t", "5+1e-9*sin(1e6*t)")), std::numeric_limits<double>::infinity());
}

void expect_seen_by_all(const std::shared_ptr<const Mechanism>& mechanism,
                        const std::shared_ptr<const Mechanism>& without) {
  const double exact = largest("multibody", mechanism, "rk4", 1e-5), calm = largest("multibody", without);
  ASSERT_GT(exact, 1.2 * calm);
  // Steps of a tenth of a millisecond see it, and are off by what they say that they are.
  for (const char* rung : {"multibody", "perturbation"})
    EXPECT_NEAR(largest(rung, mechanism) / exact, 1.0, 0.05) << rung;
  for (const char* integrator : {"dopri5", "rosenbrock"}) {
    EXPECT_NEAR(largest("multibody", mechanism, integrator) / exact, 1.0, 0.03) << integrator;
    EXPECT_NEAR(largest("perturbation", mechanism, integrator) / exact, 1.0, 0.03) << integrator;
  }
  // At rest under the largest load: a deflection, and no rebound.
  EXPECT_GT(largest("quasistatic", mechanism), 1.1 * calm);
  const PerturbationLanes lanes(mechanism, PointingQuantity::position_error);
  const std::vector<Parameters> samples = {mechanism->parameters()};
  std::vector<LaneOutcome> outcomes(1);
  lanes.run(samples, outcomes, kLaneTolerance);
  EXPECT_NEAR(outcomes[0].max / exact, 1.0, 0.03);
}

TEST(ShortEvents, ABlowOfAThirdOfAMillisecondIsSeenByAllRungs) {
  expect_seen_by_all(arm("0.1*sin(2*t)", "4000*exp(-((t-0.41373)/0.0002)^2)"), arm("0.1*sin(2*t)", "0"));
}

TEST(ShortEvents, AJerkOfADriveIsSeenByAllRungs) {
  expect_seen_by_all(arm("0.004*exp(-((t-0.4037)/0.0005)^2)", "0"), arm("0", "0"));
}

}  // namespace short_event_test
}  // namespace boresight
