// What a sample costs, counted and not measured: how often it evaluates its equations, at the speed that a core of 2023 has
// for them. Methods that divide a budget of CPU time over models and samples go by it, so that their plan is the same on
// every machine, however busy, and the same study gives the same numbers again; the time that it truly takes is measured and
// reported beside it, and lies within about a factor of two.
//
//   microseconds an evaluation, with b bodies and c clearances (medians over the mechanisms under examples/):
//   envelope 5 c      quasistatic c      perturbation 0.12 b + 0.32 c      multibody 0.3 b + 0.9 c
//   perturbation on lanes 0.15 c a step tried
//   errors alone, on all rungs but multibody: 3 a sample, and 0.06 a thousand operations
//
// Where masses, gravity or springs scatter each sample has a scene of its own to prepare besides: scene_cost.hpp.
#pragma once

#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/random/sampling_design.hpp"
#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/study/sample_model.hpp"

namespace boresight {

// [s]. Throws std::invalid_argument for a rung that is not known.
double nominal_seconds_an_evaluation(const std::string& rung, bool on_lanes, std::size_t bodies,
                                     std::size_t clearances);

// Of a sample, from the median evaluations of the first eight of the design, which are computed for it, and what their scenes take [s].
double counted_cost(const SampleModel& model, const Mechanism& mechanism, const RandomInputs& inputs,
                    const SamplingDesign& design);
// The same, counted when the study is begun, and kept in its store.
double kept_counted_cost(const SampleModel& model, const Mechanism& mechanism, const RandomInputs& inputs,
                         const SamplingDesign& design, SampleStore& store);

}  // namespace boresight
