#include "boresight_analyses/random/fit_size.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

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
  constexpr std::string_view kBegin = "clearance.", kEnd = ".radial";
  std::vector<JournalSize> sizes;
  if (!path.starts_with(kBegin) || !path.ends_with(kEnd) || path.size() <= kBegin.size() + kEnd.size()) return sizes;
  const std::string meant = path.substr(kBegin.size(), path.size() - kBegin.size() - kEnd.size());
  for (const ClearanceDescription& c : mechanism.clearances) {
    const std::string& joint = mechanism.joints[static_cast<std::size_t>(c.joint)].name;
    const ClearanceParameters& p = c.parameters;
    if (meant == "*" || meant == joint)
      sizes.push_back({joint, 2.0 * p.journal_radius, 2.0 * (p.journal_radius + p.radial)});
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
  return "\"" + fit.name + "\" of nominal size " + millimetres(fit.nominal) + ", where the journal of " + size.joint +
         " has a diameter of " + millimetres(size.journal);
}

std::string expected_size(const JournalSize& size) {
  return "a fit of nominal size " + millimetres(size.journal) + ", twice the mechanism file's journal_radius";
}

}  // namespace boresight
