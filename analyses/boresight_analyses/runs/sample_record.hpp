// What a store of samples keeps, and how it fails.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "boresight_analyses/study/sample_model.hpp"

namespace boresight {

// The file is another study's, in use by another run, or no store at all.
class StoreRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};
// Writing or reading failed: disk full, input/output error. What was committed is intact.
class StoreFailed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct SampleRecord {
  std::uint64_t number = 0;
  std::vector<double> inputs;  // SI
  Outcome outcome;
};

struct NumberRange {
  std::uint64_t first = 0, end = 0;  // first <= number < end
  std::uint64_t size() const { return end - first; }
};

// A rung that samples were computed on, with its step [s].
struct StoredRung {
  std::string name;
  double step = 0.0;
};

}  // namespace boresight
