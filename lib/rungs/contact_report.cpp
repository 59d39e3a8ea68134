#include "boresight/rungs/contact_report.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "boresight/contact/hertz.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/rungs/formulation.hpp"
#include "boresight/rungs/ideal_simulation.hpp"

namespace boresight {
namespace {

// The offset compliance and the ideal joints' reactions along the motion. The reaction on each journal is what the ideal
// joint supplies: the offset's acceleration without it, divided by the compliance.
struct AlongMotion {
  MatX compliance_max;              // the compliance where its trace is largest
  std::vector<double> reaction_rms, reaction_max;  // per clearance [N]
};

AlongMotion follow(const Mechanism& mechanism, const Parameters& parameters, int samples) {
  const IdealMotion ideal = ideal_motion(mechanism, parameters);
  const auto formulation = make_paper_formulation(mechanism, parameters, &ideal, {});
  const ForceElements& forces = formulation->forces();
  const int n = forces.clearances();
  std::vector<ContactMemory> memory(n);
  AlongMotion along;
  along.reaction_rms.assign(n, 0.0);
  along.reaction_max.assign(n, 0.0);
  VecX y, dy;
  for (int i = 0; i < samples; ++i) {
    IdealState state;
    ideal.state(mechanism.duration() * i / (samples - 1), state);
    formulation->start(state, y);
    dy.resize(y.size());
    formulation->derivative(state.t, y, memory, dy);
    const MatX A = formulation->offset_compliance();
    if (along.compliance_max.size() == 0 || A.trace() > along.compliance_max.trace()) along.compliance_max = A;
    // Offset accelerations of the opened mechanism, seen from the sleeves.
    VecX offset(3 * n);
    const std::vector<BodyAcceleration>& a = formulation->acceleration();
    for (int c = 0; c < n; ++c) {
      const ClearanceDescription& d = mechanism.description().clearances[c];
      const JointDescription& joint = mechanism.description().joints[d.joint];
      const JointGeometry& g = mechanism.geometry(d.joint);
      const bool journal_first = d.journal == joint.first;
      const JointFrame &sleeve = journal_first ? g.second : g.first, &journal = journal_first ? g.first : g.second;
      const auto point_acceleration = [&](const JointFrame& f) -> Vec3 {
        if (f.body == kGround) return Vec3::Zero();
        const BodyMotion& b = state.bodies[f.body];
        const Vec3 r = b.R * f.p;
        return a[f.body].head<3>() + a[f.body].tail<3>().cross(r) + b.w.cross(b.w.cross(r));
      };
      const Mat3 R_WS = sleeve.body == kGround ? sleeve.R : Mat3(state.bodies[sleeve.body].R * sleeve.R);
      offset.segment<3>(3 * c) = R_WS.transpose() * (point_acceleration(journal) - point_acceleration(sleeve));
      if (joint.type == JointType::cylindrical) offset[3 * c + 1] = 0.0;
    }
    const VecX reaction = A.completeOrthogonalDecomposition().solve(offset);
    for (int c = 0; c < n; ++c) {
      const double size = reaction.segment<3>(3 * c).norm();
      along.reaction_rms[c] += size * size / samples;
      along.reaction_max[c] = std::max(along.reaction_max[c], size);
    }
  }
  for (double& r : along.reaction_rms) r = std::sqrt(r);
  return along;
}

}  // namespace

std::vector<ContactFrequency> analyse_contacts(const Mechanism& mechanism, const Parameters& parameters) {
  std::vector<ContactFrequency> result;
  if (mechanism.clearances() == 0) return result;
  const AlongMotion along = follow(mechanism, parameters, 41);
  const MechanismDescription& m = mechanism.description();
  const int n = mechanism.clearances();

  // Tangent stiffness of each joint at the deepest penetration foreseen: twice the largest ideal reaction, what a load
  // suddenly applied to an elastic contact reaches. All joints together bound the frequency of each.
  VecX root_stiffness = VecX::Zero(3 * n);
  for (int c = 0; c < n; ++c) {
    const JournalInSleeve law(m.clearances[c], m.joints[m.clearances[c].joint].type, parameters.clearance[c]);
    ContactFrequency f;
    f.joint = m.joints[m.clearances[c].joint].name;
    f.hertz_stiffness = law.radial_law.stiffness;
    f.axial_stiffness = law.face_stiffness;
    f.typical_load = along.reaction_rms[c];
    f.typical_penetration = std::pow(f.typical_load / f.hertz_stiffness, 2.0 / 3.0);
    f.validity_speed = law.validity_speed;
    const Mat3 A = along.compliance_max.block<3, 3>(3 * c, 3 * c);
    const double largest = Eigen::SelfAdjointEigenSolver<Mat3>(A).eigenvalues()[2];
    f.effective_mass = largest > 0.0 ? 1.0 / largest : 0.0;
    const double deepest = std::pow(2.0 * along.reaction_max[c] / f.hertz_stiffness, 2.0 / 3.0);
    const double radial = 1.5 * f.hertz_stiffness * std::sqrt(deepest);
    root_stiffness.segment<3>(3 * c) << std::sqrt(radial), std::sqrt(law.face_stiffness), std::sqrt(radial);
    result.push_back(f);
  }
  const MatX B = root_stiffness.asDiagonal() * along.compliance_max * root_stiffness.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(0.5 * (B + B.transpose()));
  for (int c = 0; c < n; ++c) {
    // The fastest vibration in which this joint has a part worth naming (a tenth of the largest).
    for (Eigen::Index k = 3 * n - 1; k >= 0; --k) {
      const VecX mode = eigen.eigenvectors().col(k).cwiseAbs();
      if (mode.segment<3>(3 * c).maxCoeff() < 0.1 * mode.maxCoeff()) continue;
      result[c].angular_frequency = std::sqrt(std::max(0.0, eigen.eigenvalues()[k]));
      break;
    }
    if (result[c].angular_frequency > 0.0)
      result[c].largest_stable_step = classical_rk4().real_limit / result[c].angular_frequency;
  }
  return result;
}

}  // namespace boresight
