#include "boresight_analyses/study/plan_values.hpp"

namespace boresight {

double share_of(Cursor& table, const std::string& key, double otherwise) {
  const double value = table.number(key, otherwise);
  table.require(value > 0.0 && value < 1.0, key, "more than 0 and less than 1");
  return value;
}

std::uint64_t count_of(Cursor& table, const std::string& key, long long least, long long most, long long otherwise) {
  const long long value = table.integer(key, otherwise);
  table.require(value >= least && value <= most, key, std::to_string(least) + " to " + std::to_string(most));
  return static_cast<std::uint64_t>(value);
}

std::uint64_t seed_of(Cursor& table) {
  const long long seed = table.integer("seed", 1);
  table.require(seed >= 0, "seed", "a whole number, 0 or more");
  return static_cast<std::uint64_t>(seed);
}

}  // namespace boresight
