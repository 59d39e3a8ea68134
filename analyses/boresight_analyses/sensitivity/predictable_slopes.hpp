// Slopes of an index that say something of changes one can make: of motions that stay predictable to their end.
#pragma once

#include "boresight_analyses/sensitivity/index_slopes.hpp"

namespace boresight {

// What a unit of a parameter that is a standing error, or several, changes all errors by: an entry of SlopeOptions::errors.
std::vector<double> errors_of_unit(const Mechanism& mechanism, const std::vector<ParameterPath>& places);

// As index_slopes(), by these errors too (SlopeOptions::errors), from rest with all offsets at start_offset [m]. Throws ComputationError, which says why there are none:
// the numbers do not fit together (impossible_numbers()), impacts part the motion's neighbours before its end, or whether they do cannot be
// measured (predictability.hpp), bristles carry no derivatives, or the motion cannot be followed.
IndexSlopes predictable_slopes(const std::shared_ptr<const Mechanism>& mechanism,
                               const std::function<Parameters(const std::vector<double>&)>& parameters_at,
                               const std::vector<double>& values, const IndexChoice& index, double start_offset,
                               std::vector<std::vector<double>> errors = {});

}  // namespace boresight
