#include "boresight/rungs/stiffest_contact.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace boresight {

StiffestContact stiffest_contact(const ForceElements& forces, const std::vector<JournalMotion<double>>& motion,
                                 const MatX& A) {
  struct Touch {
    int clearance;
    ContactPlace place;
    Vec3 scaled_normal;  // sqrt(tangent stiffness) times the unit normal
  };
  std::vector<Touch> touches;
  for (int c = 0; c < forces.clearances(); ++c) {
    const JournalInSleeve& joint = forces.joint(c);
    std::array<ContactState<double>, kContactPlaces> contact;
    joint.gaps(motion[c], contact);
    const double d = contact[static_cast<int>(ContactPlace::radial)].penetration;
    if (d > 0.0) {
      const Vec3 radial(motion[c].e.x(), 0.0, motion[c].e.z());
      touches.push_back({c, ContactPlace::radial,
                         std::sqrt(1.5 * joint.radial_law.stiffness * std::sqrt(d)) * radial.normalized()});
    }
    for (ContactPlace face : {ContactPlace::axial_minus, ContactPlace::axial_plus})
      if (contact[static_cast<int>(face)].penetration > 0.0)
        touches.push_back({c, face, std::sqrt(joint.face_stiffness) * Vec3::UnitY()});
  }
  const Eigen::Index n = static_cast<Eigen::Index>(touches.size());
  if (n == 0) return {};
  MatX B(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      B(i, j) = touches[i].scaled_normal.dot(A.block<3, 3>(3 * touches[i].clearance, 3 * touches[j].clearance) *
                                             touches[j].scaled_normal);
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(0.5 * (B + B.transpose()));
  Eigen::Index share;
  eigen.eigenvectors().col(n - 1).cwiseAbs().maxCoeff(&share);
  return {std::sqrt(std::max(0.0, eigen.eigenvalues()[n - 1])), touches[share].clearance, touches[share].place};
}

}  // namespace boresight
