// What the tables of scattering parameters may hold.
#pragma once

#include "boresight/keys/key.hpp"

namespace boresight {

const KeyTable& random_keys();
const KeyTable& correlation_keys();
const KeyTable& groups_keys();
const KeyTable& distribution_keys();
// The numbers of one distribution each.
const KeyTable& normal_keys();
const KeyTable& uniform_keys();
const KeyTable& lognormal_keys();
const KeyTable& triangular_keys();
const KeyTable& beta_keys();
const KeyTable& weibull_keys();
const KeyTable& discrete_keys();
const KeyTable& empirical_keys();
const KeyTable& planes_keys();
const KeyTable& cylinder_keys();

}  // namespace boresight
