// A standing error of the mechanism as a contributor: what one member's error does over time, by superposition.
//
//     e(t) = G(t) x(t),      x(t) = F c(t) + V
//
// G is the error's column of influence at the commanded pose (scene/standing_errors.hpp), as the index counts it, c its course, an expression
// of t such as a temperature, F and V what scatters over the members: a factor and an offset. It is of first order, added to the motion that
// the rung followed, and quasi-static: the mechanism takes every value of x at once, without vibration and without delay. What
// takes time to follow, as a part takes time to warm, belongs in the course.
#pragma once

#include <string>
#include <vector>

#include "boresight/math/time_function.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight/pointing/indices.hpp"
#include "boresight_analyses/budget/error_index.hpp"
#include "boresight_analyses/budget/member_moments.hpp"
#include "boresight_analyses/random/distribution.hpp"

namespace boresight {

struct ErrorCourse {
  std::string error;            // its name in the mechanism file
  std::string what;             // makes it vary: "temperature"; line_kinds.hpp
  std::string si_unit;          // of x: "m", "rad", "K"
  TimeFunctionPtr course;       // c; none: zero
  std::string text;             // of the course, as it is written
  DistributionPtr factor;       // F; none: 1
  DistributionPtr value;        // V; none: zero
  std::string unit;             // in which V is written: "arcsec"; "": as people read the SI unit
  std::vector<Vec3> by_course;  // G c on the grid of the histories, once follow_errors() was called [of the index]
  std::vector<Vec3> by_value;   // G there
};

// What the history of one member is for these values of F and V.
std::vector<Vec3> course_of(const ErrorCourse& error, double factor, double value);

// As moments() of contributor.hpp, of F a(t) + V b(t) where a and b are what the index makes of G c and G. Ensemble: at the time when
// the mean square over the members is largest; temporal: of the worst of the ends of F and V.
Moments moments(const ErrorCourse& error, int axis, ErrorIndex index, Interpretation interpretation,
                const Windows& windows, double spacing);
// How its axes vary together, as covariance_of() of member_moments.hpp has it; temporal: of the ends that are worst for all axes together.
Mat3 covariance_of(const ErrorCourse& error, ErrorIndex index, Interpretation interpretation, const Windows& windows,
                   double spacing);

// An error to which the mechanism file gives a value that nothing scatters: its part is in every member's motion.
struct KnownError {
  std::string name;  // its path
  double value = 0.0;
  PointingHistory history;  // of its part, to first order
};

}  // namespace boresight
