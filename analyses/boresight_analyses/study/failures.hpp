// Why samples failed, as a study tells it: how many, and the reason of the one with the lowest number.
#pragma once

#include "boresight_analyses/study/sample_model.hpp"

namespace boresight {

struct Failures {
  std::uint64_t count = 0, first = 0;  // first: a sample's number
  std::string reason = {};             // of the first

  void see(std::uint64_t number, const Outcome& outcome) {
    if (outcome.status != Outcome::Status::failed) return;
    if (count++ > 0 && number > first) return;
    first = number;
    reason = outcome.message.empty() ? "no reason was given" : outcome.message;
  }
  void add(const Failures& others) {
    if (others.count > 0 && (count == 0 || others.first < first)) first = others.first, reason = others.reason;
    count += others.count;
  }
};

}  // namespace boresight
