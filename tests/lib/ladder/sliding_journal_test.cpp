// Journals that slide along their axes stand where the others' play has them, on every rung: along a tilted journal that decides where its
// sleeve's ends push.
#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"

namespace boresight {
namespace sliding_journal_test {

// Play in C1, which turns and slides, and in F1 beside it, whose play moves it along; the sleeve of C1 is short.
std::shared_ptr<const Mechanism> rrcpr_with_play_in_C1_and_F1() {
  MechanismDescription m = scenes::rrcpr();
  m.journals = JournalStart::rest;
  m.motion.duration = 5e-3;
  ClearanceDescription& F = m.clearances.front();
  F.axes = JournalAxes::free;
  ClearanceDescription C = F;
  for (std::size_t j = 0; j < m.joints.size(); ++j)
    if (m.joints[j].name == "C1") C.joint = static_cast<int>(j);
  C.journal = m.joints[static_cast<std::size_t>(C.joint)].second;
  C.parameters.axial = C.parameters.cap_radius = 0.0;
  C.parameters.sleeve_length = 0.02;
  m.clearances.push_back(C);
  return scenes::build(std::move(m));
}

TEST(SlidingJournal, StandsWhereTheOthersHaveItOnEveryRung) {
  const auto mechanism = rrcpr_with_play_in_C1_and_F1();
  const auto start = [&](const char* rung) {
    return make_rung(rung, mechanism)->run(mechanism->parameters(), {}).clearances[1].front().offset;
  };
  const Vec3 exact = start("multibody"), linear = start("perturbation"), resting = start("quasistatic");
  EXPECT_GT(std::abs(exact.y()), 1e-4);
  for (const Vec3& offset : {linear, resting}) EXPECT_LT((offset - exact).norm(), 5e-3 * exact.norm());
}

}  // namespace sliding_journal_test
}  // namespace boresight
