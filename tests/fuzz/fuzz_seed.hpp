// The seed of a random fuzz: another one every day, so that CI looks at new inputs; printed, and settable to see one again:
//   BORESIGHT_FUZZ_SEED=20567000000 build/release/bin/fuzz_tests
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace boresight {

inline std::uint64_t fuzz_seed() {
  static const std::uint64_t seed = [] {
    const char* given = std::getenv("BORESIGHT_FUZZ_SEED");
    const auto day = std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()).time_since_epoch().count();
    const std::uint64_t found =
        given != nullptr ? std::strtoull(given, nullptr, 10) : static_cast<std::uint64_t>(day) * 1'000'000;
    std::printf("BORESIGHT_FUZZ_SEED=%llu\n", static_cast<unsigned long long>(found));
    std::fflush(stdout);
    return found;
  }();
  return seed;
}

// How many times as many inputs the nightly ones take: BORESIGHT_FUZZ_TIMES, otherwise 1. .ci/deep fuzz takes four times as many.
inline int fuzz_times() {
  const char* given = std::getenv("BORESIGHT_FUZZ_TIMES");
  const int times = given != nullptr ? std::atoi(given) : 1;
  return times > 0 ? times : 1;
}

}  // namespace boresight
