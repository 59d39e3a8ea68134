#include "boresight/contact_events/stiffest_contact.hpp"

#include <cmath>

#include "boresight/math/eigenvalues.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {

StiffestContact stiffest_contact(const OffsetLayout& layout, const std::vector<JointPlay>& joints,
                                 const std::vector<PlayMotion<double>>& motion, const Eigen::Ref<const MatX>& A) {
  struct Touch {
    int clearance;
    ContactPlace place;
    PlayOffsets n;
  };
  std::vector<Touch> touches;
  for (int c = 0; c < layout.clearances(); ++c) {
    const ContactTangent tangent = joints[c].tangent(motion[c]);
    for (int k = 0; k < tangent.count; ++k) touches.push_back({c, tangent.column[k].place, tangent.column[k].n});
  }
  const Eigen::Index n = static_cast<Eigen::Index>(touches.size());
  if (n == 0) return {};
  MatX B(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const OffsetLayout::Joint &a = layout.joint(touches[i].clearance), &b = layout.joint(touches[j].clearance);
      B(i, j) = touches[i].n.head(a.count()).dot(A.block(a.first, b.first, a.count(), b.count()) *
                                                 touches[j].n.head(b.count()));
    }
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(0.5 * (B + B.transpose()));
  Eigen::Index share;
  eigen.eigenvectors().col(n - 1).cwiseAbs().maxCoeff(&share);
  return {std::sqrt(std::max(0.0, eigen.eigenvalues()[n - 1])), touches[share].clearance, touches[share].place};
}

double stiffest_contact_bound(const OffsetLayout& layout, const std::vector<JointPlay>& joints,
                              const std::vector<PlayMotion<double>>& motion, const Eigen::Ref<const MatX>& A) {
  double sum = 0.0;
  for (int c = 0; c < layout.clearances(); ++c) {
    const ContactTangent tangent = joints[c].tangent(motion[c]);
    const OffsetLayout::Joint& at = layout.joint(c);
    const int count = at.count();
    for (int k = 0; k < tangent.count; ++k) {
      const auto& n = tangent.column[k].n;
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) sum += n[i] * A(at.first + i, at.first + j) * n[j];
    }
  }
  return sum;
}

}  // namespace boresight
