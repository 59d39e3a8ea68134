// Where each normal law holds for a journal in a sleeve, and which one does where another does not. A flat pad takes nothing but its
// damping from a law.
//
//   point        Hertz: the patch's radius a = sqrt(R d), R = R_a R_b / dR, small against the journal (half angle up to
//                15 degrees: sin 15 = 0.26) and not longer than the sleeve
//   logarithmic  half-spaces: the half width b = sqrt(4 F R / (pi E_s L)) within the same angle; depth below the curve's end
//   conformal    Liu: a half angle arccos(dR / (dR + d)) of at least 15 degrees, where half-spaces fail
//   power        Pereira: clearances of 0.005 to 10 mm, what the fit covers
//   linear       a spring is what it is: everywhere
// 15 degrees is this program's choice, a twentieth of the sine's own curvature; the papers print no single number.
#pragma once

#include <optional>
#include <string>

#include "boresight/contact/normal_law.hpp"

namespace boresight {

inline constexpr double kHalfSpaceAngle = 0.2617993877991494;  // 15 degrees [rad]

// Half angle that the contact takes of the bore under a load F [N], as the law itself sees it [rad].
double contact_half_angle(const NormalLaw& law, const ClearanceParameters& parameters, double load);

// Why the law does not hold under this load, in words; nothing where it does.
std::optional<std::string> out_of_range(const std::string& law, const ClearanceParameters& parameters, double load);

// The first of johnson, liu and pereira that holds under this load; "" if none does or the sleeve has no length.
std::string fitting_law(const ClearanceParameters& parameters, double load);

// One line on a joint whose largest load is `load`: which law is out of its range, and which fits. Nothing if all is well.
std::optional<std::string> range_warning(const std::string& joint, const std::string& law,
                                         const ClearanceParameters& parameters, double load);

}  // namespace boresight
