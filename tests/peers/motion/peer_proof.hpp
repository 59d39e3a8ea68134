// Whether a program models the mechanism that it is held beside ours for: before its speed means anything.
#pragma once

#include "peer.hpp"

namespace boresight::peers {

struct PeerProof {
  // Without clearance, over the whole motion, at a fine setting: how far the boresight body strays from the
  // ideal motion.
  double from_ideal = 0.0;       // [m]
  double turn_from_ideal = 0.0;  // [rad]
  // With clearance, up to the first contact: how far it strays from our multibody rung's.
  double flight_difference = 0.0;                         // [m]
  double first_contact = -1.0, our_first_contact = -1.0;  // [s]
  bool has_ideal = true;  // false: it has no motion without clearance (the perturbation rung's right-hand side)
};

// The setting: the finest that is worth it here, not the fastest.
PeerProof prove(const Peer& peer, const PeerScene& scene, const PeerSetting& setting);

}  // namespace boresight::peers
