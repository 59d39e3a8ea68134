#include "boresight_analyses/random/read_zone.hpp"

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

}  // namespace boresight
