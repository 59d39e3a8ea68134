// Pure geometry: the pointing errors of standing errors alone, without play, for many samples.
//
//   GeometricErrors geometry(mechanism, PointingQuantity::position_error);
//   geometry.run(samples, outcomes);         // const: share it between threads
//
// What a scene rung gives for such a sample (it closes the same columns of influence, at the same instants, to the same pose), without what
// a sample of these statistics does not need: other bodies, velocities, accelerations. Held against the rung to 1e-9.
// Eight samples go side by side. Each takes 2 x 3 operations a knot and error (2 x 6 where a target is sighted), and some thirty at each
// instant: on 500 knots and 1000 instants 120,000 and 30,000 for forty errors, some 6 and 3 us. An outcome depends on its own sample
// alone, to the last bit.
#pragma once

#include <atomic>
#include <memory>
#include <span>

#include "boresight/pointing/indices.hpp"
#include "boresight/scene/standing_columns.hpp"
#include "boresight/scene/standing_curvature.hpp"

namespace boresight {

enum class TimeStatistic { max, rms, mean, p9973 };

struct GeometricOutcome {
  double value = 0.0;        // [m or rad]
  double time_of_max = 0.0;  // [s], of a maximum
  double model_error = 0.0;  // what being linear in the errors misses, relative: StandingCurvature
  std::string refusal = {};  // why there is none of these; "" if there are
};

class GeometricErrors {
 public:
  // Whether all freedoms are driven and there is no clearance: play that cannot move may still take errors up.
  static bool serve(const Mechanism& mechanism);
  // start: statistics leave out what comes before [s]. Throws ComputationError as StandingErrors does.
  // typical: StandingCurvature.
  GeometricErrors(std::shared_ptr<const Mechanism> mechanism, PointingQuantity quantity, TimeStatistic statistic,
                  double start = 0.0, const std::vector<double>& typical = {});
  ~GeometricErrors();

  // outcomes: as many as samples. Returns how many were computed: fewer where `stop` was set.
  std::size_t run(std::span<const Parameters> samples, std::span<GeometricOutcome> outcomes,
                  const std::atomic<bool>* stop = nullptr) const;
  // That a sample takes, as counted above.
  double operations() const;

 private:
  struct Prepared;
  std::unique_ptr<const Prepared> prepared_;
};

}  // namespace boresight
