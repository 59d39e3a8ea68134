// How far off does a mechanism point as its play grows? The whole ladder's first step from C++: read a file, change a parameter, run.
//
//   play_and_pointing MECHANISM.toml
#include <cstdio>
#include <exception>
#include <memory>
#include <numbers>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: play_and_pointing MECHANISM.toml\n");
    return 2;
  }
  try {
    using namespace boresight;
    const auto mechanism = std::make_shared<const Mechanism>(read_mechanism(argv[1]));
    const std::unique_ptr<Rung> rung = make_rung("perturbation", mechanism);
    RunOptions options;
    options.sample_spacing = 0.0;  // indices only, no histories
    options.integrator = "rosenbrock";

    std::printf("play of      largest error of the boresight, and of its position\n");
    for (const double play : {0.5, 1.0, 1.5, 2.0}) {
      Parameters parameters = mechanism->parameters();
      for (ClearanceParameters& clearance : parameters.clearance) clearance.radial *= play;
      const RunResult result = rung->run(parameters, options);
      const double radians_to_arcsec = 180.0 * 3600.0 / std::numbers::pi;
      std::printf("%4.1f nominal  %8.2f arcsec  %8.2f um\n", play, result.index.boresight_error.max * radians_to_arcsec,
                  result.index.position_error.max * 1e6);
    }
  } catch (const std::exception&
               error) {  // InputError: one line with file, line, key; ComputationError: what cannot be followed
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
