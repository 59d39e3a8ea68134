// The example files of published mechanisms, followed on the multibody rung with every body's pose kept.
#pragma once

#include <gtest/gtest.h>

#include "boresight/ladder/ladder.hpp"
#include "scenes.hpp"

namespace boresight::scenes {

inline std::shared_ptr<const Mechanism> example(const std::string& name, const std::vector<Setting>& settings = {}) {
  return scenes::build(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + name + "/" + name + ".toml", settings));
}

inline RunResult follow(const std::shared_ptr<const Mechanism>& mechanism, double step, double sample) {
  RunOptions options;
  options.step = step;
  options.sample_spacing = sample;
  for (int b = 0; b < mechanism->bodies(); ++b) options.pose_bodies.push_back(b);
  return make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
}

inline const PoseSample& sample(const RunResult& result, int body, double t) {
  const double spacing = result.time[1] - result.time[0];
  const std::size_t k = static_cast<std::size_t>(std::lround(t / spacing));
  EXPECT_NEAR(result.time[k], t, 1e-9);
  for (const BodyHistory& history : result.others)
    if (history.body == body) return history.samples[k];
  throw std::out_of_range("no such body");
}

// A point given at home in world coordinates, carried by a body.
inline Vec3 carried(const Mechanism& mechanism, int body, const Vec3& at_home, const PoseSample& now) {
  const BodyDescription& b = mechanism.description().bodies[body];
  return now.pose.p + now.pose.q.toRotationMatrix() * b.axes.transpose() * (at_home - b.center_of_mass);
}

}  // namespace boresight::scenes
