#include "boresight/play/resting_play.hpp"

#include <algorithm>

namespace boresight {

double RestingPlay::normal_force() const {
  double sum = 0.0;
  for (const ContactState<double>& c : contact) sum += c.normal_force;
  return sum;
}

double RestingPlay::penetration() const {
  double deepest = 0.0;
  for (const ContactState<double>& c : contact)
    if (c.normal_force > 0.0) deepest = std::max(deepest, c.penetration);
  return deepest;
}

}  // namespace boresight
