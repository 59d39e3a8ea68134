// The numbers of all contacts (JointPlay) as functions of the fitted parameters, with their
// derivatives.
//
// A contact's numbers are closed-form functions of a mechanism's parameters (hertz.hpp, the laws' damping
// factors). Their derivatives, a constant of a whole motion, are taken here by central differences of eighth
// order in the logarithm of the parameter: step 1 %, truncation 1e-16, rounding some 1e-13, relative
// (Fornberg 1988, Mathematics of Computation 51, 699-706, table 1). So every law and every parameter path
// serves without a second copy of its equation. What follows from them, the motion, is differentiated by
// jets.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/play/joint_play.hpp"

namespace boresight {

struct ContactNumbers {
  std::vector<JointPlay> joints;  // per clearance
  std::vector<std::vector<std::array<double, kMostContactNumbers>>>
      by;                      // [parameter][clearance]: d number / d parameter
  std::vector<double> values;  // of the parameters
  // Of the speed that a contact is damped by at least, likewise: no number of the play itself.
  std::vector<std::vector<double>> least_speed_by = {};
};

// parameters_at: the mechanism's parameters at some values of those fitted. values: > 0.
ContactNumbers contact_numbers(const Mechanism& mechanism,
                               const std::function<Parameters(const std::vector<double>&)>& parameters_at,
                               const std::vector<double>& values);

}  // namespace boresight
