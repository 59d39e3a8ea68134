#include "boresight_analyses/random/tolerance_disc.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "boresight_analyses/random/disc_coordinate.hpp"

namespace boresight {
namespace {

constexpr double kSigmas = 3.0;  // in the radius: six across the zone

}  // namespace

ToleranceDisc::ToleranceDisc(double radius, std::array<double, 2> centre, ZoneLaw law)
    : radius_(radius), centre_(centre), law_(law), inside_(-std::expm1(-0.5 * kSigmas * kSigmas)) {
  if (!(radius > 0.0)) throw std::invalid_argument("a disc's radius is more than 0");
}

std::string ToleranceDisc::text() const {
  char text[160];
  std::snprintf(text, sizeof text, "disc(radius %.17g, around %.17g, %.17g, %s)", radius_, centre_[0], centre_[1],
                law_ == ZoneLaw::uniform ? "uniform" : "normal");
  return text;
}

double ToleranceDisc::probability_within(double r) const {
  if (r <= 0.0) return 0.0;
  if (r >= radius_) return 1.0;
  const double share = r / radius_;
  if (law_ == ZoneLaw::uniform) return share * share;
  return -std::expm1(-0.5 * kSigmas * kSigmas * share * share) / inside_;
}

double ToleranceDisc::radius_of(double probability) const {
  if (law_ == ZoneLaw::uniform) return radius_ * std::sqrt(probability);
  const double sigmas = std::sqrt(-2.0 * std::log1p(-probability * inside_));
  return radius_ * std::min(1.0, sigmas / kSigmas);
}

void ToleranceDisc::place(std::span<double, 2> coordinates) const {
  const boost::math::normal standard;
  const double z0 = boost::math::quantile(standard, coordinates[0]),
               z1 = boost::math::quantile(standard, coordinates[1]);
  const double size = std::hypot(z0, z1);
  const double r = size > 0.0 ? radius_of(-std::expm1(-0.5 * size * size)) / size : 0.0;
  coordinates[0] = centre_[0] + r * z0;
  coordinates[1] = centre_[1] + r * z1;
}

DistributionPtr ToleranceDisc::marginal(std::size_t k) const {
  const double centre = centre_.at(k);
  // Chords of a circle: (x / R)^2 has the density of a beta distribution with both exponents 3/2.
  if (law_ == ZoneLaw::uniform) return make_beta(1.5, 1.5, centre - radius_, centre + radius_);
  return make_disc_coordinate(centre, radius_, radius_ / kSigmas);
}

}  // namespace boresight
