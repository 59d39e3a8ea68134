// Prints what Simbody makes of the default mechanism for the clearances and loads of the paper's two sweeps: the figures that the multibody
// rung is held against (tests/reference/simbody_figures.txt). Bodies, joints, constraints and the integrator are Simbody's; the contact law
// is ours, as a force of its own.
//
//   build/release/bin/simbody_figures [ACCURACY]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "peer.hpp"
#include "scenes.hpp"

int main(int argc, char** argv) {
  using namespace boresight;
  const double accuracy = argc > 1 ? std::atof(argv[1]) : 2e-5;
  const auto peer = peers::make_simbody_peer();
  const auto mechanism = scenes::build(scenes::rrcpr());
  std::puts(
      "table default mechanism: clearance payload maximum (least, median, largest over five neighbouring accuracies) "
      "rms (the same) [m, kg]");
  for (const auto& [clearance, payload] :
       {std::pair{1e-4, 0.0}, {2e-4, 0.0}, {3e-4, 0.0}, {1e-4, 250.0}, {1e-4, 500.0}}) {
    Parameters parameters = mechanism->parameters();
    parameters.clearance[0].radial = parameters.clearance[0].axial = clearance;
    parameters.payload_mass = payload;
    const peers::PeerScene scene(mechanism, parameters);
    std::vector<double> largest, rms;
    for (const double share : {1.0, 0.98, 0.96, 0.94, 0.92}) {
      const peers::PeerMotion motion =
          peer->follow(scene, {.setting = peers::PeerSetting{"Runge-Kutta-Merson", 0.0, accuracy}.scaled(share)});
      largest.push_back(motion.largest);
      rms.push_back(motion.rms);
    }
    std::sort(largest.begin(), largest.end());
    std::sort(rms.begin(), rms.end());
    std::printf("%g %g %.3e %.3e %.3e %.3e %.3e %.3e\n", clearance, payload, largest[0], largest[2], largest[4], rms[0],
                rms[2], rms[4]);
    std::fflush(stdout);
  }
}
