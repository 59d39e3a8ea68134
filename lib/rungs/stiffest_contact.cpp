#include "boresight/rungs/stiffest_contact.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace boresight {

StiffestContact stiffest_contact(const std::vector<JournalInSleeve>& joints,
                                 const std::vector<JournalMotion<double>>& motion,
                                 const MatX& A) {
  struct Touch {
    int clearance;
    ContactPlace place;
    Vec3 scaled_normal;  // sqrt(tangent stiffness) times the unit normal
  };
  std::vector<Touch> touches;
  for (int c = 0; c < static_cast<int>(joints.size()); ++c) {
    const JournalInSleeve& joint = joints[c];
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

double stiffest_contact_bound(const std::vector<JournalInSleeve>& joints, const std::vector<JournalMotion<double>>& motion,
                              const Eigen::Ref<const MatX>& A) {
  double sum = 0.0;
  for (int c = 0; c < static_cast<int>(joints.size()); ++c) {
    const JournalInSleeve& joint = joints[c];
    const Vec3& e = motion[c].e;
    const double square = e.x() * e.x() + e.z() * e.z();
    if (square > joint.radial_clearance * joint.radial_clearance) {
      const double depth = std::sqrt(square) - joint.radial_clearance;
      // n^T A n is at most the sum of the two diagonal entries across the axis.
      sum += 1.5 * joint.radial_law.stiffness * std::sqrt(depth) * (A(3 * c, 3 * c) + A(3 * c + 2, 3 * c + 2));
    }
    if (joint.has_faces && std::abs(e.y()) > joint.axial_clearance) sum += joint.face_stiffness * A(3 * c + 1, 3 * c + 1);
  }
  return sum;
}

}  // namespace boresight
