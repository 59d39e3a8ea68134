#include "boresight/contact_events/contact_report.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/contact/hertz.hpp"
#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/math/dense_solves.hpp"
#include "boresight/math/eigenvalues.hpp"
#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/offset_layout.hpp"

namespace boresight {
namespace {

// Share of what an offset would give way by if its two bodies were free, below which it cannot move: other joints hold it, and
// rounding leaves 1e-12.
constexpr double kHeld = 1e-9;

// The offset compliances and the ideal joints' reactions along the motion. The reaction on each journal is what the ideal
// joint supplies: the offset's acceleration without it, divided by the compliance. Where joints share a load, the least that
// they can share, as SharedReactions has it; where an offset cannot move, none: what holds it carries the load.
struct Size {
  double rms = 0.0, max = 0.0;

  void add(double load, int samples) {
    rms = std::hypot(rms, load / std::sqrt(samples));
    max = std::max(max, load);
  }
};
struct LoadSizes {
  Size whole, radial, axial;  // [N]
};
struct AlongMotion {
  std::vector<MatX> compliance;  // instant by instant
  std::vector<LoadSizes> load;   // per clearance
};

// The loads that a joint's contacts carry: the force, and on a tilting journal what its couple asks of the ends.
void add_loads(const VecX& reaction, const OffsetLayout::Joint& at, const JointPlay& joint, int samples,
               LoadSizes& sizes) {
  const Vec3 force = reaction.segment<3>(at.first);
  const double of_couple = at.tilts ? reaction.segment(at.first + 3, at.count() - 3).norm() / joint.lever() : 0.0;
  const double axial = joint.axial_stiffness() > 0.0 ? std::abs(force.y()) : 0.0;
  sizes.whole.add(force.norm() + of_couple, samples);
  sizes.axial.add(axial, samples);
  sizes.radial.add((axial > 0.0 ? std::hypot(force.x(), force.z()) : force.norm()) + of_couple, samples);
}

// Of each body as if it were free: what a unit wrench about its own centre of mass accelerates.
std::vector<Mat6> free_mobility(const Mechanism& mechanism, const Parameters& parameters,
                                const std::vector<BodyMotion>& bodies) {
  std::vector<Mat6> result;
  const std::vector<MassProperties> mass = mechanism.mass_properties(parameters);
  for (std::size_t b = 0; b < mass.size(); ++b) {
    Mat6 W = Mat6::Zero();
    W.topLeftCorner<3, 3>() = Mat3::Identity() / mass[b].mass;
    W.bottomRightCorner<3, 3>() = bodies[b].R * mass[b].inertia.inverse() * bodies[b].R.transpose();
    result.push_back(W);
  }
  return result;
}

// What joints carry that do not let their offsets accelerate, and the compliance as far as it is more than rounding.
struct Carried {
  VecX reaction;
  MatX compliance;
};

// A: compliance of the offsets; free: the same of each were its bodies free; over_levers: what makes their reactions forces. Offsets that
// cannot move are left out before any load is shared: a share of nothing among them is rounding, and no load may be hung on it.
Carried carried_by(const MatX& A, const VecX& offset, const VecX& free, const VecX& over_levers) {
  Carried result{VecX::Zero(A.rows()), MatX::Zero(A.rows(), A.cols())};
  std::vector<Eigen::Index> moves;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    if (A(i, i) > kHeld * free[i]) moves.push_back(i);
  if (moves.empty()) return result;
  const VecX root = free(moves).cwiseSqrt(), scale = root.cwiseInverse();
  const MatX of_moves = A(moves, moves);
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(scale.asDiagonal() * (0.5 * (of_moves + of_moves.transpose())) *
                                                  scale.asDiagonal());
  const VecX kept = eigen.eigenvalues().unaryExpr([](double x) { return x > kHeld ? x : 0.0; });
  const VecX weight = kept.unaryExpr([](double x) { return x > 0.0 ? 1.0 / x : 0.0; });
  const MatX& V = eigen.eigenvectors();
  VecX reaction =
      scale.asDiagonal() * (V * (weight.asDiagonal() * (V.transpose() * VecX(scale.asDiagonal() * offset(moves)))));
  // What may be shared in other ways: of them all the least, as forces.
  if (const MatX shared = scale.asDiagonal() * V.leftCols((kept.array() == 0.0).count()); shared.cols() > 0) {
    const VecX forces = over_levers(moves);
    reaction -= shared * solve_least(MatX(forces.asDiagonal() * shared), VecX(forces.cwiseProduct(reaction)), kHeld);
  }
  result.reaction(moves) = reaction;
  result.compliance(moves, moves) = root.asDiagonal() * V * kept.asDiagonal() * V.transpose() * root.asDiagonal();
  return result;
}

AlongMotion follow(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal, int samples) {
  const auto formulation = make_tree_formulation(mechanism, parameters, &ideal, {});
  const ForceElements& forces = formulation->forces();
  const OffsetLayout layout(mechanism);
  const int n = forces.clearances();
  std::vector<JointPlay> joints;
  // Couples count as the forces at the ends of the sleeves that they are: a pair of bearings far apart takes next to none.
  VecX over_levers = VecX::Ones(layout.size());
  for (int c = 0; c < n; ++c) {
    joints.push_back(forces.joint(c));
    const OffsetLayout::Joint& at = layout.joint(c);
    if (at.tilts) over_levers.segment(at.first + 3, at.count() - 3).setConstant(1.0 / joints[c].lever());
  }
  std::vector<ContactMemory> memory(n);
  AlongMotion along;
  along.load.resize(n);
  VecX y, dy;
  for (int i = 0; i < samples; ++i) {
    work_reached("weighing contacts along the motion", static_cast<double>(i) / samples);
    IdealState state;
    ideal.state(mechanism.duration() * i / (samples - 1), state);
    formulation->start(state, y);
    dy.resize(y.size());
    formulation->derivative(state.t, y, memory, dy);
    const MatX A = formulation->offset_compliance();
    // Offset accelerations of the opened mechanism, seen from the sleeves; slopes' likewise.
    VecX offset = VecX::Zero(layout.size()), free = VecX::Ones(layout.size());
    const std::vector<BodyAcceleration>& a = formulation->acceleration();
    const std::vector<Mat6> W = free_mobility(mechanism, parameters, state.bodies);
    for (int c = 0; c < n; ++c) {
      const ClearanceDescription& d = mechanism.description().clearances[c];
      const JointConstraint released(mechanism, d.joint, ClearanceRows::released, false);
      JointRows rows;
      released.evaluate(state.bodies, {}, rows);
      Vec6 acceleration = -rows.gamma, mobility = Vec6::Zero();
      if (const int b = released.reference_body(); b != kGround) {
        acceleration += rows.reference * a[b];
        mobility += (rows.reference * W[b] * rows.reference.transpose()).diagonal();
      }
      if (const int b = released.other_body(); b != kGround) {
        acceleration += rows.other * a[b];
        mobility += (rows.other * W[b] * rows.other.transpose()).diagonal();
      }
      const OffsetLayout::Joint& at = layout.joint(c);
      for (int k = 0; k < at.count(); ++k)
        if (at.released(k)) {
          offset[at.first + k] = acceleration[at.released_row(k)];
          free[at.first + k] = mobility[at.released_row(k)];
        }
    }
    const Carried carried = carried_by(A, offset, free, over_levers);
    const VecX& reaction = carried.reaction;
    along.compliance.push_back(carried.compliance);
    for (int c = 0; c < n; ++c) add_loads(reaction, layout.joint(c), joints[c], samples, along.load[c]);
  }
  return along;
}

}  // namespace

std::vector<ContactFrequency> analyse_contacts(const Mechanism& mechanism, const Parameters& parameters) {
  if (mechanism.clearances() == 0) return {};
  return analyse_contacts(mechanism, parameters, ideal_motion(mechanism, parameters));
}

std::vector<ContactFrequency> analyse_contacts(const Mechanism& mechanism, const Parameters& parameters,
                                               const IdealMotion& ideal) {
  std::vector<ContactFrequency> result;
  if (mechanism.clearances() == 0) return result;
  // A long motion has more to see.
  constexpr int kInstants = 41, kMostInstants = 401, kKnotsOfInstant = 100;
  const AlongMotion along =
      follow(mechanism, parameters, ideal, std::clamp(ideal.knots() / kKnotsOfInstant, kInstants, kMostInstants));
  const MechanismDescription& m = mechanism.description();
  const int n = mechanism.clearances();

  // Tangent stiffness of each joint at the deepest penetration foreseen: twice the largest ideal reaction, what a load
  // suddenly applied to an elastic contact reaches. All joints together bound the frequency of each.
  const OffsetLayout layout(mechanism);
  VecX root_stiffness = VecX::Zero(layout.size());
  const std::vector<JointPlay> laws = joint_plays(m, parameters);
  for (int c = 0; c < n; ++c) {
    const OffsetLayout::Joint& at = layout.joint(c);
    const JointPlay& law = laws[c];
    ContactFrequency f;
    f.joint = m.joints[m.clearances[c].joint].name;
    f.hertz_stiffness = law.normal_law().curve == ElasticCurve::point ? law.normal_law().stiffness : 0.0;
    f.axial_stiffness = law.axial_stiffness();
    const LoadSizes& load = along.load[c];
    f.typical_load = load.whole.rms;
    f.typical_axial_load = load.axial.rms;
    f.largest_axial_load = load.axial.max;
    f.typical_radial_load = load.radial.rms;
    f.largest_radial_load = load.radial.max;
    f.typical_penetration = law.normal_law().depth_under(f.typical_radial_load);
    if (f.axial_stiffness > 0.0)
      f.typical_penetration = std::max(f.typical_penetration, f.typical_axial_load / f.axial_stiffness);
    f.validity_speed = law.validity_speed;
    double largest = 0.0;
    for (const MatX& A : along.compliance)
      largest = std::max(largest,
                         Eigen::SelfAdjointEigenSolver<Mat3>(Mat3(A.block<3, 3>(at.first, at.first))).eigenvalues()[2]);
    f.effective_mass = largest > 0.0 ? 1.0 / largest : 0.0;
    f.largest_load = load.whole.max;
    root_stiffness.segment(at.first, at.count()) = law.root_stiffness(f.largest_load).head(at.count());
    result.push_back(f);
  }
  for (const MatX& A : along.compliance) {
    const MatX B = root_stiffness.asDiagonal() * A * root_stiffness.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<MatX> eigen(0.5 * (B + B.transpose()));
    for (int c = 0; c < n; ++c) {
      const OffsetLayout::Joint& at = layout.joint(c);
      // The fastest vibration in which this joint has a part worth naming (a tenth of the largest).
      for (Eigen::Index k = layout.size() - 1; k >= 0 && eigen.eigenvalues()[k] > 0.0; --k) {
        const VecX mode = eigen.eigenvectors().col(k).cwiseAbs();
        if (mode.segment(at.first, at.count()).maxCoeff() < 0.1 * mode.maxCoeff()) continue;
        result[c].angular_frequency = std::max(result[c].angular_frequency, std::sqrt(eigen.eigenvalues()[k]));
        break;
      }
    }
  }
  for (ContactFrequency& f : result)
    if (f.angular_frequency > 0.0) f.largest_stable_step = classical_rk4().real_limit / f.angular_frequency;
  return result;
}

}  // namespace boresight
