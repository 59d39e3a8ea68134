// Physical values as people write them, "0.1 mm", "72 GPa", "5000 rpm", turned into SI numbers (UDUNITS-2).
//
//   const double length = parse_quantity("0.1 mm", kLength);   // 1e-4
//
// Two dimensions are equal here only if their powers of every base unit are, **the radian among them**. (To UDUNITS the
// radian is a pure number, so "5 Hz" would pass as 5 rad/s and "20 %" as 0.2 rad.) Hence "rpm" and "deg/s" are angular
// rates, "Hz" is a frequency and refused where an angular rate is expected: 1 Hz could mean 1 or 2 pi rad/s.
// Units with an offset ("degC"), logarithmic units and dates are refused.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace boresight {

// What a value has to be: in words, its SI unit (or two, "rad|1", of which either will do), and an example for the error text, "" where
// nobody has one.
struct SiUnit {
  const char* what;
  const char* unit;
  const char* example;
};

inline constexpr SiUnit kLength{"a length", "m", "0.1 mm"};
inline constexpr SiUnit kMass{"a mass", "kg", "1.5 kg"};
inline constexpr SiUnit kInertia{"a moment of inertia", "kg m^2", "0.45 kg m^2"};
inline constexpr SiUnit kDuration{"a time", "s", "1 s"};
inline constexpr SiUnit kAngle{"an angle", "rad", "30 deg"};
inline constexpr SiUnit kAngularRate{"an angular rate", "rad/s", "6 rad/s"};
inline constexpr SiUnit kSpeed{"a speed", "m/s", "1 mm/s"};
inline constexpr SiUnit kAcceleration{"an acceleration", "m/s^2", "-9.81 m/s^2"};
inline constexpr SiUnit kForce{"a force", "N", "10 N"};
inline constexpr SiUnit kTorque{"a torque", "N m", "0.033 N m"};
inline constexpr SiUnit kStiffness{"a stiffness", "N/m", "8e5 N/m"};
inline constexpr SiUnit kDamping{"a damping", "N s/m", "4e4 N s/m"};
inline constexpr SiUnit kElasticModulus{"an elastic modulus", "Pa", "72 GPa"};
inline constexpr SiUnit kDensity{"a density", "kg/m^3", "2700 kg/m^3"};
inline constexpr SiUnit kFrequency{"a frequency", "Hz", "50 Hz"};
inline constexpr SiUnit kPerLength{"a stiffness per normal force", "1/m", "1e5 m^-1"};
inline constexpr SiUnit kPerSpeed{"a damping per normal force", "s/m", "10 s/m"};
inline constexpr SiUnit kTemperature{"a difference of temperatures", "K", "5 K"};
inline constexpr SiUnit kExpansion{"a coefficient of expansion", "1/K", "23.6e-6 1/K"};
inline constexpr SiUnit kRatio{"a ratio", "1", "1 %"};
// The scale of a drive: a share of what the drive does. It is measured in the drive's own unit, and may be written so.
inline constexpr SiUnit kShareOrAngle{"a share or an angle", "rad|1", "250 ppm"};
inline constexpr SiUnit kShareOrLength{"a share or a length", "m|1", "250 ppm"};

// The one whose SI unit this is ("m", "kg", "m/s^2", ...), for values of a parameter. The result may point into `si_unit`.
// or_share: of a scale.
SiUnit unit_called(const char* si_unit, bool or_share = false);
inline SiUnit unit_called(const std::string& si_unit, bool or_share = false) {
  return unit_called(si_unit.c_str(), or_share);
}
SiUnit unit_called(std::string&&, bool or_share = false) = delete;  // nothing would be left to point into

// Whether a plain number will do as well as a text: what is a share beside something else.
bool takes_numbers(const SiUnit& unit);

// "a length such as "0.1 mm"": the expectation in an error's text.
std::string expectation(const SiUnit& unit);

// "NUMBER UNIT", the blank optional, as an SI value. Throws ValueFault if the number is not a finite one, the unit is
// missing or unknown, the dimension is another one, or the SI value overflows. Safe from many threads.
double parse_quantity(std::string_view text, const SiUnit& expected);

// The unit of "NUMBER UNIT" as it is written there; "" where the text does not begin with a number.
std::string unit_as_written(std::string_view text);

// Units as people write them most often, of all dimensions: those that are of this one, or those that are not.
std::vector<std::string> common_units(const SiUnit& of, bool fitting);

// How many SI units one `unit` is: scale_of_unit("mm", kLength) = 1e-3. Throws ValueFault.
double scale_of_unit(std::string_view unit, const SiUnit& expected);

// A whole text as one finite decimal number, else false. No "nan", "inf", hexadecimal or trailing characters.
bool parse_number(std::string_view text, double& value);

// A text between quotation marks, shortened to 60 letters if it has more than 80: how values are shown in errors.
std::string in_quotes(std::string_view text);

}  // namespace boresight
