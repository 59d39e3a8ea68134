// The looks at a study's requirement: which rule of statistics/looks.hpp its samples are judged by, and the note in its store
// that it was looked at, for those who look again.
//
// An interrupted study is not judged: it has not said yet how many samples it wants.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/statistics/looks.hpp"

namespace boresight {

// Names the question: another limit, probability or confidence is judged by itself.
std::string question_of(const Requirement& requirement);

// How this look at `samples` is judged. The first one is noted in the store, under the question.
Judgement look(SampleStore& store, const std::string& question, const AskedShare& asked, const LookedAt& at,
               std::uint64_t samples);

// Of a study with a requirement.
AskedShare asked_share_of(const MonteCarloPlan& plan);
LookedAt looked_at_of(const MonteCarloPlan& plan);
Judgement judgement_of(const MonteCarloPlan& plan, std::uint64_t samples, const std::optional<FirstLook>& first);
FirstLook first_look_of(const MonteCarloPlan& plan, std::uint64_t samples);

// The fewest samples of the plan's design that could show the requirement at all, if all of them are good.
std::int64_t fewest_samples(const MonteCarloPlan& plan, const Judgement& judgement);

// The confidence of the interval that `stop` looks at: it is looked at for every number of samples at which the study may
// end, and holds at each of them by an equal part of the risk. plan.confidence for the other estimates.
double interval_confidence(const MonteCarloPlan& plan, const std::string& headline);

}  // namespace boresight
