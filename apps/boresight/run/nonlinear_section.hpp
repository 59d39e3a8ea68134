// What `run --nonlinear PERIOD` adds: Poincare section, phase portrait and largest Lyapunov exponent of each
// clearance joint.
#pragma once

#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"
#include "boresight_analyses/nonlinear/lyapunov.hpp"
#include "report/document.hpp"
#include "results/summary.hpp"

namespace boresight::app {

struct JointDynamics {
  std::string joint;
  int clearance = 0;
  StateSeries series;  // x, z of the journal's centre in the sleeve [m], then their rates [m/s]
  MatX section;        // once a period
  int period = 0;      // of the motion in drive periods; 0: does not come back
  Divergence divergence;
};

struct NonlinearAnalysis {
  double period = 0.0;  // of the drive [s]
  int periods = 0;      // followed
  int skipped = 0;      // left out at the start
  std::vector<JointDynamics> joints;
};

// The sample spacing that lays whole samples on the period, no coarser than asked.
double spacing_on_period(double asked, double period);

// Throws InputError where the motion has fewer than ten periods or no clearance.
void check_period(const Mechanism& mechanism, double period);

NonlinearAnalysis analyse_nonlinear(const Mechanism& mechanism, const RunResult& result, double period);

report::Section nonlinear_section(const NonlinearAnalysis& analysis, const Mechanism& mechanism);
Json nonlinear_json(const NonlinearAnalysis& analysis);
// joint, t, x, z, vx, vz: the section.
void write_section(std::ostream& out, const NonlinearAnalysis& analysis);

}  // namespace boresight::app
