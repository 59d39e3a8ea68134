// The evaluations that Sobol' indices are made of (Saltelli et al. 2010, Comput. Phys. Commun. 181, Table 2): a row is
// two points a and b, drawn together as one point of 2 d coordinates, and per group of parameters the point a with the
// group's coordinates taken from b.
//
//   n rows of g groups cost n (g + 2) evaluations.
#pragma once

#include <cstddef>
#include <vector>

#include "boresight_analyses/random/parameter_groups.hpp"
#include "boresight_analyses/statistics/batch_model.hpp"

namespace boresight {

ParameterGroups single_parameters(int dimensions);

struct SobolRow {
  double a = 0.0, b = 0.0;
  std::vector<double> exchanged;  // per group: a with the group's coordinates of b

  bool failed() const;  // one of its values is not finite
};

// The points of one row, in the order a, b, exchanged. `ab`: 2 d coordinates, those of a first.
Points sobol_row_points(const Point& ab, const ParameterGroups& groups);
// All rows of the points `ab` in one batch.
std::vector<SobolRow> sobol_rows(const BatchModel& model, const Points& ab, const ParameterGroups& groups);

}  // namespace boresight
