#include "boresight/perturbation/second_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "boresight/formulations/formulation.hpp"
#include "boresight/formulations/shared_reactions.hpp"
#include "boresight/math/dense_solves.hpp"
#include "boresight/mechanism/built_mechanism.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/perturbation/displacement_sizes.hpp"
#include "boresight/perturbation/missed_at_rest.hpp"
#include "boresight/perturbation/missed_share.hpp"

namespace boresight {
namespace {

using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

// What makes lengths of all coordinates [m]: slopes count at the sleeve's ends, turns of joints on the
// mechanism's size.
VecX lengths(const Mechanism& mechanism, const Parameters& parameters, const SceneLayout& at) {
  VecX unit = VecX::Constant(at.n, mechanism.characteristic_length());
  for (std::size_t c = 0; c < at.joints.size(); ++c)
    for (int k = 0; k < at.joints[c].offsets; ++k)
      if (const int source = at.joints[c].source[k]; source >= 0)
        unit[source] = k < 3 ? 1.0 : tilt_lever(parameters.clearance[c]);
  return unit;
}

// Coordinates whose forces decide together where a journal or a ball rests: what the seat's shape does not tell apart, tilts with
// what is across the axis; and every coordinate that is no offset.
std::vector<std::vector<int>> pushed_together(const SceneLayout& at, const ForceElements& forces) {
  std::vector<std::vector<int>> groups;
  std::vector<bool> taken(at.n, false);
  for (std::size_t c = 0; c < at.joints.size(); ++c) {
    const SceneLayout::Joint& joint = at.joints[c];
    const std::size_t first = groups.size();
    for (const std::vector<int>& group : forces.joint(static_cast<int>(c)).pushed_together()) {
      if (group.empty()) continue;
      if (group.front() < 3) groups.emplace_back();
      std::vector<int>& into = group.front() < 3 ? groups.back() : groups[first];
      for (int k : group) {
        if (k >= joint.offsets || joint.source[k] < 0) continue;
        into.push_back(joint.source[k]);
        taken[joint.source[k]] = true;
      }
    }
  }
  for (int i = 0; i < at.n; ++i)
    if (!taken[i]) groups.push_back({i});
  return groups;
}

// Offsets that others decide: B, as many rows, and what their exact values are beyond B z, all in lengths; what makes them so.
struct DependentOffsets {
  MatX B;
  VecX beyond, length;
};
DependentOffsets dependent_offsets(const SceneLayout& at, const double* row, const Parameters& parameters,
                                   const ForceElements& exact, const VecX& z) {
  DependentOffsets all{MatX(0, at.n), VecX(0), VecX(0)};
  for (std::size_t c = 0; c < at.joints.size(); ++c) {
    const SceneLayout::Joint& joint = at.joints[c];
    if (!joint.has_dependent) continue;
    const PlayMotion<double>& motion = exact.motion(static_cast<int>(c));
    for (int k = 0; k < joint.offsets; ++k) {
      if (joint.source[k] != DeviationCoordinates::kDependent) continue;
      const double length = k < 3 ? 1.0 : tilt_lever(parameters.clearance[c]);
      const Eigen::Map<const Eigen::RowVectorXd> B(row + joint.dependent + k * at.n, at.n);
      const Eigen::Index i = all.B.rows();
      all.B.conservativeResize(i + 1, Eigen::NoChange);
      all.beyond.conservativeResize(i + 1);
      all.length.conservativeResize(i + 1);
      all.length[i] = length;
      all.B.row(i) = length * B;
      all.beyond[i] = length * (offsets_of(motion)[k] - B * z);
    }
  }
  return all;
}

// The shortest step of the coordinates that takes the dependent offsets back. What depends on them by rounding alone is not taken along.
VecX taken_along(const DependentOffsets& offsets, const VecX& unit) {
  constexpr double kRounding = 1e-9;
  MatX B = offsets.B * unit.asDiagonal();
  if (B.size() == 0) return VecX::Zero(unit.size());
  for (auto row : B.rowwise())
    if (!(row.norm() > kRounding * unit.maxCoeff())) row.setZero();
  return -(unit.asDiagonal() * solve_least(B, offsets.beyond));
}

// One a PointingQuantity.
constexpr int kKinds = kPointingQuantities;
constexpr int kMoved = int(PointingQuantity::position_error), kTurned = int(PointingQuantity::orientation_error),
              kAimed = int(PointingQuantity::boresight_error), kSighted = int(PointingQuantity::line_of_sight_error);

// What is found out, one deviation after the other.
class LeftOut {
 public:
  LeftOut(const Mechanism& mechanism, const PreparedScene& prepared, const Parameters& parameters, bool want_missed)
      : want_missed_(want_missed),
        displaced_(has_errors(parameters)),
        mechanism_(mechanism),
        prepared_(prepared),
        parameters_(parameters),
        tables_(prepared.tables(parameters)),
        at_(tables_->layout),
        coordinates_(prepared.scene().coordinates()),
        formulation_(make_tree_formulation(mechanism, parameters, &prepared.ideal(), {})),
        unit_(lengths(mechanism, parameters, at_)),
        groups_(pushed_together(at_, formulation_->forces())),
        memory_(at_.joints.size()),
        row_(tables_->dynamics.width()),
        part_(groups_.size()),
        astray_(groups_.size()),
        push_(groups_.size()),
        pushed_off_(groups_.size(), 0.0) {}

  // counts: whether the indices know of that time; what is missed before moves journals all the same. Throws ComputationError where it cannot be
  // made exactly.
  void look(const LargestDeviations::Deviation& deviation, bool counts) {
    tables_->dynamics.at(deviation.t, row_.data());
    MatX T, A;
    coordinates_.gain(deviation.t, T);
    at_.inverse_mass(row_.data(), A);
    const VecX reaction = solve_positive(A, VecX(Eigen::Map<const VecX>(row_.data() + at_.Ar, at_.n)));
    const SharedReactions shared(prepared_.scene().offsets(), parameters_, coordinates_.offsets_per_coordinate(T));
    const VecX load = deviation.part_time > 0.0 ? VecX(deviation.load_time / deviation.part_time) : VecX();
    formulation_->forces().replace_contact(shared.of(reaction, load));

    IdealState state;
    prepared_.ideal().state(deviation.t, state);
    const std::vector<BodyMotion> bodies = made_exactly(state, deviation, T);
    const auto [z, z_dot, z_ddot] = coordinates_.deviation(state, bodies, formulation_->acceleration());

    const int body = mechanism_.boresight_body();
    const auto E = T.middleRows<6>(6 * body);
    const Vec6 linear = E * z, off = displacement(state.bodies[body], bodies[body]) - linear;
    // What the contacts of dependent offsets make of their own misses comes on top, whichever way it points.
    const DependentOffsets dependent = dependent_offsets(at_, row_.data(), parameters_, formulation_->forces(), z);
    const Vec6 along = E * taken_along(dependent, unit_);
    const DisplacementSizes sizes(mechanism_, state.bodies[body]);
    const auto whole = sizes(linear), bent = sizes(off), taken = sizes(along);
    for (int k = 0; counts && k < kKinds; ++k) miss_[k].add(whole[k], bent[k] + taken[k]);

    const VecX by_rates = Rows(row_.data() + at_.AC, at_.n, at_.n) * z_dot;
    const VecX by_places = at_.stiff ? VecX(Rows(row_.data() + at_.AK, at_.n, at_.n) * z) : VecX(VecX::Zero(at_.n));
    const VecX left = z_ddot + by_rates + by_places;
    // What no contact carries, nothing pushes on the average: it goes by the sum of these.
    const VecX moving = z_ddot.cwiseAbs() + by_rates.cwiseAbs() + by_places.cwiseAbs();
    if (want_missed_)
      missed_.push_back(
          missed(deviation.t, left, reaction, A, shared, load, dependent.beyond.cwiseQuotient(dependent.length)));
    const VecX push = reaction.cwiseQuotient(unit_), push_off = solve_positive(A, left).cwiseQuotient(unit_);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      double size = 0.0, size_off = 0.0;
      // A journal whose forces turn may go any way: offsets and slopes that cancel in the pose need not cancel then.
      double reach = 0.0;
      std::array<double, kKinds> gain = {0.0, 0.0, 0.0, 0.0};
      for (int i : groups_[g]) {
        const bool carried = i < at_.n - coordinates_.leftover();
        size += std::pow(carried ? push[i] : moving[i], 2);
        size_off += std::pow(carried ? push_off[i] : left[i], 2);
        reach += unit_[i] * unit_[i] * z[i] * z[i];
        const auto of_one = sizes(E.col(i) / unit_[i]);
        for (int k = 0; k < kKinds; ++k) gain[k] += of_one[k] * of_one[k];
      }
      const double share_off = size_off > 0.0 ? std::min(1.0, std::sqrt(size_off / std::max(size, 1e-300))) : 0.0;
      for (int k = 0; counts && k < kKinds; ++k) {
        const double part = std::sqrt(gain[k] * reach);
        part_[g][k].add(whole[k], part);
        astray_[g][k].add(whole[k], part * share_off);
      }
      push_[g].add(std::sqrt(size), std::sqrt(size_off));
      pushed_off_[g] = std::max(pushed_off_[g], share_off);
    }
  }

  // at_rest: what the balance at the start misses, of each kind.
  // index: of the motion.
  SecondOrder shares(const MissedAtRest& at_rest, const PointingIndices& index) const {
    // What turns miss that are next to nothing against the displacement, on the mechanism's size, counts against a little of that; and the
    // other way round. The line of sight counts against itself: how small an angle a displacement is depends on the target's distance.
    constexpr double kNextToNothing = 1e-4;
    const double length = mechanism_.characteristic_length();
    const double next_to_nothing = kNextToNothing * std::max({miss_[kMoved].size(), length * miss_[kTurned].size(),
                                                              length * miss_[kAimed].size()});
    const auto of_all = [](double share) { return std::isfinite(share) ? std::min(share, 1.0) : 1.0; };
    SecondOrder found;
    found.free = coordinates_.leftover() > 0;
    found.missed = missed_;
    found.start = at_rest.start;
    for (int k = 0; k < kKinds; ++k) {
      const double least = k == kMoved ? next_to_nothing : k == kSighted ? 0.0 : next_to_nothing / length;
      const Statistics& of_all_errors = index.of(PointingQuantity(k));
      const auto share = [&](const MissedShare& part) {
        return displaced_ ? part.share_of(least, of_all_errors) : part.value(least, of_all_errors);
      };
      const double size = std::max(displaced_ ? of_all_errors.max : miss_[k].size(), least);
      double of_kind = share(miss_[k]);
      const double by_rest = size > 0.0 ? at_rest.pose[k] / size : 0.0;
      found.pose[k] = of_all(std::max(of_kind, by_rest));
      // A force that is off early shows in where the journal gets to later: all of its part counts by the share of all forces. And where
      // next to nothing pushes for a while, all of its part counts for that while. Together no more than all of it by the largest share.
      for (std::size_t g = 0; g < groups_.size(); ++g) {
        const double part = share(part_[g][k]), by_forces = part * std::min(1.0, push_[g].mean_value(0.0)),
                     astray = displaced_ ? astray_[g][k].mean_value(least, of_all_errors.rms)
                                         : astray_[g][k].mean_value(least);
        // What a freedom that nothing holds is off by early it is off by from then on.
        of_kind += is_free(g) ? part * pushed_off_[g] : std::min(part * pushed_off_[g], by_forces + astray);
      }
      found.whole[k] = of_all(std::max(of_kind, by_rest));
    }
    return found;
  }

 private:
  bool is_free(std::size_t group) const {
    return !groups_[group].empty() && groups_[group].front() >= at_.n - coordinates_.leftover();
  }

  // The bodies displaced by T z, as fast as that goes on, and all joints closed around them.
  std::vector<BodyMotion> made_exactly(const IdealState& ideal, const LargestDeviations::Deviation& deviation,
                                       const MatX& T) {
    std::vector<BodyMotion> displaced = ideal.bodies;
    Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> E_dot(6, deviation.z.size());
    for (std::size_t b = 0; b < displaced.size(); ++b) {
      prepared_.pose_gain_rate(static_cast<int>(b)).at(deviation.t, E_dot.data());
      const auto E = T.middleRows<6>(static_cast<Eigen::Index>(6 * b));
      const Vec6 x = E * deviation.z, rate = E * deviation.z_dot + E_dot * deviation.z;
      displaced[b].v += rate.head<3>();
      displaced[b].w += rate.tail<3>() + x.tail<3>().cross(displaced[b].w);
      displace(displaced[b], x);
    }
    if (!begun_) formulation_->start(ideal, y_);  // which rows are redundant is the same in every pose
    begun_ = true;
    formulation_->place_bodies(displaced, y_);
    formulation_->stabilise(ideal.t, y_);
    dy_.resize(y_.size());
    formulation_->derivative(ideal.t, y_, memory_, dy_);
    return formulation_->bodies(ideal.t, y_);
  }

  // Of the coordinates, where the bodies have been placed and `loads` push all offsets.
  VecX acceleration_under(double t, const std::vector<PlayOffsets>& loads) {
    formulation_->forces().replace_contact(loads);
    formulation_->derivative(t, y_, memory_, dy_);
    VecX z_ddot;
    coordinates_.coordinate_accelerations(formulation_->bodies(t, y_), formulation_->acceleration(), z_ddot);
    return z_ddot;
  }

  // left: what is missed where contacts carry the ideal reactions. They do on the average only: a journal that strikes is pushed by far more,
  // and where its offset is largest. So how forces accelerate is looked at apart, one by one.
  Missed missed(double t, const VecX& left, const VecX& reaction, const MatX& A, const SharedReactions& shared,
                const VecX& near, VecX offset) {
    const auto under = [&](const VecX& load) { return acceleration_under(t, shared.of(load, near)); };
    const double push = reaction.cwiseAbs().maxCoeff();
    if (!(push > 0.0)) return {t, left, MatX::Zero(at_.n, at_.n), std::move(offset)};  // nothing pushes at all
    const VecX balanced = under(reaction);
    MatX change = MatX::Zero(at_.n, at_.n);
    // A freedom that no offset has is pushed by no load on offsets: how it gives way to one on itself is not looked at.
    const int carried = at_.n - coordinates_.leftover();
    for (int i = 0; i < carried; ++i) {
      VecX more = reaction;
      more[i] += push;
      change.col(i) = (balanced - under(more)) / push - A.col(i);
    }
    const auto of_offsets = change.topLeftCorner(carried, carried);
    change.topLeftCorner(carried, carried) = 0.5 * (of_offsets + of_offsets.transpose()).eval();
    change.topRightCorner(carried, at_.n - carried) = change.bottomLeftCorner(at_.n - carried, carried).transpose();
    return {t, left + change * reaction, change, std::move(offset)};
  }

  bool want_missed_;
  bool displaced_;  // by standing errors too, which the index holds beside the play
  const Mechanism& mechanism_;
  const PreparedScene& prepared_;
  const Parameters& parameters_;
  std::shared_ptr<const SceneTables> tables_;
  const SceneLayout& at_;
  DeviationCoordinates coordinates_;
  std::unique_ptr<Formulation> formulation_;
  VecX unit_;
  std::vector<std::vector<int>> groups_;
  std::vector<ContactMemory> memory_;
  std::vector<double> row_;
  bool begun_ = false;
  std::array<MissedShare, kKinds> miss_;
  // Of each group, over the instants: its part of each kind, that times how much of its forces is off then, these forces, and the most of them.
  std::vector<std::array<MissedShare, kKinds>> part_, astray_;
  std::vector<MissedShare> push_;
  std::vector<double> pushed_off_;
  std::vector<Missed> missed_;
  VecX y_, dy_;  // the formulation's state at the last deviation
};

}  // namespace

SecondOrder second_order(const Mechanism& mechanism, const PreparedScene& prepared, const Parameters& parameters,
                         const LargestDeviations& largest, const PointingIndices& index, double start,
                         bool want_missed) {
  try {
    LeftOut left_out(mechanism, prepared, parameters, want_missed);
    for (const LargestDeviations::Deviation& deviation : largest.parts())
      if (deviation.size > 0.0) left_out.look(deviation, deviation.t >= start || &deviation == &largest.parts().back());
    return left_out.shares(missed_at_rest(mechanism, prepared, parameters, want_missed), index);
  } catch (const ComputationError&) {
    SecondOrder all;
    all.pose.fill(1.0);
    all.whole.fill(1.0);
    return all;
  }
}

}  // namespace boresight
