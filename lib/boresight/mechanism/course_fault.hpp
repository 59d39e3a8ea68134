// What is wrong with a function of time as a course of a motion, in the words in which every reader says it.
#pragma once

#include <optional>
#include <string>

#include "boresight/math/course_search.hpp"

namespace boresight {

struct CourseFault {
  std::string found;  // ", which jumps or has a corner at t = 5.000000 s": goes on after the function's text
  std::string expected;
};

std::optional<CourseFault> not_finite(const TimeFunction& function, double duration);
std::optional<CourseFault> not_continuous(const TimeFunction& function, double duration, const LeastSizes& least = {});

// " at t = 5.000000 s"
std::string at_time(double t);

}  // namespace boresight
