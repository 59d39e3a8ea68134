#include "boresight_analyses/random/fit_size.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "boresight/play/joint_play.hpp"

namespace boresight {
namespace {

constexpr double kRounding = 1e-3;  // relative

std::string millimetres(double length) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g mm", 1e3 * length);
  return text;
}

}  // namespace

std::vector<JournalSize> journal_sizes(const MechanismDescription& mechanism, const std::string& path) {
  constexpr std::string_view kBegin = "clearance.";
  std::vector<JournalSize> sizes;
  for (const char* gap : {"radial", "width_gap", "height_gap"}) {
    const std::string end = "." + std::string(gap);
    if (!path.starts_with(kBegin) || !path.ends_with(end) || path.size() <= kBegin.size() + end.size()) continue;
    const std::string meant = path.substr(kBegin.size(), path.size() - kBegin.size() - end.size());
    for (const ClearanceDescription& c : mechanism.clearances) {
      const std::string& joint = mechanism.joints[static_cast<std::size_t>(c.joint)].name;
      const ClearanceParameters& p = c.parameters;
      if (meant != "*" && meant != joint) continue;
      const double inner = gap[0] == 'r' ? 2.0 * p.journal_radius : gap[0] == 'w' ? p.width : p.height;
      const double room = gap[0] == 'r' ? p.radial : gap[0] == 'w' ? p.width_gap : p.height_gap;
      if (inner > 0.0 && !has_corners(p))  // a pad has none
        sizes.push_back({joint, inner, inner + 2.0 * room, gap,
                         JointPlay::words(c, mechanism.joints[static_cast<std::size_t>(c.joint)].type).insert});
    }
  }
  return sizes;
}

bool is_of_size(const Fit& fit, const JournalSize& size) {
  double most = kRounding * size.journal;
  for (const double deviation : {fit.hole.lower, fit.hole.upper, fit.shaft.lower, fit.shaft.upper})
    most = std::max(most, std::abs(deviation));
  return fit.nominal >= size.journal - most && fit.nominal <= size.sleeve + most;
}

std::string found_size(const Fit& fit, const JournalSize& size) {
  const std::string measure = size.gap[0] == 'r' ? "diameter" : size.gap[0] == 'w' ? "width" : "height";
  return "\"" + fit.name + "\" of nominal size " + millimetres(fit.nominal) + ", where the " + size.part + " of " +
         size.joint + " has a " + measure + " of " + millimetres(size.journal);
}

std::string expected_size(const JournalSize& size) {
  return "a fit of nominal size " + millimetres(size.journal) +
         (size.gap[0] == 'r'   ? ", twice the mechanism file's journal_radius"
          : size.gap[0] == 'w' ? ", the mechanism file's width"
                               : ", the mechanism file's height");
}

}  // namespace boresight
