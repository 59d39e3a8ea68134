// The errors that reach a user. Each carries where, what was found, what was expected.
#pragma once

#include <stdexcept>
#include <string>

#include "boresight/mechanism/description.hpp"

namespace boresight {

// Bad input: exit status 2. what() is one line:
//   FILE:LINE: KEY: found FOUND, expected EXPECTED
// followed, where a name was meant, by "; did you mean NEAREST?".
class InputError : public std::runtime_error {
 public:
  InputError(const Origin& origin, const std::string& key, const std::string& found, const std::string& expected,
             const std::string& nearest = "");

  Origin origin;
  std::string key, found, expected, nearest;
};

// The computation failed: exit status 3. The message says what, when (t) and what to do.
class ComputationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The name among `candidates` that is closest to `name`: the same in other letters, small for large, else by edit distance; "" if none is near.
template <typename Names>
std::string nearest_name(const std::string& name, const Names& candidates);

std::size_t edit_distance(const std::string& a, const std::string& b);
bool same_but_for_capitals(const std::string& a, const std::string& b);

template <typename Names>
std::string nearest_name(const std::string& name, const Names& candidates) {
  std::string best;
  std::size_t best_distance = name.size() / 2 + 2;
  for (const auto& candidate : candidates) {
    if (same_but_for_capitals(name, candidate)) return candidate;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

}  // namespace boresight
