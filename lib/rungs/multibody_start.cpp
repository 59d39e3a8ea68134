#include "boresight/rungs/multibody_start.hpp"

#include <limits>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/clearance_scene.hpp"
#include "boresight/rungs/resting_start.hpp"

namespace boresight {
namespace {

// Steps of the journals, over their clearances: shorter ones are rounding.
constexpr double kRounding = 1e-12;
constexpr int kMostSteps = 40;
// A step this many times the shortest leads away.
constexpr double kAstray = 100.0;

std::vector<BodyMotion> displaced_bodies(const ClearanceScene::Start& scene, const VecX& z, const VecX& z_rate) {
  std::vector<BodyMotion> bodies = scene.ideal.bodies;
  const VecX by = scene.T * z, rate = scene.T_rate * z + scene.T * z_rate;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto at = static_cast<Eigen::Index>(6 * b);
    const Vec3 w = bodies[b].w;
    displace(bodies[b], by.segment<6>(at));
    bodies[b].v += rate.segment<3>(at);
    // Of R = exp(theta) R_ideal, to first order in theta.
    bodies[b].w += rate.segment<3>(at + 3) + by.segment<3>(at + 3).cross(w);
  }
  return bodies;
}

// T^T M (vdot - vdot_ideal), the masses with what they carry.
VecX unbalanced(const ClearanceScene::Start& scene, const std::vector<MassProperties>& mass,
                const std::vector<BodyAcceleration>& acceleration) {
  VecX load = VecX::Zero(scene.T.cols());
  for (std::size_t b = 0; b < mass.size(); ++b) {
    const Mat3& R = scene.ideal.bodies[b].R;
    const Vec6 difference = acceleration[b] - scene.ideal.acceleration[b];
    const Vec3 alpha = difference.tail<3>(), c = R * mass[b].c;
    Vec6 wrench;
    wrench.head<3>() = mass[b].mass * (difference.head<3>() + alpha.cross(c));
    wrench.tail<3>() = R * (mass[b].inertia * (R.transpose() * alpha)) + c.cross(Vec3(wrench.head<3>()));
    load += scene.T.middleRows<6>(static_cast<Eigen::Index>(6 * b)).transpose() * wrench;
  }
  return load;
}

// The contacts without friction, until the end of its life.
class Frictionless {
 public:
  Frictionless(ForceElements& forces, const std::vector<JournalInSleeve>& laws) : forces_(forces) {
    for (int c = 0; c < forces_.clearances(); ++c) {
      own_.push_back(forces_.joint(c));
      forces_.act(c, laws[static_cast<std::size_t>(c)]);
    }
  }
  ~Frictionless() {
    for (int c = 0; c < forces_.clearances(); ++c) forces_.act(c, own_[static_cast<std::size_t>(c)]);
  }
  Frictionless(const Frictionless&) = delete;
  Frictionless& operator=(const Frictionless&) = delete;

 private:
  ForceElements& forces_;
  std::vector<JournalInSleeve> own_;
};

void rest_journals(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal, Formulation& formulation,
                   VecX& y, std::string& warning) {
  const ClearanceScene::Start scene = ClearanceScene::at_start(mechanism, ideal, parameters);
  if (scene.layout.n == 0) return;  // no play can move
  std::vector<JournalInSleeve> joints;
  for (int c = 0; c < formulation.forces().clearances(); ++c) joints.push_back(formulation.forces().joint(c));
  const RestingBalance balance(scene.layout, scene.numbers.row.data(), joints);
  const RestingStart rest = balance.solve();
  if (!rest.refusal.empty()) {
    warning = centred_for_want_of(rest.refusal);
    return;
  }
  const Frictionless frictionless(formulation.forces(), balance.joints());
  const std::vector<MassProperties> mass = mechanism.mass_properties(parameters);
  const std::vector<ContactMemory> memory(joints.size());
  const VecX still = VecX::Zero(rest.z.size());  // rates dissipate in contacts: they come last
  VecX z = rest.z, best = z, trial, dy(y.size());
  std::vector<JournalMotion<double>> journals(joints.size());
  // What no place of the journals balances is left to the motion: steps are judged by their length.
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostSteps; ++step) {
    formulation.place_bodies(displaced_bodies(scene, z, still), trial);
    formulation.close_joints(0.0, trial);
    formulation.derivative(0.0, trial, memory, dy);
    const VecX left = balance.balanceable(unbalanced(scene, mass, formulation.acceleration()));
    for (std::size_t c = 0; c < journals.size(); ++c) journals[c] = formulation.forces().motion(static_cast<int>(c));
    const VecX dz = balance.correction(balance.stiffness_at(journals), left);
    const double length = dz.cwiseQuotient(balance.scale()).cwiseAbs().maxCoeff();
    if (length < least) {
      least = length;
      best = z;
    }
    if (length <= kRounding || !(length < kAstray * least)) break;
    z += dz;
  }
  formulation.place_bodies(displaced_bodies(scene, best, scene.numbers.rates * best), y);
  formulation.close_joints(0.0, y);
}

}  // namespace

VecX multibody_start(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal,
                     Formulation& formulation, std::string& warning) {
  IdealState start;
  ideal.state(0.0, start);
  VecX y;
  formulation.start(start, y);
  if (formulation.forces().clearances() == 0 || mechanism.description().journals == JournalStart::centred) return y;
  try {
    rest_journals(mechanism, parameters, ideal, formulation, y, warning);
  } catch (const ComputationError& failure) {
    warning = centred_for_want_of(failure.what());
    formulation.start(start, y);
  }
  return y;
}

}  // namespace boresight
