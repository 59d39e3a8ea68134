#include "boresight/contact/law_range.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "boresight/contact/hertz.hpp"
#include "boresight/contact/pereira.hpp"

namespace boresight {
namespace {

double relative_radius(const ClearanceParameters& p) {
  return p.journal_radius * (p.journal_radius + p.radial) / p.radial;
}

std::string number(const char* format, double value) {
  char text[60];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// With as many more digits as tell it from the limit that it is beyond.
std::string told_from(double limit, double value, int digits) {
  const auto text = [&](double v) {
    char written[40];
    std::snprintf(written, sizeof written, "%.*g", digits, v);
    return std::string(written);
  };
  constexpr int kMostDigits = 9;
  while (digits < kMostDigits && text(value) == text(limit)) ++digits;
  return text(value);
}

}  // namespace

double contact_half_angle(const NormalLaw& law, const ClearanceParameters& p, double load) {
  const auto around = [&](double half_width) { return std::asin(std::min(1.0, half_width / p.journal_radius)); };
  switch (law.curve) {
    case ElasticCurve::point:
      return around(std::sqrt(relative_radius(p) * law.depth_under(load)));
    case ElasticCurve::logarithmic:
    case ElasticCurve::power:
      return around(std::sqrt(4.0 * load * relative_radius(p) /
                              (std::numbers::pi * composite_modulus(p.contact) * p.sleeve_length)));
    case ElasticCurve::conformal:
      return std::acos(p.radial / (p.radial + law.depth_under(load)));
    case ElasticCurve::linear:
      return 0.0;
  }
  return 0.0;
}

std::optional<std::string> out_of_range(const std::string& name, const ClearanceParameters& p, double load) {
  if (p.pad_radius > 0.0 || p.length > 0.0) return {};  // what is flat takes nothing but its damping from a law
  const NormalLaw law = make_normal_law(name, "", p);
  if (law.curve == ElasticCurve::linear || !(load > 0.0)) return {};
  const double angle = contact_half_angle(law, p, load), degrees = angle * 180.0 / std::numbers::pi;
  constexpr double kLimit = kHalfSpaceAngle * 180.0 / std::numbers::pi;
  const std::string under = " under " + number("%.4g N", load);
  if (law.curve == ElasticCurve::power) {
    if (p.radial >= kPereiraClearance[0] && p.radial <= kPereiraClearance[1]) return {};
    const double passed = kPereiraClearance[p.radial < kPereiraClearance[0] ? 0 : 1];
    return "its clearance of " + told_from(1e3 * passed, 1e3 * p.radial, 4) +
           " mm is outside of the 0.005 to 10 mm of the fit";
  }
  if (law.curve == ElasticCurve::conformal) {
    if (angle >= kHalfSpaceAngle) return {};
    return "the contact spans only " + told_from(kLimit, degrees, 2) + " degrees to each side" + under +
           ", and the law is for 15 and more";
  }
  if (degrees > 89.9)
    return "the contact would be wider than the journal" + under + ", and the law holds up to 15 degrees";
  if (angle > kHalfSpaceAngle)
    return "the contact spans " + told_from(kLimit, degrees, 2) + " degrees to each side" + under +
           ", and the law holds up to 15";
  if (law.curve == ElasticCurve::logarithmic) {
    if (law.depth_under(load) < law.length * kLogarithmicEnd) return {};
    const double end = 1e6 * law.length * kLogarithmicEnd;
    return "the depth of " + told_from(end, 1e6 * law.depth_under(load), 3) + " um" + under +
           " is beyond the end of its curve, " + number("%.3g um", end);
  }
  const double radius = p.journal_radius * std::sin(angle);
  if (p.sleeve_length > 0.0 && radius > 0.5 * p.sleeve_length)
    return "the patch of " + number("%.3g mm", 2e3 * radius) + under + " is longer than the sleeve";
  return {};
}

std::string fitting_law(const ClearanceParameters& p, double load) {
  if (!(p.sleeve_length > 0.0)) return "";
  for (const char* name : {"johnson", "liu", "pereira"})
    if (!out_of_range(name, p, load)) return name;
  return "";
}

std::optional<std::string> range_warning(const std::string& joint, const std::string& law, const ClearanceParameters& p,
                                         double load) {
  const std::optional<std::string> why = out_of_range(law, p, load);
  if (!why) return {};
  const std::string better = fitting_law(p, load);
  return joint + ": the contact law " + law + " is used outside of its range: " + *why +
         (better.empty() || better == law ? "" : "; " + better + " fits");
}

}  // namespace boresight
