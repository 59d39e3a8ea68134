#include "boresight/multibody/multibody_start.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <memory>

#include "boresight/math/dense_solves.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/play/play_words.hpp"
#include "boresight/scene/clearance_scene.hpp"
#include "boresight/scene/rest_search.hpp"
#include "boresight/scene/resting_start.hpp"
#include "boresight/scene/tipping.hpp"

namespace boresight {
namespace {

// Steps of the journals, over their clearances: shorter ones are rounding.
constexpr double kRounding = 1e-12;
// Where the pose bends much they shrink slowly, by a quarter or less each: as long as they shrink, or what is left unbalanced does, they lead
// there. Some that do not are rounding, or a way around.
constexpr int kMostSteps = 400, kMostIdle = 20, kMostIdleOfSettled = 6;
constexpr double kShrinks = 0.98;
// What contacts carry of the loads where journals rest: all but this share, or no load at all.
constexpr double kCarried = 0.1;
// A step that leaves more unbalanced than each of the last few did is halved, so often at most.
constexpr int kMostHalvings = 6;
constexpr std::size_t kLastLoads = 3;
// A step this many times the shortest leads away.
constexpr double kAstray = 100.0;
// Of the loads: with more along what has lost its contact, journals do not rest there. They are sent so many clearances that way, half as far
// whenever it has turned round.
constexpr double kLost = 1e-6, kSent = 0.5;

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

// The contacts elastic and without friction, until the end of its life.
class ElasticOnly {
 public:
  ElasticOnly(ForceElements& forces, const std::vector<JointPlay>& laws) : forces_(forces) {
    for (int c = 0; c < forces_.clearances(); ++c) {
      own_.push_back(forces_.joint(c));
      forces_.act(c, laws[static_cast<std::size_t>(c)]);
    }
  }
  ~ElasticOnly() {
    for (int c = 0; c < forces_.clearances(); ++c) forces_.act(c, own_[static_cast<std::size_t>(c)]);
  }
  ElasticOnly(const ElasticOnly&) = delete;
  ElasticOnly& operator=(const ElasticOnly&) = delete;

 private:
  ForceElements& forces_;
  std::vector<JointPlay> own_;
};

// The journals' balance on the mechanism's own geometry, as a function of where they are sent.
class ExactBalance {
 public:
  ExactBalance(const Mechanism& mechanism, const Parameters& parameters, const ClearanceScene::Start& scene,
               const RestingBalance& balance, Formulation& formulation)
      : scene_(scene),
        balance_(balance),
        formulation_(formulation),
        mass_(mechanism.mass_properties(parameters)),
        memory_(static_cast<std::size_t>(mechanism.clearances())),
        journals_(memory_.size()),
        rate_(formulation.state_size()) {}

  // Of the linear balance: along what its contacts hold nothing journals are where they are left, and what pushes there is left to the motion.
  void leave_as_in(const VecX& linear) { valley_ = ways_not_held(balance_, linear); }

  // What is left unbalanced with the journals sent to z, the bodies moving as they start: with coordinates that stand still, they would
  // move otherwise in another drawing.
  VecX left(const VecX& z) {
    place(z, state_);
    formulation_.derivative(0.0, state_, memory_, rate_);
    for (std::size_t c = 0; c < journals_.size(); ++c) journals_[c] = formulation_.forces().motion(static_cast<int>(c));
    return balance_.balanceable(unbalanced(scene_, mass_, formulation_.acceleration()));
  }
  // Of the last left(): its change with the offsets, were these where they are sent to.
  MatX stiffness() const { return balance_.stiffness_at(journals_); }
  // Whether loads tip the journals over from z.
  bool falls(const VecX& z) {
    if (!scene_.layout.tips) return false;
    left(z);
    return balance_.falls(stiffness());
  }
  // What pushes journals along what holds nothing here and does where loads are balanced linearly: a contact has let go that carries its part. In
  // clearances' directions; none: 0.
  VecX lost(const MatX& by_z, const VecX& left) const {
    const MatX H = -(balance_.unit().transpose() * by_z * balance_.unit());
    const VecX load = balance_.unit().transpose() * left;
    VecX push = load - H * solve_least(H, load, kSoftContact);
    if (valley_.size() > 0) push -= valley_ * (valley_.transpose() * push);
    return balance_.load() > 0.0 && push.norm() > kLost * balance_.load() ? push : VecX(VecX::Zero(push.size()));
  }
  // Whether journals rest at z as far as contacts go that the linear balance has.
  bool lets_go(const VecX& z) {
    const VecX F = left(z);
    return lost(stiffness(), F).norm() > 0.0;
  }
  double length(const VecX& dz) const { return balance_.length(dz); }
  double size(const VecX& load) const { return balance_.size(load); }
  double load() const { return balance_.load(); }
  const MatX& unit() const { return balance_.unit(); }
  VecX step(const MatX& by_z, const VecX& left) const { return balance_.correction(by_z, left); }

  void place(const VecX& offsets, VecX& y) {
    const VecX z = balance_.completed(offsets);
    formulation_.place_bodies(displaced_bodies(scene_, z, scene_.numbers.rates * z), y);
    formulation_.close_joints(0.0, y);
  }

 private:
  const ClearanceScene::Start& scene_;
  const RestingBalance& balance_;
  Formulation& formulation_;
  std::vector<MassProperties> mass_;
  std::vector<ContactMemory> memory_;
  std::vector<PlayMotion<double>> journals_;
  MatX valley_;
  VecX state_, rate_;
};

// Newton's method with the offsets' own stiffness: a few steps, where the pose is all but linear in the offsets. Returns the length of
// the shortest step.
double rest_nearly_linear(ExactBalance& exact, VecX& z) {
  VecX at = z, left = exact.left(at), sent;
  double reach = kSent;
  // What no place of the journals balances is left to the motion: steps are judged by their length.
  double least = std::numeric_limits<double>::infinity(), lightest = least;
  int idle = 0;
  std::deque<double> last = {exact.size(left)};
  for (int step = 0; step < kMostSteps && idle < (least <= kSettledRest ? kMostIdleOfSettled : kMostIdle); ++step) {
    const MatX stiffness = exact.stiffness();
    VecX dz = exact.step(stiffness, left);
    if (const VecX lost = exact.lost(stiffness, left); lost.norm() > 0.0) {
      if (sent.size() > 0 && sent.dot(lost) < 0.0) reach *= 0.5;
      sent = lost;
      dz += exact.unit() * lost * (reach / lost.norm());
    }
    const double length = exact.length(dz), load = exact.size(left);
    if (length > 1.0) dz /= length;  // beyond their clearances at once the contacts are others
    // Where contacts are open no step helps, and that is no rest.
    const bool carried = load <= kCarried * exact.load() || !(exact.load() > 0.0);
    idle = (carried && length < kShrinks * least) || load < kShrinks * lightest ? 0 : idle + 1;
    lightest = std::min(lightest, load);
    if (carried && length < least) {
      least = length;
      z = at;
    }
    if ((carried && length <= kRounding) || !(length < kAstray * least)) break;
    // Along its sleeve's wall a light load holds a journal so softly that a step leads off the wall, or into it.
    const double most = *std::max_element(last.begin(), last.end());
    double share = 1.0;
    left = exact.left(at + dz);
    for (int halved = 0; halved < kMostHalvings && exact.size(left) > most; ++halved) {
      share *= 0.5;
      left = exact.left(at + share * dz);
    }
    if (exact.size(left) > most && share < 1.0) left = exact.left(at + (share = 1.0) * dz);
    at += share * dz;
    last.push_back(exact.size(left));
    if (last.size() > kLastLoads) last.pop_front();
  }
  return least;
}

// Follows the rest as all clearances grow together from next to nothing, where the pose is linear in them: from there each rest is near the
// one before, and no search among contacts is asked for. Returns the length of the last step at full clearances; infinity where the way ends
// before (the rest snaps over).
double rest_as_clearances_grow(const Mechanism& mechanism, const Parameters& parameters,
                               const ClearanceScene::Start& scene, Formulation& formulation, VecX& z) {
  constexpr double kFirst = 1.0 / 256.0, kFastest = 2.0, kSlowest = 1.02;
  const auto rest_at = [&](double share, VecX* from) {
    Parameters narrowed = parameters;
    for (ClearanceParameters& c : narrowed.clearance)
      for (const auto gap : kGaps) c.*gap *= share;
    const RestingBalance balance(scene.layout, scene.numbers.row.data(), joint_plays(mechanism.description(), narrowed),
                                 scene.numbers.cancelled);
    const RestingStart linear = balance.solve();
    if (!from && !linear.refusal.empty()) return std::numeric_limits<double>::infinity();
    z = from ? *from : linear.z;
    const ElasticOnly elastic(formulation.forces(), balance.joints());
    ExactBalance exact(mechanism, parameters, scene, balance, formulation);
    if (linear.refusal.empty()) exact.leave_as_in(linear.z);
    const double length = rest_nearly_linear(exact, z);
    if (length <= kAcceptableRest || !from) return length;
    // Close to a rest, with the stiffness that the bent pose has.
    VecX other = *from;
    const double other_length = search_rest([&](const VecX& at) { return exact.left(at); }, exact.unit(), other);
    if (other_length < length) z = other;
    return std::min(length, other_length);
  };
  double share = kFirst, growth = kFastest, length = rest_at(share, nullptr);
  if (!(length <= kAcceptableRest)) return std::numeric_limits<double>::infinity();
  while (share < 1.0) {
    const double next = std::min(1.0, growth * share);
    const VecX before = z;
    VecX from = before * (next / share);
    try {
      length = rest_at(next, &from);
    } catch (const ComputationError&) {
      length = std::numeric_limits<double>::infinity();
    }
    if (length <= kAcceptableRest) {
      share = next;
      growth = std::min(kFastest, growth * growth);
      continue;
    }
    z = before;
    growth = std::sqrt(growth);
    if (growth < kSlowest) return std::numeric_limits<double>::infinity();
  }
  return length;
}

}  // namespace

RestingBodies resting_bodies(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal) {
  const ClearanceScene::Start scene = ClearanceScene::at_start(mechanism, ideal, parameters);
  RestingBodies resting;
  if (scene.layout.n == 0) return resting;
  resting.remark = tipping_sentence(mechanism, scene.layout);
  if (resting.remark.empty()) resting.remark = undecided_sentence(mechanism, scene.layout);
  // Whatever formulation follows the motion, it starts from the same place. This one closes joints by the bodies' least motion, whatever
  // order they are listed in; a tree of them closes its loops where it happens to be cut.
  const std::unique_ptr<Formulation> formulation = make_paper_formulation(mechanism, parameters, &ideal, {});
  VecX y;
  formulation->start(scene.ideal, y);
  std::vector<JointPlay> joints;
  for (int c = 0; c < formulation->forces().clearances(); ++c) joints.push_back(formulation->forces().joint(c));
  const RestingBalance balance(scene.layout, scene.numbers.row.data(), joints, scene.numbers.cancelled);
  const RestingStart rest = balance.solve();
  if (!rest.refusal.empty()) {
    resting.refusal = rest.refusal;
    return resting;
  }
  resting.linear = scene.T * rest.z;
  const ElasticOnly elastic(formulation->forces(), balance.joints());
  ExactBalance exact(mechanism, parameters, scene, balance, *formulation);
  exact.leave_as_in(rest.z);
  VecX z = rest.z;
  double length = std::numeric_limits<double>::infinity();
  bool lets_go = true;
  // A place that holds all contacts is taken before one that does not, and then the nearer to a rest.
  const auto take = [&](VecX at, double to_rest) {
    if (!std::isfinite(to_rest) || exact.falls(at)) return;
    bool open = exact.lets_go(at);
    if (open) {
      VecX closed = at;
      if (const double after = rest_nearly_linear(exact, closed);
          after <= kSettledRest && !exact.lets_go(closed) && !exact.falls(closed)) {
        at = closed;
        to_rest = after;
        open = false;
      }
    }
    const bool rests = to_rest <= kAcceptableRest && !open, rested = length <= kAcceptableRest && !lets_go;
    if (rests == rested ? !(to_rest < length) : rested) return;
    z = at;
    length = to_rest;
    lets_go = open;
  };
  const auto settled = [&] { return length <= kSettledRest && !lets_go; };
  VecX other = rest.z;
  const double near = rest_nearly_linear(exact, other);
  take(other, near);
  if (!settled()) {
    const double grown = rest_as_clearances_grow(mechanism, parameters, scene, *formulation, other);
    take(other, grown);
  }
  // From where the linear balance is, or where that lies beyond what the pose bends by, from nearer to the middle of the sleeves.
  for (double share : {1.0, 0.5, 0.25, 0.0}) {
    if (settled()) break;
    other = share * rest.z;
    const double found = search_rest([&](const VecX& at) { return exact.left(at); }, exact.unit(), other);
    take(other, found);
  }
  if (!(length <= kAcceptableRest) && scene.layout.tips) {
    // Where the linear balance leans to is nearer to a rest than the middle, which is none that lasts.
    z = rest.z;
  } else if (!(length <= kAcceptableRest)) {
    resting.refusal = "no position was found in which the " + parts_in_play(mechanism.description()).inserts +
                      "' contacts carry the loads of t = 0 on the mechanism's own geometry, which bends within the "
                      "clearances";
    return resting;
  } else if (lets_go && resting.remark.empty()) {
    resting.remark = "where the " + parts_in_play(mechanism.description()).inserts +
                     " start, a contact that carries a part of the loads of t = 0 is open, as no position was found in "
                     "which all hold: they move from there";
  }
  exact.place(z, y);
  resting.exact = formulation->bodies(0.0, y);
  return resting;
}

VecX multibody_start(const Mechanism& mechanism, const Parameters& parameters, const IdealMotion& ideal,
                     Formulation& formulation, std::string& warning) {
  IdealState start;
  ideal.state(0.0, start);
  VecX y;
  formulation.start(start, y);
  if (formulation.forces().clearances() == 0 || mechanism.description().journals == JournalStart::centred) return y;
  try {
    const RestingBodies resting = resting_bodies(mechanism, parameters, ideal);
    if (!resting.remark.empty()) warning = resting.remark;
    if (!resting.refusal.empty()) warning = centred_for_want_of(mechanism, resting.refusal);
    if (resting.exact.empty()) return y;
    formulation.place_bodies(resting.exact, y);
    formulation.close_joints(0.0, y);
  } catch (const ComputationError& failure) {
    warning = centred_for_want_of(mechanism, failure.what());
    formulation.start(start, y);
  }
  return y;
}

}  // namespace boresight
