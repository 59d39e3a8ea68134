// Laws of motion and load as a user writes them, "2*pi*sin(pi*t)", made into functions of time with exact derivatives.
//
//   const TimeFunctionPtr law = parse_expression("500*sin(theta)", {{"theta", "pi/6*sin(pi*t)"}}, 1e-3);
//   law->at(0.25).acceleration;
//
// Numbers, t [s], pi, + - * / ^ and brackets; sin cos tan asin acos atan atan2(y, x) sinh cosh tanh exp log sqrt abs
// pow(x, n); and names given with their own expressions. ^ binds to the right and tighter than a sign: -t^2 = -(t^2).
//
// GiNaC holds the expression and differentiates it symbolically, twice; value and derivatives become one tape of double
// operations in which nothing is computed twice. The derivative of abs is the sign (0 at 0): the kink's impulse is not there.
//
// What could make symbolic algebra explode is refused beforehand: more than 4000 characters, brackets deeper than 40, constant
// exponents beyond +-64, products of more than 32 factors, tapes of more than 20000 operations.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "boresight/math/course_search.hpp"
#include "boresight/math/time_function.hpp"

namespace boresight {

// Names and their expressions; each may use the ones before it.
using NamedExpressions = std::vector<std::pair<std::string, std::string>>;

// The function `scale` times the expression. Throws ValueFault with what was found, what was expected and the nearest name.
TimeFunctionPtr parse_expression(const std::string& text, const NamedExpressions& named = {}, double scale = 1.0);

// A function of q, a coordinate, and of t. Throws ValueFault likewise.
CoordinateFunctionPtr parse_coordinate_function(const std::string& text);

// The sum of factor[k] * part[k].
TimeFunctionPtr combination(std::vector<std::pair<double, TimeFunctionPtr>> parts);

}  // namespace boresight
