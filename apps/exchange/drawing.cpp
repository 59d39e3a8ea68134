#include "exchange/drawing.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "boresight/mechanism/error.hpp"

namespace boresight::app {

Mat3 turned_by(const Vec3& roll_pitch_yaw) {
  using Eigen::AngleAxisd;
  return (AngleAxisd(roll_pitch_yaw.z(), Vec3::UnitZ()) * AngleAxisd(roll_pitch_yaw.y(), Vec3::UnitY()) *
          AngleAxisd(roll_pitch_yaw.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

Mat3 turned_by(double w, double x, double y, double z) { return Quat(w, x, y, z).normalized().toRotationMatrix(); }

int part_named(const Drawing& drawing, const std::string& name) {
  for (std::size_t i = 0; i < drawing.parts.size(); ++i)
    if (drawing.parts[i].name == name) return static_cast<int>(i);
  return -1;
}

void set_mass(Part& part, double mass, const Placement& X_PC, const Mat3& inertia_C, const Origin& origin) {
  if (!(mass >= 0.0))
    throw InputError(origin, part.name + ": mass", fmt::format("{} kg", mass), "a mass of zero or more");
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(inertia_C, Eigen::EigenvaluesOnly).eigenvalues();
  const double size = principal.cwiseAbs().maxCoeff();
  const auto in_words = [&] {
    return fmt::format("principal moments {:.6g}, {:.6g} and {:.6g} kg m^2", principal[0], principal[1], principal[2]);
  };
  if (principal[0] < -1e-9 * size)
    throw InputError(origin, part.name + ": inertia", in_words(), "moments that are not negative");
  // Of files that round to few digits, the sum may be short by a rounding.
  if (principal[0] + principal[1] < principal[2] * (1.0 - 1e-2))
    throw InputError(origin, part.name + ": inertia", in_words(),
                     "moments that a real body can have: none larger than the sum of the other two");
  const Placement X_WC = part.X_WP * X_PC;
  part.mass = mass;
  part.p_WC = X_WC.p;
  part.inertia = X_WC.R * inertia_C * X_WC.R.transpose();
}

}  // namespace boresight::app
