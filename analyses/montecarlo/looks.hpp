// How a requirement is judged that may be looked at more than once.
//
// Whoever looks, sees "not shown", adds samples and looks again until it says "met" is misled far more often than each look
// by itself: a bound for a number of samples fixed beforehand holds once. So the first look of a study that ends by its
// number of samples is judged by Clopper and Pearson, and what of the risk that look truly takes is written down,
//
//   spent = P(at most c of n are bad | the share of bad ones is just what is allowed),   c: the most that are "met" at n
//
// and every later look is judged by a confidence sequence (statistics/betting_mean.hpp), which holds at any time, with the
// risk that is left. A study that ends by what its samples say (`stop` by width) is judged by one from the beginning. The
// chance that any look calls a requirement met that is not stays below 1 - confidence. Of hypercubes and nets there is no
// such sequence: their first look takes the whole risk (one by width an equal part at each number it may end at), and a
// later one shows nothing.
//
// An interrupted study is not judged: it has not said yet how many samples it wants.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"

namespace boresight {

// What the first look at a requirement left behind.
struct FirstLook {
  std::uint64_t samples = 0;
  double spent = 0.0;  // of the risk 1 - confidence; 0 where a confidence sequence judged

  std::string text() const;
  static std::optional<FirstLook> parse(const std::string& text);
};

struct Judgement {
  enum class By { fixed_number, any_time, nothing };
  By by = By::fixed_number;
  double confidence = 0.95;  // of each bound
  std::string why;           // a sentence; "" for the plain case
};

// Names the question: another limit, probability or confidence is judged by itself.
std::string question_of(const Requirement& requirement);

// `first`: of an earlier look, if there was one. `plan` must have a requirement.
Judgement judgement_of(const MonteCarloPlan& plan, std::uint64_t samples, const std::optional<FirstLook>& first);
// What a look at this number of samples leaves behind as the first one.
FirstLook first_look_of(const MonteCarloPlan& plan, std::uint64_t samples);

// The share of the risk that Clopper and Pearson's bound of `samples` independent samples takes when the probability is just
// what is required.
double risk_of_a_look(const Requirement& requirement, std::uint64_t samples);

// The confidence of the interval that `stop` looks at: it is looked at for every number of samples at which the study may
// end, and holds at each of them by an equal part of the risk. plan.confidence for the other estimates.
double interval_confidence(const MonteCarloPlan& plan, const std::string& headline);

}  // namespace boresight
