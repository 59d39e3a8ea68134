#include "conservation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "measure.hpp"
#include "sandbox.hpp"

namespace boresight::gauntlet {
namespace {

constexpr double kMomentumTolerance = 1e-5;  // of the sum of the parts, at the rung's own step or a quarter of it
constexpr double kFiner = 4.0;
constexpr double kEnergyTolerance =
    1e-6;  // of the kinetic energy, at a two-thousandth of the motion or a quarter of that
constexpr int kEnergySteps = 2000;

}  // namespace

// Nothing holds it and nothing pulls at it from outside: its momentum is what it was, contacts and all.
void check_momentum(const std::shared_ptr<const Mechanism>& mechanism, const Limits& limits, Verdict& verdict) {
  const MechanismDescription& m = mechanism->description();
  if (m.gravity.norm() > 0.0 || !m.loads.empty()) return;
  for (const JointDescription& j : m.joints)
    if (j.first == kGround || j.second == kGround) return;
  for (const SpringDescription& s : m.springs)
    if (s.first == kGround || s.second == kGround) return;
  for (const char* formulation : {"tree", "paper"}) {
    const Outcome outcome = in_sandbox(
        limits, [&] { return momentum_change(mechanism, {.rung = "multibody", .formulation = formulation}); });
    verdict.cpu_seconds += outcome.cpu_seconds;
    if (outcome.end != Outcome::End::answered) continue;  // the comparison of rungs has met it
    const double change = outcome.answer["change"], step = outcome.answer["step"];
    if (change <= kMomentumTolerance) continue;
    // Of the steps, then it falls with them at least in proportion; a force without its reaction stays.
    const Outcome finer = in_sandbox(limits, [&] {
      return momentum_change(mechanism, {.rung = "multibody", .formulation = formulation, .step = step / kFiner});
    });
    verdict.cpu_seconds += finer.cpu_seconds;
    const double left = finer.end == Outcome::End::answered ? finer.answer["change"].get<double>() : change;
    if (left > std::min(kMomentumTolerance, change / kFiner))
      verdict.fault("momentum", std::string("multibody ") + formulation,
                    fmt::format("changes by {:.2g} of its parts, {:.2g} with steps of a quarter", change, left));
  }
}

// Nothing drives or loads it: without play its energy stays, or with dampers only falls.
void check_energy(const std::shared_ptr<const Mechanism>& mechanism, const Limits& limits, Verdict& verdict) {
  const MechanismDescription& m = mechanism->description();
  if (!m.loads.empty() || m.motion.pose || !m.motion.drives.empty()) return;
  bool damped = false;
  for (const SpringDescription& s : m.springs) damped = damped || s.parameters.damping > 0.0;
  const auto changes = [&](int steps) {
    Outcome outcome = in_sandbox(limits, [&] { return energy_change(mechanism, steps); });
    verdict.cpu_seconds += outcome.cpu_seconds;
    return outcome;
  };
  const auto change_of = [&](const Json& energy) {
    const Json& change = energy[damped ? "rise" : "change"];
    return change.is_null() ? 1e300 : change.get<double>();
  };
  const Outcome outcome = changes(kEnergySteps);
  if (outcome.end == Outcome::End::refused) verdict.refusals.push_back({"energy", outcome.reason});
  if (outcome.end == Outcome::End::crashed) verdict.fault("crash", "energy", outcome.reason);
  if (outcome.end == Outcome::End::out_of_time) verdict.fault("hang", "energy", outcome.reason);
  if (outcome.end != Outcome::End::answered) return;
  std::optional<Outcome> finer;
  for (const auto& [formulation, energy] : outcome.answer.items()) {
    const double change = change_of(energy);
    if (change <= kEnergyTolerance) continue;
    // Of the steps, then it falls with them; what a force does without its reaction, or a constraint, stays.
    if (!finer) finer = changes(static_cast<int>(kFiner) * kEnergySteps);
    const double left = finer->end == Outcome::End::answered ? change_of(finer->answer[formulation]) : change;
    if (left > std::min(kEnergyTolerance, change / kFiner))
      verdict.fault("energy", formulation,
                    fmt::format("{} by {:.2g} of the kinetic energy, {:.2g} with steps of a quarter",
                                damped ? "rises" : "changes", change, left));
  }
}

}  // namespace boresight::gauntlet
