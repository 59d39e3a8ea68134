// One input of a mechanism as a function: one number of it, or several that take one value, and what that value may be.
#pragma once

#include <string>
#include <vector>

#include "boresight/keys/key.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/random/random_inputs.hpp"

namespace boresight {

struct FunctionInput {
  std::vector<std::string> paths;
  std::string si_unit;
  // SI: what the file says, or the median of what the study scatters. Several where the path names numbers that differ: no one value is
  // that of the file then.
  std::vector<double> nominal;
  std::vector<ParameterPath> places;
  bool are_scales = false;  // of drives: shares, whatever they are computed in

  std::string told_unit() const { return are_scales ? "1" : si_unit; }
  const std::string& name() const { return paths.front(); }
};

// One input a path; a path may have a * in it. Throws InputError for a path that names nothing or comes twice.
std::vector<FunctionInput> inputs_named(const Mechanism& mechanism, const std::vector<std::string>& paths);
// What the study scatters, in its order.
std::vector<FunctionInput> inputs_of(const RandomInputs& inputs);

// The key of a mechanism file that gives this number, with its range: that of "radial" for "clearance.F1.radial"; null for a
// standing error, whose range hangs on its unit.
const Key* key_of_path(const std::string& path);
// Throws ValueFault where the mechanism's own reader would refuse this value [SI] whatever the others are, or it is no finite number. What
// values must hold together: impossible_numbers().
void check_value(const FunctionInput& input, double value);

}  // namespace boresight
