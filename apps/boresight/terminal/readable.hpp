// Numbers as people read them: "0.231 mm", "22 µm", "478 arcsec". SI goes to files; this goes to terminals
// and reports.
#pragma once

#include <string>

namespace boresight::app {

// Three significant digits, in the unit in which the number is neither long nor full of zeros.
// `si_unit` is what the value is in: "m", "rad", "N", "m/s", "s", "Pa", "kg", "m/s^2", "1", ...
std::string readable(double value, const std::string& si_unit);

// In the unit that the user wrote ("arcsec"), unless the number is long or full of zeros there; "": readable().
std::string readable_as(double value, const std::string& si_unit, const std::string& written);

// What the user asked for and is held against: with all digits that it was typed with, in the unit that it was typed in.
std::string readable_limit(double value, const std::string& si_unit, const std::string& written);

// The value of a standing error in its unit ("m", "rad", "K"); of a scale, "1", in ppm or percent.
std::string readable_of_error(double value, const std::string& said_unit);
std::string readable_arcsec(double radians);
std::string readable_share(double share);  // 0.937 is "93.7 %"
// With two digits of what it lacks of all, rounded down so that it may follow "at least": 0.962351 is "96.2 %", 0.999731 "99.973 %".
std::string readable_near_all(double share);
std::string readable_error(double relative);  // as a share, or in words where it is many times the value itself
std::string readable_number(double value);
// "1 impact", "2 impacts"; `several`: of nouns that take no s.
std::string how_many(std::size_t count, const std::string& one, const std::string& several = "");

// The unit in which an axis or a column up to `largest` (SI) is drawn, and how many of it make one SI unit.
struct DisplayUnit {
  std::string name;
  double per_si = 1.0;
};
DisplayUnit display_unit(const std::string& si_unit, double largest);
DisplayUnit display_unit_as(const std::string& si_unit, double largest, const std::string& written);

}  // namespace boresight::app
