// The envelope where redundant joints tie plays together: it bounds every place that the gaps leave, and is near the worst of them.
#include "boresight/statics/tied_gaps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/statics/tied_rest.hpp"
#include "scenes.hpp"
#include "two_bearing_scenes.hpp"

namespace boresight {
namespace tied_gaps_test {

// By how much the gaps are overrun with the journals at z: 1 at their edge. Each sleeve's ends and faces by themselves, without the parts
// that the envelope is made of.
double overrun(const RestingBalance& balance, const std::vector<RestingPlay>& rest,
               const std::vector<ClearanceParameters>& play, const VecX& z) {
  double most = 0.0;
  for (std::size_t c = 0; c < rest.size(); ++c) {
    const PlayOffsets at = balance.offset_gain(c) * z + balance.offset_shift(c);
    for (const int side : {0, 1}) {
      const double reach = (side == 0 ? -0.5 : 0.5) * play[c].sleeve_length;
      most = std::max(most, std::hypot(at[0] + reach * at[3], at[2] + reach * at[4]) / rest[c].radial_reach[side]);
    }
    if (rest[c].axial_reach > 0.0) most = std::max(most, std::abs(at[1]) / rest[c].axial_reach);
  }
  return most;
}

// The largest |G z| that a search from many random directions meets: climbing by random steps, at the edge of the gaps.
template <typename Overrun>
double largest_met(const TiedGaps::Gain& G, const MatX& unit, const Overrun& overrun_by) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return VecX(unit * VecX::NullaryExpr(unit.cols(), [&] { return normal(random); })); };
  const auto reached = [&](const VecX& z) { return (G * z).norm() / overrun_by(z); };
  double largest = 0.0;
  for (int start = 0; start < 20; ++start) {
    VecX z = draw();
    double best = reached(z), step = 0.5;
    for (int k = 0; k < 3000; ++k) {
      z /= overrun_by(z);
      const VecX trial = z + step * draw();
      if (const double there = reached(trial); there > best) {
        best = there;
        z = trial;
      } else {
        step = std::max(0.99 * step, 1e-3);
      }
    }
    largest = std::max(largest, best);
  }
  return largest;
}

TEST(TiedGaps, TheBoundHoldsForEveryPlaceInTheGapsAndIsNearTheWorst) {
  const auto mechanism = scenes::build(scenes::gimbal_by_shorthand());
  const Parameters& parameters = mechanism->parameters();
  const PreparedScene prepared(*mechanism, ideal_motion(*mechanism, parameters), parameters);
  const StandingDisplacement none;
  const ReactionTable reactions(*mechanism, prepared, none, parameters);
  ASSERT_TRUE(reactions.tied());
  TiedRest tied(prepared, none, parameters, reactions);
  TiedGaps gaps;
  TiedRest::Rest before;
  for (const double t : {0.0, 0.02, 0.05}) {
    const ReactionTable::Instant now = reactions.at_time(t);
    const TiedRest::Rest rest = tied.at(now, t == 0.0 ? nullptr : &before);
    before = rest;
    gaps.take(tied.balance(), rest.joint);
    const auto overrun_by = [&](const VecX& z) { return overrun(tied.balance(), rest.joint, parameters.clearance, z); };
    EXPECT_LT(overrun_by(rest.z), 1.001);
    const TiedGaps::Gain moves = now.pose_gain.topRows<3>(), turns = now.pose_gain.bottomRows<3>();
    int quantity = 0;
    for (const TiedGaps::Gain& G : {moves, turns}) {
      const double bound = gaps.bound(G, quantity++), met = largest_met(G, tied.balance().unit(), overrun_by);
      EXPECT_LE(met, bound * (1.0 + 1e-9)) << t;
      // Plays that displace across each other count as if all displaced the same way: here those along the two shafts and across them.
      EXPECT_GT(met, (quantity == 1 ? 0.65 : 0.98) * bound) << t;
      // What is drawn for it is a place in the gaps.
      const VecX place = gaps.place(G, G * rest.z);
      EXPECT_LT(overrun_by(place), 1.0 + 1e-9) << t;
      EXPECT_GT((G * place).norm(), 0.3 * met) << t;
    }
  }
}

// Impacts press journals farther in than their rest does: by no more than their penetration.
TEST(TiedGaps, TheEnvelopeOfAGimbalInBearingPairsIsAboveItsMotion) {
  const auto mechanism = scenes::build(scenes::from_corpus("gimbal-in-bearing-pairs"));
  const RunResult bound = make_rung("envelope", mechanism)->run(mechanism->parameters(), {});
  for (const char* rung : {"quasistatic", "perturbation", "multibody"}) {
    const RunResult motion = make_rung(rung, mechanism)->run(mechanism->parameters(), {});
    EXPECT_GT(bound.index.position_error.max, motion.index.position_error.max) << rung;
    EXPECT_GT(bound.index.orientation_error.max, motion.index.orientation_error.max) << rung;
    EXPECT_GT(bound.index.boresight_error.max, motion.index.boresight_error.max) << rung;
  }
}

}  // namespace tied_gaps_test
}  // namespace boresight
