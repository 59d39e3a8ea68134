// How a requirement is judged that may be looked at more than once.
//
// Whoever looks, sees "not shown", adds samples and looks again until it says "met" is misled far more often than each look
// by itself: a bound for a number of samples fixed beforehand holds once. So the first look is judged by the bound for a
// fixed number, and every later one by a bound that holds at any time, so that the chance that any look calls a requirement
// met that is not stays below 1 - confidence. How depends on what a sample says:
//
//   hit or miss      the first look is Clopper and Pearson's. What of the risk it truly takes is written down,
//                      spent = P(at most c of n are bad | the share of bad ones is just what is allowed),
//                    c the most that are "met" at n; later looks are judged by a confidence sequence (betting_mean.hpp)
//                    with the risk that is left
//   a share          of the time, say: the first look is Hoeffding's bound (bounded_mean.hpp). That is no better than a bet
//                    with one stake, and a bet holds at any time: later looks go on with it, at the whole risk
//   no miss allowed  met only where none of the samples is bad. Whoever sees none among more has seen none among fewer, so
//                    that later looks add no risk
//
// Samples that say themselves when there are enough (`by_width`) are judged by a confidence sequence from the beginning. Of
// hypercubes and nets there is no such sequence: their first look takes the whole risk (one by width an equal part at each
// number it may end at), and a later one shows nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace boresight {

struct AskedShare {
  double probability = 0.95;  // share of good samples, or mean of the shares
  double confidence = 0.95;   // one-sided
};

struct LookedAt {
  enum class Sample { hit_or_miss, share, no_miss_allowed };
  Sample sample = Sample::hit_or_miss;
  bool independent = true;
  bool by_width = false;
  std::uint64_t ends = 1;        // by width: numbers of samples at which the study may end
  const char* name = "samples";  // in sentences
};

// What the first look at a requirement left behind.
struct FirstLook {
  std::uint64_t samples = 0;
  double spent = 0.0;  // of the risk 1 - confidence; 0 where a confidence sequence judged, or nothing could be shown

  std::string text() const;
  static std::optional<FirstLook> parse(const std::string& text);
};

struct Judgement {
  enum class By { fixed_number, any_time, first_bet, nothing };
  By by = By::fixed_number;
  double confidence = 0.95;  // of each bound
  std::string why;           // a sentence; "" for the plain case
  std::uint64_t first = 0;   // samples of the first look, where this is a later one
};

// `first`: of an earlier look, if there was one.
Judgement judgement_of(const AskedShare& asked, const LookedAt& at, std::uint64_t samples,
                       const std::optional<FirstLook>& first);
// What a look at this number of samples leaves behind as the first one.
FirstLook first_look_of(const AskedShare& asked, const LookedAt& at, std::uint64_t samples);

// The share of the risk that Clopper and Pearson's bound of `samples` independent samples takes when the probability is just
// what is required.
double risk_of_a_look(const AskedShare& asked, std::uint64_t samples);

// Independent samples that could show it at all, if all of them are good.
std::int64_t fewest_samples(const AskedShare& asked, const Judgement& judgement);

}  // namespace boresight
