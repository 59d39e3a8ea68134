// What standing errors do to some functions of one body's displacement, for many samples: the columns of influence as one matrix, by which a
// sample's errors become these functions' values at the knots of StandingErrors' table. The cubics between the knots are TimeTable's.
#pragma once

#include "boresight/scene/standing_errors.hpp"

namespace boresight {

struct StandingColumns {
  int functions = 0, knots = 0;
  double spacing = 0.0;  // of the knots [s]
  MatX values;           // (functions x knots) x errors, the functions of a knot side by side

  // gain_at(t): functions x 6, of the body's displacement and turn.
  template <typename GainAt>
  StandingColumns(const StandingErrors& errors, int body, int functions_of, const GainAt& gain_at)
      : functions(functions_of), knots(errors.cells() + 1), spacing(errors.spacing()) {
    values.resize(functions * knots, errors.count());
    for (int k = 0; k < knots; ++k)
      values.middleRows(functions * k, functions) = gain_at(k * spacing) * errors.at_knot(k, body);
  }

  // out: values * errors, column by column, so that a sample's numbers hang on nothing else.
  void contract(const std::vector<double>& errors, VecX& out) const {
    out.setZero(values.rows());
    for (std::size_t e = 0; e < errors.size(); ++e)
      if (errors[e] != 0.0) out += errors[e] * values.col(static_cast<Eigen::Index>(e));
  }
};

}  // namespace boresight
