#include "boresight/scene/resting_start.hpp"

#include <algorithm>
#include <cmath>

#include "boresight/contact_events/contact_jacobian.hpp"
#include "boresight/math/dense_solves.hpp"
#include "boresight/mechanism/multibody_advice.hpp"
#include "boresight/play/joint_play.hpp"
#include "boresight/play/play_words.hpp"
#include "boresight/scene/rest_search.hpp"

namespace boresight {
namespace {

// A load below this share of the largest is what rounding leaves of none.
constexpr double kNoLoad = 1e-9;
// What may be left unbalanced, as a share of the load: less than kNoLoad of it is balanced, lest a journal crosses its clearance for it.
constexpr double kBalanced = kNoLoad;
// What may be left that no place of the journals balances, likewise: it sets off the motion.
constexpr double kLeftToMotion = 1e-4;
constexpr int kMostSteps = 400;
// Of the load over a clearance: with less, the step is the undamped one.
constexpr double kLeastDamping = 1e-8;
// Steps by one stiffness: so many, each no longer than this share of the one before it, the first of this many clearances at most; and the
// length of one that ends them, in clearances.
constexpr int kMostStrides = 12;
constexpr double kShrinks = 0.3, kLongestStride = 0.5, kArrived = 1e-7;
// The same where something is left that no place balances: it makes stiffness of its own, of either sign. How much may be left then of what was.
constexpr double kSoftBeside = 1e-9, kAsBefore = 1.001;

// z per offset: M_r of the other coordinates pulls them to where the bodies move least, T z in the metric of their masses.
MatX carried_along(const MatX& mass, const std::vector<bool>& held) {
  const auto n = static_cast<Eigen::Index>(held.size());
  std::vector<Eigen::Index> offsets, others;
  for (Eigen::Index k = 0; k < n; ++k) (held[static_cast<std::size_t>(k)] ? offsets : others).push_back(k);
  MatX along = MatX::Zero(n, n);
  for (Eigen::Index k : offsets) along(k, k) = 1.0;
  if (!offsets.empty() && !others.empty())
    along(others, offsets) = -solve_positive(MatX(mass(others, others)), MatX(mass(others, offsets)));
  return along;
}

}  // namespace

RestingBalance::RestingBalance(const SceneLayout& layout, std::vector<JointPlay> joints, double cancelled)
    : at_(layout),
      stiffness_(MatX::Zero(layout.n, layout.n)),
      reaction_(VecX::Zero(layout.n)),
      held_(static_cast<std::size_t>(layout.n), false),
      cancelled_(cancelled) {
  // A rest is a matter of elastic forces: what contacts dissipate and rub hangs on how fast the bodies carry them along.
  for (const JointPlay& joint : joints) joints_.push_back(joint.elastic_only());
  for (const JointPlay& law : joints_) widest_ = std::max(widest_, law.widest());
  if (!(widest_ > 0.0)) widest_ = 1e-6;
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    widths_.push_back(joints_[c].widths(widest_));
    const SceneLayout::Joint& joint = at_.joints[c];
    for (int k = 0; k < joint.offsets; ++k)
      if (joint.source[k] >= 0) held_[joint.source[k]] = true;
  }
  offsets_of_.assign(joints_.size(), MatX::Zero(kMostOffsets, at_.n));
  works_on_.assign(joints_.size(), MatX::Zero(6, at_.n));
  over_widths_.resize(joints_.size());
  coordinates_.assign(joints_.size(), {});
  shift_.assign(joints_.size(), PlayOffsets::Zero());
  with_offsets_ = MatX::Identity(at_.n, at_.n);
}

RestingBalance::RestingBalance(const SceneLayout& layout, const double* row, std::vector<JointPlay> joints,
                               double cancelled)
    : RestingBalance(layout, std::move(joints), cancelled) {
  const int n = at_.n;
  MatX inverse;
  at_.inverse_mass(row, inverse);
  const MatX mass = solve_symmetric(inverse, MatX(MatX::Identity(n, n)));
  using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  reaction_ = mass * Eigen::Map<const VecX>(row + at_.Ar, n);
  if (at_.stiff) stiffness_ = mass * Rows(row + at_.AK, n, n);
  read(row);
  with_offsets_ = carried_along(mass, held_);
  weigh();
}

void RestingBalance::take(const double* row, const VecX& reaction, const MatX& stiffness) {
  reaction_ = reaction;
  stiffness_ = stiffness;
  read(row);
  weigh();
}

// What the coordinates do to the joints.
void RestingBalance::read(const double* row) {
  const int n = at_.n;
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    const SceneLayout::Joint& joint = at_.joints[c];
    MatX &G = offsets_of_[c], &V = works_on_[c];
    if (joint.slides == 1) coordinates_[c].slide = row[joint.slide];
    if (joint.twists) coordinates_[c].twist = Vec2T<double>(row[joint.twist], row[joint.twist + 1]).normalized();
    for (int k = 0; k < joint.offsets; ++k) {
      const int source = joint.source[k];
      if (source >= 0) {
        G(k, source) = 1.0;
      } else if (source == DeviationCoordinates::kDependent) {
        G.row(k) = Eigen::Map<const Eigen::RowVectorXd>(row + joint.dependent + k * n, n);
        shift_[c][k] = row[joint.shift + k];
      } else if (k < 3) {
        V.row(k) = Eigen::Map<const Eigen::RowVectorXd>(row + joint.slide_gain + slide_number(k) * n, n);
      }
      if (k < 3 && source != DeviationCoordinates::kSlides) V.row(k) = G.row(k);
    }
    // Where a journal of a joint that slides comes to along its axis decides where its ends push.
    if (joint.slides == 1) G.row(1) = V.row(1);
    // Elastic contact makes no other moments than couples on slopes and roll. By the angular velocity instead, which is theirs in the middle of
    // the play alone, a load would push where nothing does.
    V.bottomRows(3) = G.bottomRows(3);
  }
}

// The loads as far as journals can balance them, and offsets over clearances.
void RestingBalance::weigh() {
  const int n = at_.n;
  VecX scale = VecX::Constant(n, widest_);
  for (std::size_t c = 0; c < joints_.size(); ++c)
    for (int k = 0; k < at_.joints[c].offsets; ++k)
      if (const int source = at_.joints[c].source[k]; source >= 0) scale[source] = widths_[c][k];
  reaction_ = balanceable(reaction_);
  const VecX parts = reaction_.cwiseProduct(scale).cwiseAbs();
  for (int k = 0; k < n; ++k)
    if (parts[k] <= std::max(kNoLoad * parts.maxCoeff(), cancelled_ * widest_)) reaction_[k] = 0.0;

  MatX spread = MatX::Zero(n, n);
  for (int k = 0; k < n; ++k)
    if (!held_[k]) spread(k, k) = 1.0 / (widest_ * widest_);
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    MatX& G = over_widths_[c];
    G = widths_[c].cwiseInverse().asDiagonal() * offsets_of_[c];
    for (int k = 0; k < n; ++k)
      if (!held_[k]) G.col(k).setZero();
    if (at_.joints[c].slides == 1) G.row(1).setZero();
    spread += G.transpose() * G;
  }
  unit_ = orthonormal_in(spread);
  load_ = size(reaction_);
  // What loads make of a tilt is a load too.
  if (at_.tips) load_ = std::max(load_, (unit_.transpose() * stiffness_ * unit_).norm());
  // Where nothing else acts, standing errors that have used up the play press journals through their sleeves.
  const auto shifted = [](const PlayOffsets& shift) { return shift.cwiseAbs().maxCoeff() > 0.0; };
  if (!(load_ > 0.0) && std::any_of(shift_.begin(), shift_.end(), shifted)) load_ = size(left(VecX::Zero(n)));
}

PlayMotion<double> RestingBalance::motion_of(std::size_t joint, const VecX& z) const {
  PlayMotion<double> m = at_rest_at(offsets_of_[joint] * z + shift_[joint], coordinates_[joint]);
  m.e.y() += coordinates_[joint].slide;
  return m;
}

PlayOffsets RestingBalance::load_on(std::size_t joint, const PlayMotion<double>& motion) const {
  PlayWrench<double> wrench;
  joints_[joint].wrench(motion, kSlowImpacts, wrench);
  PlayOffsets load;
  load << wrench.force, couples_of(Vec3(wrench.moment - motion.e.cross(wrench.force)), motion);
  return load;
}

VecX RestingBalance::left(const VecX& offsets) const {
  const VecX z = completed(offsets);
  VecX F = -stiffness_ * z;
  for (std::size_t c = 0; c < joints_.size(); ++c)
    F.noalias() += works_on_[c].transpose() * load_on(c, motion_of(c, z));
  return reaction_ + balanceable(F);
}

void RestingBalance::evaluate(const VecX& offsets, VecX& F, MatX& by_z) const {
  F = left(offsets);
  const VecX z = completed(offsets);
  std::vector<PlayMotion<double>> journals;
  for (std::size_t c = 0; c < joints_.size(); ++c) journals.push_back(motion_of(c, z));
  by_z = stiffness_at(journals);
}

MatX RestingBalance::stiffness_at(const std::vector<PlayMotion<double>>& journals) const {
  MatX by_z = -stiffness_;
  OffsetJacobian of_offsets;
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    PlayMotion<double> still = journals[c];
    still.e_dot.setZero();
    still.w.setZero();
    still.slope_rate.setZero();
    offset_jacobian(joints_[c], still, kSlowImpacts, of_offsets);
    by_z.noalias() += works_on_[c].transpose() * (of_offsets * offsets_of_[c]);
  }
  return with_offsets_.transpose() * by_z * with_offsets_;
}

double RestingBalance::energy(const VecX& offsets) const {
  const VecX z = completed(offsets);
  double sum = 0.5 * z.dot(stiffness_ * z) - reaction_.dot(z);
  for (std::size_t c = 0; c < joints_.size(); ++c) sum += joints_[c].elastic_energy(motion_of(c, z));
  return sum;
}

VecX RestingBalance::correction(const MatX& by_z, const VecX& F) const {
  const MatX H = -(unit_.transpose() * by_z * unit_);
  return unit_ * solve_least(H, VecX(unit_.transpose() * F), kSoftContact);
}

// Each journal where its own offsets' loads alone would have it; where redundant joints tie offsets together, the loads that are least,
// and as near to there as the ties let the journals, in offsets over clearances.
VecX RestingBalance::guess() const {
  const VecX shared = unit_ * (unit_.transpose() * reaction_);
  VecX there = VecX::Zero(at_.n);
  for (std::size_t c = 0; c < joints_.size(); ++c) {
    PlayOffsets load = over_widths_[c] * shared;
    load = (load.array().abs() > kNoLoad * load_).select(load.cwiseQuotient(widths_[c]), 0.0);
    const PlayMotion<double> rest = joints_[c].rest_under(load, coordinates_[c], {}).motion;
    const PlayOffsets offset = offsets_of(rest);
    for (int k = 0; k < at_.joints[c].offsets; ++k)
      if (std::isfinite(offset[k])) there += offset[k] / widths_[c][k] * over_widths_[c].row(k).transpose();
  }
  return unit_ * (unit_.transpose() * there);
}

double RestingBalance::descend(VecX& z, double undecided, bool downhill) const {
  const int n = at_.n;
  VecX F(n), trial(n), F_trial(n);
  MatX J(n, n), J_trial(n, n);
  evaluate(z, F, J);
  double E = energy(z), damping = 0.0;
  for (int step = 0; step < kMostSteps && size(F) > kBalanced * load_; ++step) {
    VecX dz;
    if (damping == 0.0) {
      dz = correction(J, F);
      if (size(F) <= undecided && length(dz) <= kSettledRest) break;
    } else {
      const MatX H = damping * MatX::Identity(n, n) - MatX(unit_.transpose() * J * unit_);
      dz = unit_ * solve_square(H, VecX(unit_.transpose() * F));
    }
    // No farther at once than the clearances are wide: beyond, the contacts are others.
    const double reach = length(dz);
    if (!std::isfinite(reach)) break;
    if (reach > 1.0) dz /= reach;
    trial = z + dz;
    evaluate(trial, F_trial, J_trial);
    const double E_trial = energy(trial);
    const double rounding = kRoundedEnergy * (std::abs(E) + load_);
    const bool pays = downhill ? E_trial < E - rounding || (E_trial <= E + rounding && size(F_trial) < size(F))
                               : E_trial < E || size(F_trial) < size(F);
    if (pays) {
      z = trial;
      E = E_trial;
      F.swap(F_trial);
      J.swap(J_trial);
      damping = damping > kLeastDamping * load_ ? 0.1 * damping : 0.0;
    } else {
      if (size(F) <= std::max(kAcceptableLoad * load_, undecided)) break;  // rounding decides which is lower
      damping = std::max(10.0 * damping, kLeastDamping * load_);
    }
  }
  return size(F);
}

bool RestingBalance::follow(VecX& z, double undecided) {
  const VecX from = z;
  double before = kLongestStride;
  for (int step = 0; step < kMostStrides; ++step) {
    MatX valley;  // of a displacement, the part along which the contacts hold nothing; 0 x 0: not asked
    // The first step turns the contacts as far as they turn; from there on their stiffness is what it will be.
    if (step == 1 || kept_.rows() != at_.n) valley = keep_stiffness(z);
    const VecX F = left(z);
    VecX dz = kept_ * F;
    // The stiffness of the instant before knows the valleys of then, in offsets that coordinates of then give: what it moved along those of now
    // is taken back.
    if (step == 1) dz -= valley * (z - from);
    const double by = length(dz);
    if (!(by <= (step < 2 ? 1.0 : kShrinks) * before)) return false;
    z += dz;
    if (by <= kArrived) return size(F) <= std::max(kAcceptableLoad * load_, undecided);
    before = by;
  }
  return false;
}

MatX RestingBalance::keep_stiffness(const VecX& z) {
  std::vector<PlayMotion<double>> journals;
  for (std::size_t c = 0; c < joints_.size(); ++c) journals.push_back(motion_of(c, z));
  const MatX by_z = stiffness_at(journals), H = -(unit_.transpose() * by_z * unit_);
  const std::optional<MatX> moved = solve_if_positive(H, unit_.transpose(), kSoftContact);
  if (moved) {
    kept_ = unit_ * *moved;
    return MatX::Zero(at_.n, at_.n);
  }
  kept_ = unit_ * pseudo_inverse(H, kSoftContact) * unit_.transpose();
  return MatX::Identity(at_.n, at_.n) + kept_ * by_z;
}

// Coordinates whose offsets, over clearances, are least far from these; what is not held by play stays where it was.
VecX RestingBalance::nearest(const VecX& coordinates, const std::vector<PlayOffsets>& offsets) const {
  VecX there = VecX::Zero(at_.n);
  for (int k = 0; k < at_.n; ++k)
    if (!held_[static_cast<std::size_t>(k)]) there[k] = coordinates[k] / (widest_ * widest_);
  for (std::size_t c = 0; c < joints_.size(); ++c)
    there += over_widths_[c].transpose() * (offsets[c] - shift_[c]).cwiseQuotient(widths_[c]);
  return unit_ * (unit_.transpose() * there);
}

RestingStart RestingBalance::solve_near(const VecX& before, const std::vector<PlayOffsets>& offsets, double undecided) {
  RestingStart rest{before, ""};
  if (at_.n == 0) return rest;
  const VecX near = nearest(before, offsets);
  rest.z = near;
  if (!(load_ > undecided) || follow(rest.z, undecided)) return rest;
  rest.z = near;
  const double size_left = descend(rest.z, undecided);
  if (!rest.z.allFinite() || size_left > std::max(kAcceptableLoad * load_, undecided)) rest = solve();
  if (rest.refusal.empty()) keep_stiffness(rest.z);
  return rest;
}

RestingStart RestingBalance::solve() const {
  const int n = at_.n;
  RestingStart rest{VecX::Zero(n), ""};
  if (n == 0 || !(load_ > 0.0)) return rest;  // nothing presses anywhere
  VecX z = guess();
  if (!(energy(z) < energy(VecX::Zero(n)))) z.setZero();
  double size_left = descend(z, 0.0);
  if (at_.tips) size_left = off_the_saddle(z, size_left);
  if (size_left > kAcceptableLoad * load_ || !z.allFinite()) {
    // Whether journals rest there, but for what no place of theirs balances and is left to the motion; then as near to the ideal motion as that
    // allows.
    const auto rests = [&](double step) {
      if (!rest.z.allFinite()) return false;
      const double remains = size(left(rest.z));
      if (remains > kAcceptableLoad * load_ && !(step <= kSettledRest && remains <= kLeftToMotion * load_))
        return false;
      if (!settle(rest.z) && remains > kAcceptableLoad * load_) shorten(rest.z, kAsBefore * remains, kSoftBeside);
      rest.z = completed(rest.z);
      return true;
    };
    const auto step_at = [&] {
      VecX F(n);
      MatX J(n, n);
      evaluate(rest.z, F, J);
      return length(correction(J, F));
    };
    rest.z = guess();
    if (rests(search_rest([&](const VecX& at) { return left(at); }, unit_, rest.z))) return rest;
    rest.z = z;
    if (z.allFinite() && rests(step_at())) return rest;
    // Contacts that take turns lead both in circles, and the energy does not.
    rest.z.setZero();
    descend(rest.z, 0.0, true);
    if (rest.z.allFinite() && rests(step_at())) return rest;
    rest.z.setZero();
    rest.refusal =
        "no position was found in which the " + parts_in_play(joints_).inserts + "' contacts carry the loads of t = 0";
    return rest;
  }
  settle(z);
  rest.z = completed(z);
  return rest;
}

std::string centred_for_want_of(const Mechanism& mechanism, const std::string& refusal) {
  const PartsInPlay parts = parts_in_play(mechanism.description());
  return parts.inserts + " start in the middle of their " + parts.seats + ": " + without_advice(refusal);
}

VecX start_coordinates(const Mechanism& mechanism, const SceneLayout& layout, const SceneStart& start,
                       const std::vector<JointPlay>& joints, std::string& warning) {
  VecX state = VecX::Zero(2 * layout.n);
  if (mechanism.description().journals == JournalStart::centred) return state;
  const RestingStart rest = RestingBalance(layout, start.row.data(), joints, start.cancelled).solve();
  if (!rest.refusal.empty()) {
    warning = centred_for_want_of(mechanism, rest.refusal);
    return state;
  }
  state << rest.z, start.rates * rest.z;
  if (start.beside.size() > 0) state += start.beside;
  return state;
}

}  // namespace boresight
