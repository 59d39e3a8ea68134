#include "boresight_analyses/random/read_zone.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/mechanism/error.hpp"

namespace boresight {

ZoneLaw read_zone_law(Cursor& distribution) {
  return distribution.choice("zone") == "normal" ? ZoneLaw::normal : ZoneLaw::uniform;
}

double read_zone_reach(Cursor& zone, const std::string& across, const SiUnit& unit) {
  const bool angle = unit.unit == std::string(kAngle.unit);
  if (!zone.has("length")) {
    try {
      return 0.5 * zone.value(across, unit);
    } catch (const InputError& error) {
      if (!angle) throw;
      throw InputError(error.origin, error.key, error.found,
                       error.expected + ", or a length beside a " + across + " that is one", error.nearest);
    }
  }
  if (!angle)
    zone.fail_found("length", "a length, where the parameter is not an angle",
                    "no length: the zone of what is no angle has a " + across + " alone");
  const double wide = zone.value(across, kLength), length = zone.quantity("length");
  zone.require(length > wide, "length", "more than the " + across + ", in which an axis of this length lies");
  return wide / length;
}

DistributionPtr make_between_planes(double centre, double reach, ZoneLaw law) {
  if (law == ZoneLaw::uniform) return make_uniform(centre - reach, centre + reach);
  return make_normal(centre, reach / 3.0)->truncated(centre - reach, centre + reach);
}

void require_perpendicular(Cursor& entry, const std::string& key, const MechanismDescription& mechanism,
                           const std::vector<std::string>& paths) {
  // Directions may be given rounded to four digits or so.
  constexpr double kLargestSkew = 1e-3;
  const auto error_of = [&](const std::string& path) {
    return std::find_if(mechanism.errors.begin(), mechanism.errors.end(),
                        [&](const ErrorDescription& error) { return path == "error." + error.name; });
  };
  const auto a = error_of(paths[0]), b = error_of(paths[1]);
  if (a == mechanism.errors.end() || b == mechanism.errors.end() || a->kind != b->kind) return;
  const bool of_a_frame = a->kind == ErrorDescription::Kind::translation || a->kind == ErrorDescription::Kind::rotation;
  if (!of_a_frame || a->joint != b->joint || a->body != b->body) return;
  const double cosine = std::abs(a->direction.dot(b->direction));
  if (cosine <= kLargestSkew) return;
  char angle[40];
  std::snprintf(angle, sizeof angle, "%.3g", std::acos(std::min(1.0, cosine)) * 180.0 / M_PI);
  entry.fail_found(key, "errors whose directions are " + std::string(angle) + " degrees apart",
                   "two along perpendicular directions, across the cylinder's axis");
}

}  // namespace boresight
