#include "check/unlikely_masses.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "terminal/readable.hpp"

namespace boresight::app {
namespace {

// Axes that nearly meet draw a large body small, and gears before it make it heavier to turn; a bob on an arm turns easily. Square millimetres
// in place of square metres are a thousand times off. Less than a hundred thousandth is a point mass, meant as one.
constexpr double kTooFarOut = 30.0, kTooFarIn = 1.0 / 300.0, kPoint = 1e-5;

}  // namespace

std::vector<std::string> unlikely_inertias(const Mechanism& mechanism) {
  const MechanismDescription& m = mechanism.description();
  std::vector<std::string> sentences;
  for (std::size_t b = 0; b < m.bodies.size(); ++b) {
    const BodyDescription& body = m.bodies[b];
    if (!(body.mass > 0.0)) continue;
    const double largest =
        Eigen::SelfAdjointEigenSolver<Mat3>(body.inertia, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
    const double radius = std::sqrt(std::max(largest, 0.0) / body.mass);
    double reach = 0.0;
    for (const JointDescription& joint : m.joints)
      if (joint.first == static_cast<int>(b) || joint.second == static_cast<int>(b))
        reach = std::max(reach, (joint.point - body.center_of_mass).norm());
    const bool far_out = radius > kTooFarOut * std::max(reach, mechanism.characteristic_length());
    if (!far_out && !(radius < kTooFarIn * reach && radius > kPoint * reach)) continue;
    sentences.push_back(fmt::format(
        "the inertia of \"{}\", {}, with its mass of {} is that of a body with a radius of gyration of {}, {}; "
        "look at its unit",
        body.name, readable(largest, "kg m^2"), readable(body.mass, "kg"), readable(radius, "m"),
        far_out ? "in a mechanism of " + readable(mechanism.characteristic_length(), "m")
                : "with joints up to " + readable(reach, "m") + " from its centre of mass"));
  }
  return sentences;
}

}  // namespace boresight::app
