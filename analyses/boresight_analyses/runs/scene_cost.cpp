#include "boresight_analyses/runs/scene_cost.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/lanes/scene_for_lanes.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/offset_choice.hpp"
#include "boresight/scene/scene_rung.hpp"
#include "boresight_analyses/runs/counted_cost.hpp"

namespace boresight {
namespace {

constexpr double kSecondsOfSum = 1e-9;
// Of a step of the ideal motion, which a second run confirms.
constexpr double kEvaluationsOfKnot = 2.0 * 7.0;

// Sums and products, by the table that the header prints.
struct SceneSums {
  double knot = 0.0, row = 0.0, tipping = 0.0, closure = 0.0;

  SceneSums(const Mechanism& mechanism, const PreparedScene& prepared) {
    const double b = mechanism.bodies(), j = mechanism.joints(), freedoms = 6.0 * b, cube = std::pow(freedoms, 3),
                 n = prepared.scene().layout().n, width = prepared.scene().layout().width;
    const bool by_blocks = choose_offsets(mechanism, prepared.ideal()).all;
    knot =
        (by_blocks ? j * (10e3 + 1.7e3 * n) : 4.0 * cube + 8.0 * n * freedoms * freedoms) + b * n * (100.0 + 20.0 * n);
    row = b * (6.0 * n * n + 12.0 * n) + 3.0 * n * n * n + 20.0 * width + 1000.0;
    tipping = knot + (by_blocks ? 4.0 / 3.0 : 20.0) * cube;
    closure = by_blocks ? j * 7e3 : 3.0 * cube;
  }
};

double seconds_of_simulation(const Mechanism& mechanism, const IdealMotion& ideal) {
  return ideal.knots() * kEvaluationsOfKnot *
         nominal_seconds_an_evaluation("multibody", false, static_cast<std::size_t>(mechanism.bodies()), 1);
}

std::shared_ptr<const PreparedScene> scene_of(bool on_lanes, const Mechanism& mechanism, const Parameters& sample) {
  return on_lanes ? scene_for_lanes(mechanism, sample)
                  : std::make_shared<const PreparedScene>(mechanism, ideal_motion(mechanism, sample), sample);
}

}  // namespace

double counted_scene_cost(const std::string& rung, bool on_lanes, const Mechanism& mechanism,
                          const std::vector<Parameters>& samples) {
  if (samples.size() < 2) return 0.0;
  const Parameters& first = samples.front();
  if (std::all_of(samples.begin(), samples.end(), [&](const Parameters& p) { return same_scene(p, first); }))
    return 0.0;
  const bool kinematic = is_kinematic(mechanism);
  try {
    if (rung == "multibody") return kinematic ? 0.0 : seconds_of_simulation(mechanism, ideal_motion(mechanism, first));
    const std::shared_ptr<const PreparedScene> prepared = scene_of(on_lanes, mechanism, first);
    const SceneSums sums(mechanism, *prepared);
    const double knots = prepared->scene().knots();
    // Rows are made once for the tables, and for the looks at grids that grow twofold.
    double whole = kSecondsOfSum * (knots * (sums.knot + 2.0 * sums.row) + sums.tipping);
    if (!kinematic)
      whole += seconds_of_simulation(mechanism, prepared->ideal());
    else if (on_lanes)
      whole += kSecondsOfSum * prepared->ideal().knots() * sums.closure;
    double all = 0.0;
    for (std::size_t k = 1; k < samples.size(); ++k) {
      if (same_scene(samples[k - 1], samples[k])) continue;
      all += kSecondsOfSum * knots * sums.row;
      if (kinematic && same_centers(first, samples[k])) all += kSecondsOfSum * sums.tipping;
      if (!serves(mechanism, *prepared, first, samples[k])) all += whole;
    }
    return all / static_cast<double>(samples.size() - 1);
  } catch (const ComputationError&) {
    return 0.0;  // samples without a scene fail, and cost little
  }
}

}  // namespace boresight
