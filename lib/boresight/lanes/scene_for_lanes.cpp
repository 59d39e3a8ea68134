#include "boresight/lanes/scene_for_lanes.hpp"

#include <algorithm>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/lanes/lane_layouts.hpp"
#include "boresight/math/dense_solves.hpp"

namespace boresight {
namespace {

constexpr int kMostRefinements = 3;

VecX accelerations(const SceneLayout& at, const double* row) {
  MatX M;
  at.inverse_mass(row, M);  // which M's place is
  return solve_positive(M, VecX(Eigen::Map<const VecX>(row + at.Ar, at.n)));
}

// Of M^-1 r between the knots, relative to its largest value: what cubics through every other knot miss at the knots between,
// a sixteenth of it as the grid's own.
double error_of_accelerations(const SceneTables& forces) {
  const TimeTable& table = forces.dynamics;
  const int width = table.width(), cells = table.cells() / 2 * 2;
  std::vector<double> row(width), coarse, between(width);
  for (int k = 0; k <= cells; k += 2) {
    table.at(k * table.spacing(), row.data());
    coarse.insert(coarse.end(), row.begin(), row.end());
  }
  const TimeTable through(2.0 * table.spacing(), width, coarse);
  double miss = 0.0, size = 0.0;
  for (int k = 1; k < cells; k += 2) {
    table.at(k * table.spacing(), row.data());
    through.at(k * table.spacing(), between.data());
    const VecX a = accelerations(forces.layout, row.data());
    miss = std::max(miss, (accelerations(forces.layout, between.data()) - a).cwiseAbs().maxCoeff());
    size = std::max(size, a.cwiseAbs().maxCoeff());
  }
  return size > 0.0 ? miss / size / 16.0 : 0.0;
}

}  // namespace

SceneForm lane_form(const SceneLayout& layout) {
  return SingleRevoluteLayout::describes(layout) ? SceneForm::accelerations : SceneForm::forces;
}

std::shared_ptr<const PreparedScene> scene_for_lanes(const Mechanism& mechanism, const Parameters& parameters) {
  double accuracy = ClearanceScene::kAccuracy;
  const IdealMotion ideal = ideal_motion(mechanism, parameters);
  auto prepared = std::make_shared<const PreparedScene>(mechanism, ideal, parameters, accuracy);
  const SceneLayout& at = prepared->scene().layout();
  if (at.n == 0 || lane_form(at) == SceneForm::accelerations) return prepared;
  for (int k = 0; k < kMostRefinements; ++k) {
    const Parameters grid = prepared->scene().gridded_by(parameters);
    const double error = error_of_accelerations(prepared->scene().tables(grid, SceneForm::forces));
    if (error <= ClearanceScene::kAccuracy) break;
    accuracy *= ClearanceScene::kAccuracy / error;
    prepared = std::make_shared<const PreparedScene>(mechanism, ideal, parameters, accuracy);
  }
  return prepared;
}

}  // namespace boresight
