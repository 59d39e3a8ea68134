// Chance and linearisation: cases whose cause is what a model can foretell at all.
#include <algorithm>
#include <cmath>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/pointing/relative_text.hpp"
#include "boresight_analyses/stability/failure_case.hpp"
#include "boresight_analyses/stability/text.hpp"

namespace boresight {

FailureCase case_of_chaos(const Scene& scene, const std::vector<Separation>& separations) {
  FailureCase c{.name = "Impacts are chaotic",
                .happens = "trajectories part, statistics hold",
                .program = "reports how far ahead this motion can be foretold; judges convergence on the index",
                .measured = {}};
  if (!scene.followed || separations.empty()) {
    c.measured = "no joint has clearance, or no rung follows the motion";
    return c;
  }
  double worst = 0.0;
  bool parts = false;
  for (const Separation& s : separations) {
    worst = std::max(worst, s.rms_difference);
    parts = parts || s.horizon >= 0.0;
    if (s.horizon >= 0.0)
      c.measured += text("a difference of %.0e in the clearance parts the trajectories by a tenth of it after %.3g s; ",
                         s.start, s.horizon);
    else
      c.measured += text("a difference of %.0e never parts them by a tenth of the clearance; ", s.start);
  }
  c.measured += "the RMS error over the run differs by at most " + relative_text(worst);
  c.standing = !parts        ? FailureCase::Standing::not_here
               : worst < 0.1 ? FailureCase::Standing::behaves
                             : FailureCase::Standing::differs;
  return c;
}

FailureCase case_of_large_clearance(const Scene& scene) {
  FailureCase c{.name = "Large clearance",
                .happens = "perturbation loses accuracy",
                .program = "the rung's own estimate sees it, and the choice of rung climbs to multibody",
                .measured = {}};
  if (!scene.followed || scene.contacts.empty()) {
    c.measured = "no joint has clearance, or no rung follows the motion";
    return c;
  }
  const auto perturbation = make_rung("perturbation", scene.mechanism);
  double before = 0.0;
  bool grows = true;
  for (double factor : {1.0, 10.0}) {
    Parameters parameters = scene.mechanism->parameters();
    for (ClearanceParameters& p : parameters.clearance) {
      for (const auto gap : kGaps) p.*gap *= factor;
      p.cap_radius = std::max(p.cap_radius, 1.2 * (p.journal_radius + p.radial));
    }
    try {
      const RunResult result = perturbation->run(parameters, scene.followed->options(0.0));
      c.measured += text("%s%g times the clearance: perturbation's own estimate of its model error ",
                         before > 0.0 ? "; " : "", factor) +
                    relative_text(result.error.largest_model());
      grows = grows && result.error.largest_model() > before;
      before = result.error.largest_model();
      if (factor == 1.0) continue;
      const RunResult exact = make_rung("multibody", scene.mechanism)->run(parameters, scene.followed->options(0.0));
      const double off = std::abs(result.index.position_error.rms / exact.index.position_error.rms - 1.0);
      c.measured += ", its RMS error off by " + relative_text(off) + " from multibody's";
    } catch (const ComputationError& stop) {
      c.measured += text("%s%g times the clearance: refused: ", before > 0.0 ? "; " : "", factor) + stop.what();
    }
  }
  c.standing = before == 0.0 ? FailureCase::Standing::not_here
               : grows       ? FailureCase::Standing::behaves
                             : FailureCase::Standing::differs;
  return c;
}

}  // namespace boresight
