// Steps and stabilisation: cases whose cause is the integrator.
#include <algorithm>
#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/pointing/relative_text.hpp"
#include "boresight/stepping/unstable_step.hpp"
#include "boresight_analyses/stability/failure_case.hpp"
#include "boresight_analyses/stability/text.hpp"

namespace boresight {

FailureCase case_of_a_large_step(const Scene& scene) {
  FailureCase c{.name = "RK4 above h = 2.785 / contact frequency",
                .happens = "blows up between contacts",
                .program =
                    "stops, names the contact, its frequency and the largest stable step; no result is ever "
                    "not a number",
                .measured = {}};
  if (!scene.followed || scene.stiffest() < 0) {
    c.measured = "no contact: no joint has clearance, or no rung follows the motion";
    return c;
  }
  // Twice as long, again and again, until a contact proves too stiff for it.
  const ContactFrequency& stiffest = scene.contacts[scene.stiffest()];
  double step = stiffest.largest_stable_step;
  for (int doubled = 0; doubled < 6; ++doubled, step *= 2.0) {
    try {
      const RunResult result = scene.followed->rung->run(scene.mechanism->parameters(), scene.followed->options(step));
      if (!std::isfinite(result.index.position_error.max) || !std::isfinite(result.index.position_error.rms)) {
        c.measured = text("with h = %.3g s the result is not finite", step);
        c.standing = FailureCase::Standing::differs;
        return c;
      }
    } catch (const ComputationError& stop) {
      c.measured = scene.followed->rung->name() + " with h = " + text("%.3g s", step) + " stopped: " + stop.what();
      const bool named = dynamic_cast<const UnstableStep*>(&stop) != nullptr;
      c.standing = named ? FailureCase::Standing::behaves : FailureCase::Standing::differs;
      return c;
    }
  }
  c.measured =
      text("no contact of this motion was hard enough to stop steps up to %.3g s; results stayed finite", 0.5 * step);
  return c;
}

FailureCase case_of_no_stabilisation(const Scene& scene) {
  FailureCase c{.name = "No stabilisation of the constraints",
                .happens = "constraint drift grows, without bound, as up to the square of the time",
                .program = "reports the drift; projection is available, and is what the default formulation does",
                .measured = {}};
  if (!scene.ideal || !scene.followed) {
    c.measured = "the motion cannot be followed";
    return c;
  }
  const Mechanism& mechanism = *scene.mechanism;
  const auto rung = make_rung("multibody", scene.mechanism);
  const double until = std::min(scene.followed->until, 2e4 * scene.followed->step);
  const auto drift = [&](double share, const char* stabilisation, double gain) {
    RunOptions options;
    options.step = scene.followed->step;
    options.sample_spacing = 0.0;
    options.events = false;
    options.formulation = "paper";
    options.stabilisation = stabilisation;
    options.baumgarte_alpha = options.baumgarte_beta = gain;
    options.progress = [until = share * until](const RunProgress& p) { return p.t < until; };
    return rung->run(mechanism.parameters(), options).constraint_drift;
  };
  try {
    const double quarter = drift(0.25, "baumgarte", 0.0), half = drift(0.5, "baumgarte", 0.0),
                 whole = drift(1.0, "baumgarte", 0.0);
    const double projected = drift(0.25, "projection", 0.0);
    // A power of the time that the drift follows between a quarter and the whole.
    const double power = quarter > 0.0 ? std::log(whole / quarter) / std::log(4.0) : 0.0;
    c.measured = text(
        "with both gains zero the constraints are off by %.2g, %.2g, %.2g m or rad after %.3g, %.3g, %.3g s "
        "(as t^%.1f); "
        "with projection by %.2g",
        quarter, half, whole, 0.25 * until, 0.5 * until, until, power, projected);
    c.standing = whole >= half && half >= quarter && projected <= 1e-9 * mechanism.characteristic_length()
                     ? FailureCase::Standing::behaves
                     : FailureCase::Standing::differs;
  } catch (const ComputationError& stop) {
    c.measured = std::string("multibody cannot follow this motion: ") + stop.what();
  }
  return c;
}

FailureCase case_of_baumgarte_gains(const BaumgarteMap& map) {
  FailureCase c{.name = "Baumgarte's gains times the step too large",
                .happens = "the model is stable, the solver is not",
                .program = "draws the map of the drift per step over both gains times the step, with its limits",
                .measured = {}};
  double worst = 0.0;
  for (const BaumgarteLimit& limit : map.limits) worst = std::max(worst, off_theory(limit.measured, limit.theory));
  if (map.limits.empty()) {
    c.measured = "the constraints of this motion cannot be stepped";
    return c;
  }
  if (std::isinf(worst)) {
    c.measured =
        text("of %zu limits along rays of alpha/beta one is not where theory has it, nor near", map.limits.size());
    c.standing = FailureCase::Standing::differs;
    return c;
  }
  c.measured = text("%zu limits along rays of alpha/beta, from the drift of %s, differ from theory by at most ",
                    map.limits.size(), map.joint.c_str()) +
               relative_text(worst);
  c.standing = worst <= 0.02 ? FailureCase::Standing::behaves : FailureCase::Standing::differs;
  return c;
}

}  // namespace boresight
