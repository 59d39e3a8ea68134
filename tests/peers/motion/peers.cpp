#include <cstdio>

#include "peer.hpp"

namespace boresight::peers {

std::string PeerSetting::fineness() const {
  char text[60];
  if (accuracy > 0.0)
    std::snprintf(text, sizeof text, "accuracy %.3g", accuracy);
  else
    std::snprintf(text, sizeof text, "h = %.4g us", 1e6 * step);
  return text;
}

std::vector<std::unique_ptr<Peer>> peers() {
  std::vector<std::unique_ptr<Peer>> all;
#ifdef BORESIGHT_SIMBODY
  all.push_back(make_simbody_peer());
#endif
#ifdef BORESIGHT_MUJOCO
  all.push_back(make_mujoco_peer());
#endif
#ifdef BORESIGHT_SUNDIALS
  all.push_back(make_sundials_multibody_peer());
  all.push_back(make_sundials_perturbation_peer());
#endif
  return all;
}

}  // namespace boresight::peers
