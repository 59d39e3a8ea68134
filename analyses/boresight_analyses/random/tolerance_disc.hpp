// Two parameters drawn as one point of a disc: a cylindrical tolerance zone (ISO 1101:2017), seen along its axis.
//
// With R the disc's radius, the distance r of the point from the centre has
//
//   uniform   P(r) = r^2 / R^2                                       every area of the disc alike
//   normal    P(r) = (1 - exp(-r^2 / 2 s^2)) / (1 - exp(-R^2 / 2 s^2)),   s = R / 3
//
// (Rayleigh's distribution, cut at R: two independent normal coordinates given that the point lies in the disc), and all
// directions are alike. The two coordinates are not correlated, yet not independent: where one is large the other is small.
//
// A point comes from two coordinates u of the unit cube through their normal scores z = Phi^-1(u), which a copula may have
// correlated with those of other parameters: its direction is z's, and its r solves P(r) = 1 - exp(-|z|^2 / 2), in closed form. So
// each parameter grows with its own coordinate, and (1/2, 1/2) is the centre.
#pragma once

#include <array>
#include <span>
#include <string>

#include "boresight_analyses/random/distribution.hpp"
#include "boresight_analyses/random/zone_law.hpp"

namespace boresight {

class ToleranceDisc {
 public:
  // radius > 0 and centre: in the parameters' SI unit.
  ToleranceDisc(double radius, std::array<double, 2> centre, ZoneLaw law);

  double radius() const { return radius_; }
  // "disc(radius 2.5e-05, around 0, 0, normal)": all digits; equal texts are equal zones.
  std::string text() const;
  // Two coordinates in (0, 1) become the point, in place.
  void place(std::span<double, 2> coordinates) const;
  double probability_within(double r) const;   // of the centre
  double radius_of(double probability) const;  // the inverse, probability in [0, 1]
  // How parameter k = 0 or 1 scatters by itself.
  DistributionPtr marginal(std::size_t k) const;

 private:
  double radius_;
  std::array<double, 2> centre_;
  ZoneLaw law_;
  double inside_;  // of the normal law that is cut: the probability of the disc
};

}  // namespace boresight
