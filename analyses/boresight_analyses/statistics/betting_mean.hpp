// Bounds of the mean of independent values between 0 and 1, by betting against each mean that is too small or too large
// (Waudby-Smith, Ramdas 2024, "Estimating means of bounded random variables by betting", J. R. Stat. Soc. B 86, Section 4).
//
// Whoever holds that the mean is at most m offers a game that does not gain on average: a stake c of the capital on each
// value Y multiplies it by
//
//   1 - c + c Y / m                    c in [0, 1], mean of the factor at most 1
//
// A mixture of games with fixed stakes does not gain either; where its capital reaches 1 / (1 - confidence) the mean m is
// refused, wrongly with a chance of at most 1 - confidence (Ville 1939). That chance is of ever refusing it, however often
// one looks: the bounds hold at any time, so one may stop when they say what one hoped for.
//
// They need no distribution and no minimal number of values, and use that the values scatter little where they do; bounds
// from the mean alone (bounded_mean.hpp) are wider.
#pragma once

#include <cstdint>
#include <span>

namespace boresight {

// One-sided, each at this confidence. `zeros`: further values that are 0. Throw std::invalid_argument for a value outside
// [0, 1], no value at all, or a confidence outside (0, 1).
double betting_lower(std::span<const double> values, std::int64_t zeros, double confidence);
double betting_upper(std::span<const double> values, std::int64_t zeros, double confidence);

// The same of a probability of which `hits` of `samples` were seen: the bound that Clopper and Pearson's becomes where the
// number of samples may depend on what they show.
double betting_share_lower(std::int64_t hits, std::int64_t samples, double confidence);
double betting_share_upper(std::int64_t hits, std::int64_t samples, double confidence);

// Going on with the bet that Hoeffding's bound of `first` values is (bounded_mean.hpp). With s the mean of that many values that
// would show m, his bound holds as Markov's of a bet against m with the one stake
//
//   c = 1 - (1 - s) / (1 - m)
//
// which holds at any time: a bound by Hoeffding for the first values and this one for more of them err together with a chance
// of at most 1 - confidence. One-sided; `ones`, `zeros`: further values. Throws as above.
double first_bet_stake(std::int64_t first, double mean, double confidence);
double first_bet_lower(std::int64_t first, std::span<const double> values, std::int64_t ones, std::int64_t zeros,
                       double confidence);

}  // namespace boresight
