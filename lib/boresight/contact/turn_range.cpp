#include "boresight/contact/turn_range.hpp"

#include <algorithm>
#include <cstdio>

namespace boresight {
namespace {

constexpr double kSaid = 0.01;  // as much as is mostly asked of an index

double share(double half_width, double gap, double half_length) {
  return half_length > 0.0 ? 0.5 * half_width * gap / (half_length * half_length) : 0.0;
}

// About its axis a slider turns until its faces meet the guide, those across the width or those across the height.
double missed_of_roll(const ClearanceParameters& p) {
  const double w = 0.5 * p.width, h = 0.5 * p.height;
  return p.width_gap * w < p.height_gap * h ? share(w, p.width_gap, h) : share(h, p.height_gap, w);
}

bool is_rectangular(const ClearanceDescription& description, JointType type) {
  return type == JointType::prismatic && description.guide == GuideShape::rectangular;
}

}  // namespace

double missed_of_turns(const ClearanceDescription& description, JointType type, const ClearanceParameters& p) {
  if (!keeps_axis(type) || description.axes != JournalAxes::free || type == JointType::planar) return 0.0;
  if (is_rectangular(description, type))
    return std::max({share(0.5 * p.width, p.width_gap, 0.5 * p.length),
                     share(0.5 * p.height, p.height_gap, 0.5 * p.length), missed_of_roll(p)});
  return share(p.journal_radius, p.radial, 0.5 * p.sleeve_length);
}

std::optional<std::string> turn_warning(const std::string& joint, const ClearanceDescription& description,
                                        JointType type, const ClearanceParameters& p) {
  const double missed = missed_of_turns(description, type, p);
  if (!(missed > kSaid)) return std::nullopt;
  char size[160], text[400];
  if (is_rectangular(description, type))
    std::snprintf(size, sizeof size, "a slider %.4g mm wide, %.4g mm high and %.4g mm long", 1e3 * p.width,
                  1e3 * p.height, 1e3 * p.length);
  else
    std::snprintf(size, sizeof size, "a journal %.4g mm thick in a sleeve %.4g mm long", 2e3 * p.journal_radius,
                  1e3 * p.sleeve_length);
  std::snprintf(text, sizeof text,
                ": every rung takes turns within a play to first order in its gaps; of %s, one as large as the play "
                "allows is off by %s%.2g %%",
                size, missed < 1.0 ? "about " : "more than ", 100.0 * std::min(missed, 1.0));
  return joint + text;
}

}  // namespace boresight
