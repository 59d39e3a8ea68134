#include "boresight/mechanism/lost_motion.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "boresight/mechanism/ideal_motion.hpp"
#include "boresight/mechanism/interruption.hpp"
#include "boresight/mechanism/rank_analysis.hpp"

namespace boresight {
namespace {

// Looked at once in so many states of the motion's table, where its fastest vibration turns by about a quarter of a radian.
constexpr int kKnotsBetweenLooks = 4, kFewestLooks = 128, kMostLooks = 4000;
// A lock this far from zero in a dip is none that its singular value would call lost.
constexpr double kHeld = 100.0 * kSingular;

class Locks {
 public:
  Locks(const Mechanism& mechanism, const IdealMotion& motion)
      : mechanism_(mechanism),
        motion_(motion),
        system_(mechanism,
                {.clearance = ClearanceRows::closed,
                 .drives = !mechanism.description().motion.pose,
                 .prescribed_body =
                     mechanism.description().motion.pose ? mechanism.description().motion.pose->body : kGround}),
        laws_(mechanism.joints()) {}

  VecX at(double t) {
    motion_.state(t, state_);
    system_.evaluate(state_.bodies, laws_);
    return locks(mechanism_, system_);
  }

  LostMotion lost_at(double t) {
    at(t);
    return lost_motion(mechanism_, system_, t, mechanism_.description().motion.pose.has_value());
  }

 private:
  const Mechanism& mechanism_;
  const IdealMotion& motion_;
  ConstraintSystem system_;
  std::vector<TimeValue> laws_;  // which the rows' slopes do not hang on
  IdealState state_;
};

}  // namespace

bool may_be_zero_near(double here, double before, double after) {
  constexpr double kDip = 0.5;  // a third of the larger one, where it falls in straight lines
  return here <= std::min(before, after) && here <= kDip * std::max(before, after);
}

double weakest_between(double t0, double t1, const std::function<double(double)>& lock) {
  constexpr double kShare = 1.0 / std::numbers::phi;
  constexpr int kNarrowings = 48;  // to 1e-10 of the time between
  double early = t1 - kShare * (t1 - t0), late = t0 + kShare * (t1 - t0);
  double at_early = lock(early), at_late = lock(late);
  for (int k = 0; k < kNarrowings; ++k)
    if (at_early < at_late) {
      t1 = late, late = early, at_late = at_early;
      at_early = lock(early = t1 - kShare * (t1 - t0));
    } else {
      t0 = early, early = late, at_early = at_late;
      at_late = lock(late = t0 + kShare * (t1 - t0));
    }
  return 0.5 * (t0 + t1);
}

VecX locks(const Mechanism& mechanism, const ConstraintSystem& evaluated) {
  const Eigen::SparseMatrix<double> J =
      scaled_rows(evaluated.dense_jacobian(), mechanism.characteristic_length()).sparseView();
  const Eigen::SparseMatrix<double> A = J.transpose() * J;
  // In the order of the bodies, which no entry that is zero for a moment changes: pivots then change as smoothly as the pose.
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>> factors(A);
  // Pivots are squares of locks; the smallest is zero where A is singular, and only there.
  if (factors.info() != Eigen::Success) return VecX::Zero(A.cols());
  return (factors.vectorD().cwiseMax(0.0) / A.diagonal().maxCoeff()).cwiseSqrt();
}

double weakest_lock(const Mechanism& mechanism, const ConstraintSystem& evaluated) {
  return locks(mechanism, evaluated).minCoeff();
}

LostMotion lost_motion(const Mechanism& mechanism, const ConstraintSystem& evaluated, double t, bool with_pose) {
  const RankAnalysis rank = analyse_rank(mechanism, evaluated);
  const int body = mechanism.boresight_body();
  return {t,
          '"' + mechanism.description().bodies[body].name + "\" " +
              describe_motion(mechanism, rank.least_resisted, body) + " while " +
              (with_pose ? "the prescribed pose" : "every drive") + " stands still",
          rank.weakest / rank.largest};
}

std::vector<LostMotion> lost_motions(const Mechanism& mechanism, const IdealMotion& motion) {
  std::vector<LostMotion> lost;
  // The joints of an open chain, each with its drive, hold it everywhere.
  if (mechanism.joints() == mechanism.bodies() && !mechanism.description().motion.pose) return lost;
  Locks seen(mechanism, motion);
  const int looks = std::clamp(motion.knots() / kKnotsBetweenLooks, kFewestLooks, kMostLooks);
  const auto time = [&](int k) { return motion.duration() * k / looks; };
  std::vector<VecX> lock;
  for (int k = 0; k <= looks; ++k) {
    work_reached("looking for singular poses", static_cast<double>(k) / looks);
    lock.push_back(seen.at(time(k)));
  }
  // Each lock by itself: one that is weak everywhere, of a part that is far smaller than the mechanism, hides no other.
  std::vector<double> dips;
  for (Eigen::Index one = 0; one < lock.front().size(); ++one)
    for (int k = 0; k <= looks; ++k) {
      const int before = std::max(k - 1, 0), after = std::min(k + 1, looks);
      if (!may_be_zero_near(lock[k][one], lock[before][one], lock[after][one])) continue;
      // A pose that is singular for a while is one.
      if (k > 0 && lock[before][one] < kSingular && lock[k][one] < kSingular) continue;
      const double t = lock[k][one] < kSingular
                           ? time(k)
                           : weakest_between(time(before), time(after), [&](double at) { return seen.at(at)[one]; });
      if (seen.at(t)[one] <= kHeld) dips.push_back(t);
    }
  std::sort(dips.begin(), dips.end());
  double found = -1.0;
  for (const double t : dips) {
    if (found >= 0.0 && t - found < motion.duration() / looks) continue;
    LostMotion lost_there = seen.lost_at(t);
    if (!(lost_there.measure < kSingular)) continue;
    lost.push_back(std::move(lost_there));
    found = t;
  }
  return lost;
}

}  // namespace boresight
