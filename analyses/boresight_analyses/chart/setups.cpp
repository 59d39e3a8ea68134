#include "boresight_analyses/chart/setups.hpp"

#include <array>
#include <cstdio>

#include "boresight/ladder/ladder.hpp"
#include "boresight/rungs/integrator_choice.hpp"
#include "boresight/stepping/unstable_step.hpp"

namespace boresight {
namespace {

// Of a fixed step, against the rung's own; of a tolerance.
constexpr double kShares[] = {8.0, 4.0, 2.0, 1.0, 0.5, 0.25};
constexpr double kTolerances[] = {1e-1, 1e-2, 1e-3, 1e-4, 1e-5};

SetupFamily family_of(RungSetup setup, double own_step) {
  SetupFamily family{setup.family(), {}};
  if (setup.stepless()) {
    family.setups = {setup};
  } else if (setup.integrator == "rk4") {
    for (double share : kShares) {
      setup.step = share * own_step;
      family.setups.push_back(setup);
    }
  } else {
    for (double tolerance : kTolerances) {
      setup.tolerance = tolerance;
      family.setups.push_back(setup);
    }
  }
  return family;
}

}  // namespace

std::vector<SetupFamily> chart_setups(double own_step) {
  std::vector<SetupFamily> families;
  const auto add = [&](const RungSetup& setup) { families.push_back(family_of(setup, own_step)); };
  for (const std::string& rung : rung_names()) {
    if (RungSetup{.rung = rung}.stepless()) add({.rung = rung});
    if (rung != "multibody") {
      for (const std::string& integrator : integrator_names(rung)) add({.rung = rung, .integrator = integrator});
      continue;
    }
    // Each formulation with its own habit; with RK4 the other's too. The cheaper formulation first: time may
    // run out.
    for (const auto& [formulation, habit, other] :
         {std::array{"tree", "projection", "baumgarte"}, std::array{"paper", "baumgarte", "projection"}}) {
      for (const std::string& integrator : integrator_names(rung))
        add({.rung = rung, .formulation = formulation, .stabilisation = habit, .integrator = integrator});
      add({.rung = rung, .formulation = formulation, .stabilisation = other, .integrator = "rk4"});
    }
  }
  return families;
}

RungSetup papers_setup() {
  return {.rung = "multibody",
          .formulation = "paper",
          .stabilisation = "baumgarte",
          .integrator = "rk4",
          .step = kPaperStep};
}

std::string fineness(const RungSetup& setup) {
  char text[60];
  if (setup.stepless()) return "no steps";
  if (setup.tolerance > 0.0)
    std::snprintf(text, sizeof text, "tolerance %.3g", setup.tolerance);
  else
    std::snprintf(text, sizeof text, "h = %.4g us", 1e6 * setup.step);
  return text;
}

}  // namespace boresight
