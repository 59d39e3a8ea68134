// What is wrong with one value, before anyone knows where it stood. Whoever read it from a file adds file, line and key and
// throws an `InputError`.
#pragma once

#include <stdexcept>
#include <string>

namespace boresight {

class ValueFault : public std::runtime_error {
 public:
  ValueFault(const std::string& what_was_found, const std::string& what_was_expected,
             const std::string& nearest_known = "")
      : std::runtime_error("found " + what_was_found + ", expected " + what_was_expected),
        found(what_was_found),
        expected(what_was_expected),
        nearest(nearest_known) {}

  std::string found, expected, nearest;
};

}  // namespace boresight
