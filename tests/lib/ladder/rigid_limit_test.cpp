// Play of every kind against rigid bodies: a body that falls through its play and bounces, as Newton's restitution says, to which its
// contacts come as their stiffness grows; the ideal joint, to which it comes as the gap goes; and the energy that it keeps.
//
// Rigid: bodies on a line, each within `gap` of the one before it, the first within that of the ground; between impacts all fall alike. At an
// impact the two that meet part with e times the speed at which they met (Newton), momentum kept. Followed from event to event, exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "play_kinds.hpp"
#include "scenes.hpp"

namespace boresight {
namespace rigid_limit_test {

using scenes::PlayKind;

constexpr double kGravity = 9.81, kGap = 0.1e-3, kRestitution = 0.6;
constexpr const char* kAtTheJoint = "[\"0 mm\", \"0 mm\", \"0 mm\"]";

struct RigidImpact {
  double t = 0.0;
  std::size_t gap = 0;  // which of them
};

// The first `count` impacts of bodies that start in the middle of their gaps.
std::vector<RigidImpact> rigid_impacts(const std::vector<double>& mass, std::size_t count) {
  struct Body {
    double z = 0.0, v = 0.0;
  };
  std::vector<Body> body(mass.size());
  std::vector<RigidImpact> impacts;
  double t = 0.0;
  while (impacts.size() < count) {
    double next = 1e300;
    std::size_t which = 0;
    for (std::size_t k = 0; k < body.size(); ++k) {
      // Relative to the one before: at acceleration a, where |z + v s + a s^2 / 2| = gap next.
      const double z = body[k].z - (k > 0 ? body[k - 1].z : 0.0), v = body[k].v - (k > 0 ? body[k - 1].v : 0.0);
      const double a = k > 0 ? 0.0 : -kGravity;
      for (const double side : {-1.0, 1.0}) {
        const double off = z - side * kGap;
        std::vector<double> roots;
        if (a == 0.0) {
          if (v != 0.0) roots = {-off / v};
        } else if (const double d = v * v - 2.0 * a * off; d >= 0.0) {
          roots = {(-v - std::sqrt(d)) / a, (-v + std::sqrt(d)) / a};
        }
        for (const double s : roots)
          if (s > 1e-12 && s < next && side * (v + a * s) > 0.0) next = s, which = k;
      }
    }
    for (Body& b : body) {
      b.z += b.v * next - 0.5 * kGravity * next * next;
      b.v -= kGravity * next;
    }
    t += next;
    impacts.push_back({t, which});
    if (which == 0) {
      body[0].v *= -kRestitution;
      continue;
    }
    Body &one = body[which - 1], &other = body[which];
    const double share = mass[which] / (mass[which - 1] + mass[which]);
    const double jump = -(1.0 + kRestitution) * (other.v - one.v);
    one.v -= share * jump;
    other.v += (1.0 - share) * jump;
  }
  return impacts;
}

struct Case {
  const PlayKind* kind;
  bool tilts;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.kind->name << (c.tilts ? ", free" : ", parallel"); }

std::vector<Case> every_case() {
  std::vector<Case> all;
  for (const PlayKind& kind : scenes::play_kinds())
    for (const bool tilts : {false, true})
      if (!tilts || kind.tilts) all.push_back({&kind, tilts});
  return all;
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return std::string(info.param.kind->name) + (info.param.tilts ? "_free" : "_parallel");
}

class PlayOfEveryKind : public testing::TestWithParam<Case> {};

// What contacts take beyond no time at all goes as 1 / stiffness^0.4 (Hertz) or 1 / stiffness^0.5 (linear): a hundred times the stiffness
// leaves a sixth to a tenth of it.
TEST_P(PlayOfEveryKind, BouncesAsRigidBodiesDoAsItsStiffnessGrows) {
  const bool crossed = std::string(GetParam().kind->type) == "universal";
  const std::vector<RigidImpact> rigid =
      rigid_impacts(crossed ? std::vector<double>{0.5, 2.0} : std::vector<double>{2.0}, 3);
  for (const char* rung : {"multibody", "perturbation"}) {
    double before = 0.0, penetration_before = 0.0;
    for (const double scale : {1.0, 1e2, 1e4}) {
      const auto mechanism =
          scenes::build(scenes::play_mechanism(*GetParam().kind, {.gap = kGap,
                                                                  .tilts = GetParam().tilts,
                                                                  .law = "exact",
                                                                  .restitution = kRestitution,
                                                                  .friction = 0.0,
                                                                  .stiffness_scale = scale,
                                                                  .center_of_mass = kAtTheJoint,
                                                                  .driven = false,
                                                                  .centred = true,
                                                                  .duration = rigid.back().t + 1e-3}));
      RunOptions options;
      options.integrator = "dopri5";
      options.tolerance = 1e-6;
      const RunResult run = make_rung(rung, mechanism)->run(mechanism->parameters(), options);
      // The bearings of a pair strike as one.
      std::vector<ContactEvent> events = run.events;
      if (!crossed) std::erase_if(events, [](const ContactEvent& e) { return e.clearance > 0; });
      std::sort(events.begin(), events.end(), [](const auto& a, const auto& b) { return a.start < b.start; });
      events.erase(std::unique(events.begin(), events.end(),
                               [](const auto& a, const auto& b) {
                                 return a.clearance == b.clearance && b.start - a.start < 1e-6;
                               }),
                   events.end());
      ASSERT_GE(events.size(), rigid.size()) << rung << ' ' << scale;
      double late = 0.0, deepest = 0.0;
      for (std::size_t k = 0; k < rigid.size(); ++k) {
        EXPECT_EQ(events[k].clearance, static_cast<int>(rigid[k].gap)) << rung << ' ' << scale;
        late = std::max(late, std::abs(events[k].start - rigid[k].t));
        deepest = std::max(deepest, events[k].max_penetration);
      }
      if (before > 0.0) {
        EXPECT_GT(before / late, 5.0) << rung << ' ' << scale;
        EXPECT_GT(penetration_before / deepest, 5.0) << rung << ' ' << scale;
      }
      before = late;
      penetration_before = deepest;
    }
    EXPECT_LT(before, 1e-3 * rigid.back().t) << rung;
  }
}

// What is left as the gap goes is what the contacts give way by.
TEST_P(PlayOfEveryKind, ApproachesTheIdealJointAsItsGapGoes) {
  for (const char* rung : {"perturbation", "multibody"}) {
    const auto error = [&](double gap) {
      const auto mechanism = scenes::build(scenes::play_mechanism(
          *GetParam().kind,
          {.gap = gap, .tilts = GetParam().tilts, .friction = 0.0, .stiffness_scale = 10.0, .duration = 0.05}));
      return make_rung(rung, mechanism)->run(mechanism->parameters(), {}).index.position_error.max;
    };
    for (const double gap : {1e-4, 1e-5, 1e-6}) {
      EXPECT_GT(error(gap), 0.9 * gap) << rung << ' ' << gap;
      EXPECT_LT(error(gap), 6.0 * gap) << rung << ' ' << gap;
    }
    EXPECT_LT(error(1e-9), 1e-6) << rung;
  }
}

// Nothing drives it, dissipates or rubs: what it has of energy stays through all its impacts, as far as steps follow them.
TEST_P(PlayOfEveryKind, KeepsItsEnergyWhereNothingDissipates) {
  const auto mechanism = scenes::build(scenes::play_mechanism(*GetParam().kind, {.tilts = GetParam().tilts,
                                                                                 .law = "hertz",
                                                                                 .friction = 0.0,
                                                                                 .driven = false,
                                                                                 .centred = true,
                                                                                 .duration = 0.05}));
  for (const char* formulation : {"tree", "paper"}) {
    const auto lost = [&](double tolerance) {
      RunOptions options;
      options.formulation = formulation;
      options.integrator = "dopri5";
      options.tolerance = tolerance;
      const RunResult run = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
      EXPECT_GT(run.contact[0].impacts, 2);
      return run.energy_error;
    };
    const double coarse = lost(1e-8), fine = lost(1e-10);
    EXPECT_LT(fine, 1e-6) << formulation;
    EXPECT_GT(coarse / fine, 5.0) << formulation;
  }
}

INSTANTIATE_TEST_SUITE_P(Ladder, PlayOfEveryKind, testing::ValuesIn(every_case()), name_of);

}  // namespace rigid_limit_test
}  // namespace boresight
