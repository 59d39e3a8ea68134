// What is drawn of a body that has no shape: bars from its centre of mass to its joints, and a pointer along the boresight.
#pragma once

#include <vector>

#include "boresight/mechanism/mechanism.hpp"

namespace boresight::app {

struct Bar {
  Vec3 from_B, to_B;  // in body axes, from the body's centre of mass [m]
  bool pointer = false;
};

std::vector<Bar> bars_of(const Mechanism& mechanism, int body);
// Radius of the bars [m].
double bar_radius(const Mechanism& mechanism);

}  // namespace boresight::app
