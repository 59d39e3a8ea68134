// Deterministic damage to a text: what a slip of the hand, a bad disk or an ill-meaning author would do to a file.
#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace boresight {

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}
  // One to four mutations of the text, one after the other.
  std::string mutate(std::string text);
  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : static_cast<std::size_t>(random_() % bound); }

 private:
  std::string once(std::string text);
  std::mt19937_64 random_;
};

}  // namespace boresight
