// Clearance, restitution, chatter, friction: cases whose cause is the contact.
#include <algorithm>
#include <cmath>

#include "boresight/contact/modified_coulomb.hpp"
#include "boresight/contact/normal_law.hpp"
#include "boresight/integrate/explicit_runge_kutta.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/stability/failure_case.hpp"
#include "boresight_analyses/stability/text.hpp"

namespace boresight {
namespace {

double deepest(const RunResult& result) {
  double depth = 0.0;
  for (const ContactSummary& c : result.contact) depth = std::max(depth, c.max_penetration);
  return depth;
}

// All clearances times a factor, on the cheapest rung that follows: quasistatic, else the one with dynamics. Friction in the play likewise: it
// would stay as the play goes, and the ideal motion knows none.
RunResult with_clearance(const Scene& scene, const Rung& rung, double factor) {
  Parameters parameters = scene.mechanism->parameters();
  std::fill(parameters.error.begin(), parameters.error.end(), 0.0);  // they would stay where the play goes
  for (ClearanceParameters& c : parameters.clearance)
    for (const auto gap : kGaps) c.*gap *= factor;
  for (ClearanceParameters& c : parameters.clearance)
    for (const auto friction :
         {&FrictionParameters::coefficient, &FrictionParameters::static_coefficient, &FrictionParameters::viscosity})
      c.friction.*friction *= factor;
  RunOptions options = scene.followed->options(0.0);
  return rung.run(parameters, options);
}

// Whether impacts give back all that comes in, so that nothing comes to rest.
bool loses_nothing(const Mechanism& mechanism, int clearance) {
  const ClearanceDescription& d = mechanism.description().clearances[static_cast<std::size_t>(clearance)];
  const NormalLaw law = make_normal_law(d.contact_law, d.dissipation_law,
                                        mechanism.parameters().clearance[static_cast<std::size_t>(clearance)]);
  return law.damping_factor == 0.0 && law.dashpot == 0.0;
}

}  // namespace

FailureCase case_of_vanishing_clearance(const Scene& scene) {
  FailureCase c{.name = "Clearance towards zero",
                .happens = "the contact stiffness grows without bound, the depth goes to zero",
                .program = "tends to the ideal motion plus the Hertz deflection, friction going with it",
                .measured = {}};
  if (!scene.followed || scene.contacts.empty()) {
    c.measured = "no joint has clearance, or no rung follows the motion";
    return c;
  }
  double radial = 0.0;
  for (const ClearanceParameters& p : scene.mechanism->parameters().clearance)
    radial = std::max(radial, p.*carrying_gap(p));
  const auto measure = [&](const Rung& rung) {
    double lever = 0.0, least = 1e300;
    bool tends = true;
    c.measured = "position error, maximum (" + rung.name() + "):";
    for (double factor : {1.0, 1e-1, 1e-2, 1e-3}) {
      const RunResult result = with_clearance(scene, rung, factor);
      const double error = result.index.position_error.max, offset = factor * radial + deepest(result);
      if (lever == 0.0) lever = error / offset;
      // The error stays the same lever times clearance plus depth, within a factor of two: directions differ.
      tends = tends && error < least && error < 2.0 * lever * offset;
      least = error;
      c.measured += text(" %.3g m at c = %.2g m (depth %.2g m);", error, factor * radial, deepest(result));
    }
    c.measured.pop_back();
    c.standing = tends ? FailureCase::Standing::behaves : FailureCase::Standing::differs;
  };
  try {
    try {
      measure(*make_rung("quasistatic", scene.mechanism));
    } catch (const ComputationError&) {
      measure(*scene.followed->rung);
    }
  } catch (const ComputationError& stop) {
    c.measured = stop.what();
    c.standing = FailureCase::Standing::differs;
  }
  return c;
}

FailureCase case_of_vanishing_restitution(const Scene& scene) {
  FailureCase c{.name = "Restitution towards zero in Flores' law",
                .happens = "the damping grows without bound",
                .program = "refuses zero and names what is taken; near zero the dissipation stays finite",
                .measured = {}};
  if (scene.contacts.empty()) {
    c.measured = "no joint has clearance";
    return c;
  }
  const auto point = std::find_if(scene.contacts.begin(), scene.contacts.end(),
                                  [](const ContactFrequency& contact) { return contact.hertz_stiffness > 0.0; });
  if (point == scene.contacts.end()) {
    c.measured = "no joint's contact is Hertz's, which the law is for";
    return c;
  }
  const double stiffness = point->hertz_stiffness;
  const NormalLaw law{stiffness, normal_law("flores").damping_factor(1e-6)};
  const double depth = 1e-6, force = law.force(depth, 0.1, 1e-3);
  c.measured = text("at e = 1e-6 and 0.1 m/s a depth of 1 um gives %.3g N (elastic %.3g N), finite", force,
                    stiffness * std::pow(depth, 1.5));
  bool refused = !scene.reread;
  if (scene.reread) {
    const std::string& joint = point->joint;
    try {
      scene.reread({"clearance." + joint + ".contact.restitution", "0"});
      c.measured += "; zero was taken";
    } catch (const InputError& refusal) {
      refused = true;
      c.measured += std::string("; at zero: ") + refusal.what();
    }
  }
  // A law that takes zero may be the mechanism's own.
  c.standing = std::isfinite(force) ? (refused ? FailureCase::Standing::behaves : FailureCase::Standing::not_here)
                                    : FailureCase::Standing::differs;
  return c;
}

FailureCase case_of_chatter(const Scene& scene, const Settling& pair, const Settling& l_stable, double omega) {
  FailureCase c{.name = "Grazing and chatter",
                .happens = "approach speeds go to zero, events pile up",
                .program = "ends in lasting contact, and the step size recovers",
                .measured = {}};
  if (scene.contacts.empty()) {
    c.measured = "no joint has clearance";
    return c;
  }
  const auto sentence = [&](const Settling& s) {
    if (!s.completed) return s.method + ": " + s.why_not;
    return text(
        "%s: %ld contacts, then lasting contact from %.3g s on; smallest step %.2g s, up to %.3g s "
        "afterwards (%ld steps)",
        s.method.c_str(), s.contacts, s.settled_at, s.smallest_step, s.largest_step_settled / omega, s.steps);
  };
  c.measured = "a journal of " + scene.contacts[scene.stiffest()].joint +
               " dropped under its typical load: " + sentence(pair) + "; " + sentence(l_stable);
  if (loses_nothing(*scene.mechanism, scene.stiffest())) {
    c.measured += "; its contact law loses nothing, and it goes on bouncing";
    return c;
  }
  const auto recovered = [](const Settling& s, double least) {
    return s.completed && s.settled_at >= 0.0 && s.largest_step_settled > least;
  };
  // The explicit pair recovers up to what its stability allows, the L-stable method steps over the vibration.
  c.standing = recovered(pair, 0.5) && recovered(l_stable, 10.0) ? FailureCase::Standing::behaves
                                                                 : FailureCase::Standing::differs;
  return c;
}

FailureCase case_of_creep(const Scene& scene) {
  FailureCase c{.name = "Friction below its static speed",
                .happens = "modified Coulomb friction creeps under a static load",
                .program = "creeps at the speed that theory foresees, v_s + (v_d - v_s) F / (mu N)",
                .measured = {}};
  const auto& clearances = scene.mechanism->parameters().clearance;
  const auto rubbing =
      std::find_if(clearances.begin(), clearances.end(), [](const auto& p) { return p.friction.coefficient > 0.0; });
  if (rubbing == clearances.end()) {
    c.measured = "no joint with clearance has friction";
    return c;
  }
  const FrictionParameters& f = rubbing->friction;
  const ModifiedCoulomb law{f.coefficient, f.static_speed, f.dynamic_speed};
  // A unit mass under a unit normal force, pulled with half of what friction can hold; ten time constants of
  // the ramp.
  const double pull = 0.5 * f.coefficient, rate = f.coefficient / (f.dynamic_speed - f.static_speed);
  ExplicitRungeKutta method(classical_rk4(), 1);
  VecX v = VecX::Constant(1, f.static_speed);  // below which the ramp is as slow as the law makes it
  const auto derivative = [&](double, const VecX& y, VecX& dy) {
    dy[0] = pull - y[0] * law.force_per_velocity(std::abs(y[0]));
  };
  const double h = 0.05 / rate;
  for (int n = 0; n < 1000; ++n) {
    derivative(n * h, v, method.first_slope());
    method.step(n * h, h, v, derivative);
  }
  const double theory = f.static_speed + 0.5 * (f.dynamic_speed - f.static_speed);
  c.measured = text("under half the load that friction can hold it creeps at %.4g m/s, theory %.4g m/s", v[0], theory);
  c.standing = std::abs(v[0] / theory - 1.0) < 1e-3 ? FailureCase::Standing::behaves : FailureCase::Standing::differs;
  return c;
}

}  // namespace boresight
