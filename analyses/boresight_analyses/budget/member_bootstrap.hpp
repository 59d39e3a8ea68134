// How far a number that is made of all members of an ensemble would scatter with other members: the bootstrap over members
// (Efron 1979), whose values in time belong together. Intervals are the expanded percentile ones of Hesterberg 2015, "What
// teachers should know about the bootstrap", Am. Stat. 69: percentiles a little further out, by Student's t and
// sqrt(n / (n - 1)), without which few members give intervals that are too narrow.
//
// What no member has shown no bootstrap shows: of levels far out with few members it says how they differ among the
// members seen.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "boresight_analyses/random/counter_stream.hpp"

namespace boresight {

struct MemberInterval {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
};

// How often each member is drawn, resample by resample.
class MemberBootstrap {
 public:
  static constexpr std::uint64_t kResamples = 400;
  static constexpr std::size_t kFewest = 5;  // members, below which there is no interval

  // `place`: different numbers draw different resamples.
  MemberBootstrap(std::size_t members, std::uint64_t seed, std::uint64_t place)
      : members_(members), place_(place), stream_(seed, StreamPurpose::resampling) {}

  std::vector<std::uint32_t> times(std::uint64_t resample) const {
    std::vector<std::uint32_t> drawn(members_, 0);
    for (std::uint64_t k = 0; k < members_; ++k)
      ++drawn[static_cast<std::size_t>(stream_.below(members_, resample, k, place_))];
    return drawn;
  }

 private:
  std::size_t members_;
  std::uint64_t place_;
  CounterStream stream_;
};

// Of the values that a number took over the resamples of `members` members; widened to hold `value` itself.
MemberInterval expanded_percentiles(std::vector<double> values, double value, std::size_t members, double confidence);

}  // namespace boresight
