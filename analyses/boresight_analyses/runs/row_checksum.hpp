// A number by which a stored sample is known to be what was stored: FNV-1a (Fowler, Noll, Vo, 64 bits) over all that it says, its
// history included. A flipped bit anywhere changes it.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>

#include "boresight_analyses/runs/sample_record.hpp"

namespace boresight {

class Checksum {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) put(static_cast<unsigned char>(word >> (8 * byte)));
  }
  // As it comes back from a store: there is one NaN, and one zero.
  void add(double value) {
    add(std::bit_cast<std::uint64_t>(std::isnan(value) ? std::numeric_limits<double>::quiet_NaN() : value + 0.0));
  }
  void add(const std::string& text) {
    add(static_cast<std::uint64_t>(text.size()));
    for (const char c : text) put(static_cast<unsigned char>(c));
  }
  std::int64_t value() const { return static_cast<std::int64_t>(hash_); }

 private:
  void put(unsigned char byte) { hash_ = (hash_ ^ byte) * 1099511628211ull; }
  std::uint64_t hash_ = 14695981039346656037ull;
};

inline std::int64_t checksum_of(const SampleRecord& record, int rung, std::span<const double> history) {
  Checksum sum;
  sum.add(record.number);
  sum.add(static_cast<std::uint64_t>(record.outcome.status));
  sum.add(record.outcome.value);
  for (const double input : record.inputs) sum.add(input);
  sum.add(record.outcome.cpu_seconds);
  sum.add(record.outcome.model_error);
  sum.add(record.outcome.discretisation_error);
  sum.add(static_cast<std::uint64_t>(rung));
  sum.add(record.outcome.message);
  sum.add(static_cast<std::uint64_t>(history.size()));
  for (const double value : history) sum.add(value);
  return sum.value();
}

}  // namespace boresight
