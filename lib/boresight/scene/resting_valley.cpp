// Where journals come to rest along what holds nothing: of all balances there, the one nearest to where the ideal motion has them.
#include <cmath>

#include "boresight/math/dense_solves.hpp"
#include "boresight/scene/rest_search.hpp"
#include "boresight/scene/resting_start.hpp"

namespace boresight {
namespace {

// What pulls journals to where the ideal motion has them, of the load over a clearance: a push weaker than that takes no journal to the end of
// its play, so that no rounding decides whether it does. A bar of 1 g in a mechanism of 100 kg still falls through its play. The steps that it
// takes, and what of the pull these may leave.
constexpr double kPull = 1e-6, kPulled = 1e-6;
constexpr int kMostPulls = 100, kShortened = 3;

}  // namespace

// Newton's method, damped, for the energy with kPull |y|^2 / 2 added: that has one minimum where the energy has a valley.
bool RestingBalance::settle(VecX& z) const {
  const int n = at_.n;
  const double pull = kPull * load_;
  const auto over_widths = [&](const VecX& at) { return VecX(unit_.triangularView<Eigen::Upper>().solve(at)); };
  const auto pulled_energy = [&](const VecX& at) { return energy(at) + 0.5 * pull * over_widths(at).squaredNorm(); };
  VecX at = z, F(n);
  MatX J(n, n);
  const auto left_at = [&](const VecX& place) {
    evaluate(place, F, J);
    return VecX(unit_.transpose() * F - pull * over_widths(place));
  };
  VecX left = left_at(at);
  double E = pulled_energy(at), damping = 0.0;
  for (int step = 0; step < kMostPulls && left.norm() > kPulled * pull; ++step) {
    const MatX H = (damping + pull) * MatX::Identity(n, n) - MatX(unit_.transpose() * J * unit_);
    VecX dy = solve_square(H, left);
    const double reach = dy.norm();
    if (!std::isfinite(reach) || reach <= kSettledRest) break;
    if (reach > 1.0) dy /= reach;
    const VecX trial = at + unit_ * dy;
    const double E_trial = pulled_energy(trial), rounding = kRoundedEnergy * (std::abs(E) + load_);
    const MatX J_before = J;
    const VecX left_trial = left_at(trial);
    if (E_trial < E - rounding || (E_trial <= E + rounding && left_trial.norm() < left.norm())) {
      at = trial;
      E = E_trial;
      left = left_trial;
      damping = damping > pull ? 0.1 * damping : 0.0;
    } else {
      J = J_before;
      if (damping > load_) break;
      damping = std::max(10.0 * damping, pull);
    }
  }
  // The pull presses on contacts too. Which of them carry is known now: where they hold, without it.
  for (int step = 0; step < kShortened; ++step) {
    evaluate(at, F, J);
    const MatX H = -(unit_.transpose() * J * unit_), back = pseudo_inverse(H, kSoftContact);
    const VecX load = unit_.transpose() * F, y = over_widths(at);
    const VecX along = load - H * (back * load);  // what pushes along the valley
    at = unit_ * VecX(back * (load + H * y) + along / pull);
    if (!at.allFinite()) return false;
    const VecX there = unit_.transpose() * this->left(at);
    if (!((there - along).norm() <= kAcceptableLoad * load_)) return false;
  }
  z = at;
  return true;
}

// Of the balances that the contacts at z allow, to the shortest. allowed: what may be left; soft: stiffness below this share of the largest
// holds nothing.
void RestingBalance::shorten(VecX& z, double allowed, double soft) const {
  VecX at = z, F(at_.n);
  MatX J(at_.n, at_.n);
  for (int step = 0; step < kShortened; ++step) {
    evaluate(at, F, J);
    const MatX H = -(unit_.transpose() * J * unit_);
    const VecX y = unit_.triangularView<Eigen::Upper>().solve(at);
    at = unit_ * solve_least(H, VecX(unit_.transpose() * F + H * y), soft);
    if (!at.allFinite() || !(size(left(at)) <= allowed)) return;
    z = at;
  }
}

}  // namespace boresight
