// An estimate with its interval, typed by how its samples came about.
//
// Order statistics and Clopper-Pearson bounds hold for independent samples only; a Latin hypercube or a scrambled net
// takes its interval from the scatter over independent replicates. The tag makes the two different types: neither
// converts into the other, and no function takes both. Only for printing do they meet, in `ReportedInterval`.
#pragma once

#include <string>

namespace boresight {

struct Independent {
  static constexpr const char* name = "independent";
};
struct Replicated {
  static constexpr const char* name = "replicated";
};

// Infinite `low` or `high`: the samples do not bound that side at this confidence.
template <typename Sampling>
struct IntervalOf {
  double value = 0.0, low = 0.0, high = 0.0;
  double confidence = 0.95;  // asked for
  double coverage = 0.95;    // the exact chance of holding the truth where it is known, else `confidence`
  bool exact = false;        // `coverage` is exact, whatever the distribution
  std::string basis;         // in words
};

using IndependentInterval = IntervalOf<Independent>;
using ReplicatedInterval = IntervalOf<Replicated>;

// For tables and reports; nothing is computed from it.
struct ReportedInterval {
  double value, low, high, confidence, coverage;
  bool exact;
  std::string basis;
  const char* sampling;
};

template <typename Sampling>
ReportedInterval reported(const IntervalOf<Sampling>& i) {
  return {i.value, i.low, i.high, i.confidence, i.coverage, i.exact, i.basis, Sampling::name};
}

}  // namespace boresight
