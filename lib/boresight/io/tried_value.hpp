// A value that the program itself gives to a parameter, as a setting, to see whether a reader takes it: an end of a distribution, of a
// tolerance, a bound of a fit. The reader gets all its digits, and a message shows six of them.
#pragma once

#include <string>

namespace boresight {

class TriedValue {
 public:
  // unit: of SI; "1": none.
  TriedValue(double value, const std::string& unit);
  const std::string& exact() const { return exact_; }  // "0.040000000000000001 m"
  // What a reader has found, with this value as a message shows it.
  std::string in_message(std::string found) const;

 private:
  std::string exact_, shown_;
};

}  // namespace boresight
