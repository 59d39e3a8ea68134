// How large the numbers of a mechanism may be: wide enough for anything that has been built, from the ball of a watch's bearing to
// a space station, and narrow enough that no product of a few of them leaves what a double holds.
//
// A range is of magnitudes: zero and the sign are judged where the key is read ("a mass above zero"), as it is there that they
// have a meaning. Coordinates and moments of inertia have no least magnitude: what a drawing rounds to 1e-17 m is a zero.
#pragma once

#include <string>

#include "boresight/keys/units.hpp"

namespace boresight {

// least and most as they are written in an error's text; "" for no bound.
struct PhysicalRange {
  SiUnit unit;
  const char* least;
  const char* most;
};

inline constexpr PhysicalRange kCoordinateRange{kLength, "", "10000 km"};
inline constexpr PhysicalRange kTargetRange{kLength, "", "1e12 km"};  // of a line of sight: a planet
inline constexpr PhysicalRange kSizeRange{kLength, "1 pm", "10000 km"};
inline constexpr PhysicalRange kMassRange{kMass, "1e-12 kg", "1e9 kg"};
inline constexpr PhysicalRange kInertiaRange{kInertia, "", "1e23 kg m^2"};
inline constexpr PhysicalRange kDurationRange{kDuration, "1 ns", "1e9 s"};
inline constexpr PhysicalRange kGravityRange{kAcceleration, "", "1e7 m/s^2"};
inline constexpr PhysicalRange kStartingSpeedRange{kSpeed, "", "1e5 m/s"};
inline constexpr PhysicalRange kStartingAngularRateRange{kAngularRate, "", "1e7 rad/s"};
inline constexpr PhysicalRange kContactSpeedRange{kSpeed, "1e-12 m/s", "1e5 m/s"};
inline constexpr PhysicalRange kYoungRange{kElasticModulus, "1 kPa", "10 TPa"};
inline constexpr PhysicalRange kDensityRange{kDensity, "1e-3 kg/m^3", "1e5 kg/m^3"};
inline constexpr PhysicalRange kStiffnessRange{kStiffness, "1e-9 N/m", "1e15 N/m"};
inline constexpr PhysicalRange kDampingRange{kDamping, "1e-12 N s/m", "1e15 N s/m"};
inline constexpr PhysicalRange kBristleStiffnessRange{kPerLength, "1e-3 m^-1", "1e12 m^-1"};
inline constexpr PhysicalRange kBristleDampingRange{kPerSpeed, "1e-9 s/m", "1e9 s/m"};

// Of standing errors: small beside what they stand in; what an angle is beyond a radian is another mechanism.
inline constexpr PhysicalRange kFrameTurnRange{kAngle, "", "1 rad"};
inline constexpr PhysicalRange kWarmingRange{kTemperature, "", "1e4 K"};
inline constexpr PhysicalRange kExpansionRange{kExpansion, "", "0.01 K^-1"};

// Pure numbers.
inline constexpr double kLargestFrictionCoefficient = 100.0;
inline constexpr double kStiffnessScaleRange[2] = {1e-6, 1e6};
// Below it, laws whose dissipation grows without bound as restitution vanishes are stiffer than any step can follow.
inline constexpr double kLeastRestitution = 1e-6;
// Laws of drives [m or rad] and loads [N, N m]; their first and second derivatives.
inline constexpr double kLargestLaw = 1e15, kLargestLawDerivative = 1e18;

// "an elastic modulus from 1 kPa to 10 TPa".
std::string in_words(const PhysicalRange& range);
bool holds(const PhysicalRange& range, double value);

}  // namespace boresight
