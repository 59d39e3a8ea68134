// How the state that a motion starts with follows the parameters: where journals rest (resting_start.hpp) depends on their
// clearances and stiffnesses.
#pragma once

#include <functional>
#include <vector>

#include "boresight/slopes/tables_beside.hpp"

namespace boresight {

struct StartSlopes {
  VecX state;  // 2n: the file's start
  MatX
      by;  // 2n x parameters; empty where none are asked for. By central differences of fourth order (Fornberg 1988, table 1)
};

// parameters_at: the mechanism's parameters at some values > 0 of those varied. beside: of those that the tables hang on.
StartSlopes start_slopes(const Mechanism& mechanism, const SceneTables& tables,
                         const std::function<Parameters(const std::vector<double>&)>& parameters_at,
                         const std::vector<double>& values, bool derivatives,
                         const std::vector<TablesBeside>& beside = {});

}  // namespace boresight
