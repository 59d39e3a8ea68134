// A rung is made once and asked for many samples: what it keeps between them must not be heard in any answer.
#include <gtest/gtest.h>

#include <algorithm>

#include "boresight/ladder/ladder.hpp"
#include "boresight/mechanism/error.hpp"
#include "scenes.hpp"

namespace boresight {
namespace sample_order_test {

// Departures that change what scenes are made for: which way loads push, how large they are, what springs hold, what is built askew.
std::vector<Parameters> samples_of(const Mechanism& mechanism) {
  const Parameters& drawn = mechanism.parameters();
  std::vector<Parameters> samples(7, drawn);
  samples[1].gravity.setZero();
  samples[2].gravity = -drawn.gravity;
  samples[3].gravity = Vec3(drawn.gravity.z(), drawn.gravity.x(), drawn.gravity.y());
  samples[4].payload_mass = 5.0 * drawn.payload_mass;
  for (double& mass : samples[4].body_mass) mass *= 0.2;
  for (ClearanceParameters& c : samples[5].clearance) c.radial *= 0.5;
  for (SpringParameters& s : samples[5].spring) s.stiffness *= 10.0;
  for (double& error : samples[6].error) error += 2e-5;
  samples[4].error = samples[6].error;
  return samples;
}

void expect_same_in_any_order(const std::string& file, const std::vector<Setting>& settings) {
  const auto mechanism =
      std::make_shared<const Mechanism>(read_mechanism(std::string(BORESIGHT_EXAMPLES) + "/" + file, settings));
  const std::vector<Parameters> samples = samples_of(*mechanism);
  RunOptions options;
  options.sample_spacing = 0.0;
  options.model_look = ModelLook::none;
  for (const char* name : {"envelope", "quasistatic", "perturbation", "multibody"}) {
    const auto answer = [&](const Rung& rung, const Parameters& sample) {
      try {
        const RunResult r = rung.run(sample, options);
        return std::vector<double>{r.index.position_error.max, r.index.position_error.rms, r.index.boresight_error.max};
      } catch (const ComputationError&) {
        return std::vector<double>{-1.0, -1.0, -1.0};
      }
    };
    std::vector<std::vector<double>> alone;
    for (const Parameters& sample : samples) alone.push_back(answer(*make_rung(name, mechanism), sample));
    for (const std::vector<std::size_t>& order :
         {std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6}, std::vector<std::size_t>{6, 4, 2, 0, 5, 3, 1}}) {
      const auto rung = make_rung(name, mechanism);
      for (const std::size_t k : order) {
        const std::vector<double> now = answer(*rung, samples[k]);
        EXPECT_EQ(now, alone[k]) << file << ", " << name << ", sample " << k << " with " << order.front() << " first";
      }
    }
  }
}

TEST(SampleOrder, IsHeardInNoAnswer) {
  expect_same_in_any_order("four-bar/four-bar.toml", {{"motion.duration", "20 ms"}, {"initial.journals", "rest"}});
  expect_same_in_any_order("bearing-pairs/gimbal.toml", {{"motion.duration", "10 ms"}});
  expect_same_in_any_order("bearing-pairs/preloaded.toml", {{"motion.duration", "10 ms"}});
  expect_same_in_any_order("3-rrcpr/tolerances.toml", {{"motion.duration", "10 ms"}, {"initial.journals", "rest"}});
}

}  // namespace sample_order_test
}  // namespace boresight
