// Random parameters that are looked at as one: the `groups` of a study's table,
//
//   groups = { contact = ["clearance.F1.contact.restitution", "clearance.F1.friction.coefficient"] }
//
// A parameter in no group is a group by itself; parameters that are correlated belong in one group, as what they do
// cannot be told apart. The two parameters of a cylinder are one group without being told.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/random/random_inputs.hpp"

namespace boresight {

// Coordinates that change together; with one coordinate each, the parameters themselves.
using ParameterGroups = std::vector<std::vector<int>>;

struct NamedGroups {
  ParameterGroups members;  // indices into RandomInputs::parameters
  std::vector<std::string> names;
};

struct GroupRules {
  bool correlated_apart = false;  // allowed
  std::string instead;            // where that is not allowed, what else may be done; after what is expected
};

// Throws InputError.
NamedGroups read_parameter_groups(Cursor& table, const RandomInputs& inputs, const GroupRules& rules = {});

}  // namespace boresight
