// Every way of computing a mechanism's motion that the chart tries: rungs, formulations, integrators, each
// from coarse to fine.
#pragma once

#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/study/measurement.hpp"

namespace boresight {

// Ways that differ in how finely they step only, coarsest first: one line on the chart.
struct SetupFamily {
  std::string name;
  std::vector<RungSetup> setups;
};

// own_step: of RK4, as multibody chooses it [s]; steps are taken around it, tolerances from 0.1 to 1e-5. The
// rungs' integrators come from integrator_choice.hpp, so that a new one needs no line here.
std::vector<SetupFamily> chart_setups(double own_step);

// Sun, Song, Wang (section 4): absolute coordinates, Baumgarte's stabilisation with 40 and 50 1/s, RK4 with
// 1e-4 s.
RungSetup papers_setup();

// "h = 50 us", "tolerance 1e-3", "no steps".
std::string fineness(const RungSetup& setup);

}  // namespace boresight
