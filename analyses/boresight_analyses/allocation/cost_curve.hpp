// What a tolerance costs: the tighter, the more.
//
//   reciprocal           A + B / t         reciprocal-squared   A + B / t^2
//   reciprocal-power     A + B / t^k       exponential          A e^(-B t)
//
// (Chase, Greenwood, Loosli, Hauglund 1990, "Least cost tolerance allocation for mechanical assemblies with
// automated process selection", Manufacturing Review 3(1), Table 1.) t is the width of the zone that the
// radial clearance may lie in, [m]; A is a price, B a price times m^k, for the exponential 1/m. A study file
// gives A and B for t in a unit of its own.
#pragma once

#include <string>
#include <vector>

namespace boresight {

struct CostCurve {
  enum class Law { reciprocal, exponential };
  Law law = Law::reciprocal;
  double a = 0.0, b = 0.0;
  double exponent = 1.0;  // k

  double price(double t) const;
  double slope(double t) const;  // d price / d t, not positive
  // price(t) - price(than), without the digits that a large constant price would take from it.
  double above(double t, double than) const;
  std::string text() const;
};

// The words of a study file, in the order above.
std::vector<std::string> cost_law_names();
// A curve whose numbers hold for t in units of `metres`; `exponent` is looked at for reciprocal-power only.
CostCurve make_cost_curve(const std::string& law, double a, double b, double exponent, double metres);

}  // namespace boresight
