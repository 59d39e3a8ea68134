#include "exchange/shown_shapes.hpp"

#include "exchange/writers.hpp"

namespace boresight::app {

std::vector<Bar> bars_of(const Mechanism& mechanism, int body) {
  const MechanismDescription& m = mechanism.description();
  const BodyDescription& b = m.bodies[body];
  std::vector<Bar> bars;
  const double least = 1e-3 * mechanism.characteristic_length();
  for (const JointDescription& joint : m.joints) {
    if (joint.first != body && joint.second != body) continue;
    const Vec3 to = b.axes.transpose() * (joint.point - b.center_of_mass);
    if (to.norm() > least) bars.push_back({Vec3::Zero(), to});
  }
  if (b.boresight)
    bars.push_back({Vec3::Zero(), b.axes.transpose() * *b.boresight * 0.5 * mechanism.characteristic_length(), true});
  return bars;
}

double bar_radius(const Mechanism& mechanism) { return 0.015 * mechanism.characteristic_length(); }

std::vector<std::string> not_written(const Mechanism& mechanism, bool with_springs) {
  const MechanismDescription& m = mechanism.description();
  std::vector<std::string> lines = {"the motion: drives stand at home"};
  if (!m.clearances.empty()) lines.push_back("play: joints are ideal");
  if (!m.errors.empty()) lines.push_back("errors: the mechanism is as drawn");
  if (!m.loads.empty()) lines.push_back("loads");
  if (!m.springs.empty() && !with_springs) lines.push_back("springs");
  if (!m.initial_rates.empty()) lines.push_back("starting rates");
  return lines;
}

double between_mass(const Mechanism& mechanism) {
  double least = mechanism.description().bodies.front().mass;
  for (const BodyDescription& body : mechanism.description().bodies) least = std::min(least, body.mass);
  return kBetweenMass * least;
}

}  // namespace boresight::app
