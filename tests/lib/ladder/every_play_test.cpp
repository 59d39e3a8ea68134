// Every kind of joint that can have play, with every contact law and both kinds of axes, on every rung: a motion without a number that is none,
// or a refusal that says why. One table, made from the program's own lists.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "play_kinds.hpp"

namespace boresight {
namespace every_play_test {

using scenes::PlayKind;

struct Case {
  const PlayKind* kind;
  const NormalLawEntry* law;
  bool tilts;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.kind->name << ", " << c.law->name << (c.tilts ? ", free" : ", parallel");
}

std::vector<Case> every_case() {
  std::vector<Case> all;
  for (const PlayKind& kind : scenes::play_kinds())
    for (const NormalLawEntry& law : normal_laws())
      for (const bool tilts : {false, true})
        if (!tilts || kind.tilts) all.push_back({&kind, &law, tilts});
  return all;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  std::string name =
      std::string(info.param.kind->name) + "_" + info.param.law->name + (info.param.tilts ? "_free" : "_parallel");
  std::replace_if(
      name.begin(), name.end(), [](char letter) { return std::isalnum(static_cast<unsigned char>(letter)) == 0; }, '_');
  return name;
}

void expect_followed_or_refused(const Case& c, double duration, const std::vector<std::string>& formulations) {
  std::shared_ptr<const Mechanism> mechanism;
  try {
    mechanism = std::make_shared<const Mechanism>(
        scenes::play_mechanism(*c.kind, {.tilts = c.tilts, .law = c.law->name, .duration = duration}));
  } catch (const InputError& refusal) {
    // By line and key.
    EXPECT_EQ(std::string(refusal.what()).rfind("play.toml:", 0), 0u) << refusal.what();
    EXPECT_NE(std::string(refusal.what()).find("expected"), std::string::npos) << refusal.what();
    EXPECT_EQ(c.law->geometry, ContactGeometry::line) << refusal.what();
    return;
  }
  int followed = 0;
  for (const char* rung : {"envelope", "quasistatic", "perturbation", "multibody"})
    for (const std::string& formulation : formulations) {
      RunOptions options;
      if (rung == std::string("multibody"))
        options.formulation = formulation;
      else if (formulation != formulations.front())
        continue;
      try {
        const RunResult run = make_rung(rung, mechanism)->run(mechanism->parameters(), options);
        ++followed;
        EXPECT_DOUBLE_EQ(run.end_time, duration) << rung << formulation;
        std::vector<double> numbers = {run.index.position_error.max, run.index.position_error.rms,
                                       run.index.orientation_error.max};
        for (const ContactSummary& contact : run.contact)
          numbers.insert(numbers.end(), {contact.max_force, contact.max_penetration, contact.contact_fraction});
        for (const double number : numbers) EXPECT_TRUE(std::isfinite(number)) << rung << formulation;
        EXPECT_GT(run.index.position_error.max, 0.0) << rung << formulation;
      } catch (const ComputationError& refusal) {
        EXPECT_GT(std::string(refusal.what()).size(), 40u) << rung << formulation;
        EXPECT_TRUE(rung == std::string("envelope") || rung == std::string("quasistatic"))
            << rung << ": " << refusal.what();
      }
    }
  EXPECT_GE(followed, 1 + static_cast<int>(formulations.size()));  // dynamics of every kind
}

class EveryPlay : public testing::TestWithParam<Case> {};

TEST_P(EveryPlay, IsFollowedOrRefusedWithAReasonOnEveryRung) {
  expect_followed_or_refused(GetParam(), 0.1, {"tree", "paper"});
}

INSTANTIATE_TEST_SUITE_P(Ladder, EveryPlay, testing::ValuesIn(every_case()), name_of);

// Ten times as long: with what comes after the first impacts. A few seconds of processor time a case, most of them the two static rungs', which
// measure their error by dynamics.
TEST(EveryPlayNight, IsFollowedForASecond) {
  for (const Case& c : every_case()) {
    SCOPED_TRACE(testing::PrintToString(c));
    expect_followed_or_refused(c, 1.0, {"tree"});
  }
}

}  // namespace every_play_test
}  // namespace boresight
