// What a run says of its steps: the sentence of terminal and report, and summary.json's part.
#pragma once

#include <string>

#include "boresight/stepping/measured_error.hpp"
#include "boresight_analyses/study/index_choice.hpp"
#include "results/summary.hpp"

namespace boresight::app {

// Of one index, relative to it; 0 where there is neither index nor error.
double relative_step_error(const MeasuredError& measured, const PointingIndices& index, const IndexChoice& of);

// "the steps put the position error, maximum, off by up to 1.2 % (measured by further runs ...)", or why nobody knows.
// size: of the mechanism [m]; what is rounding of it is said to be.
std::string step_error_sentence(const MeasuredError& measured, const PointingIndices& index, const IndexChoice& of,
                                double size);

// "± 2.3 %": of one index, what the steps do and what the rung leaves out by its own estimate, together. Empty where steps were not
// measured, and of rounding.
std::string stated_error_text(const MeasuredError& measured, const RunResult& result, const IndexChoice& of,
                              double size);

// The same of the largest force of a clearance's contact: what the steps do.
std::string force_error_text(const MeasuredError& measured, const RunResult& result, std::size_t clearance);

// A warning where the steps leave out as much as there is, or more, and it is not that one motion is unlike the next; else empty.
// deviates: whether there is play or a standing error at all.
std::string steps_mislead(const MeasuredError& measured, const PointingIndices& index, const IndexChoice& of,
                          double size, bool deviates = true);

// What the rung leaves out by its own estimate, of the index that is asked for, and whether that is enough for a warning. Empty where nothing
// is left out, or nothing deviates.
struct ModelErrorSaid {
  std::string sentence, warning;
};
ModelErrorSaid model_error_said(const RunResult& result, const IndexChoice& of, double size);

// Per quantity and statistic what is stated, in its own unit; whether neighbours scatter; what it cost.
Json step_error_json(const MeasuredError& measured);

}  // namespace boresight::app
