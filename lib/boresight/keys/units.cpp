#include "boresight/keys/units.hpp"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "boresight/keys/letters.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// A unit taken apart: its size in SI units and its powers of the base units (by UDUNITS' symbols, "rad" included).
struct Unit {
  double scale = 1.0;
  std::map<std::string, int> powers;
  bool plain = true;  // false: with an offset, logarithmic, or a date
};

struct UnitDeleter {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using UnitPtr = std::unique_ptr<ut_unit, UnitDeleter>;

std::string symbol_of(const ut_unit* unit) {
  if (const char* symbol = ut_get_symbol(unit, UT_ASCII)) return symbol;
  if (const char* name = ut_get_name(unit, UT_ASCII)) return name;
  return "?";
}

ut_status visit_basic(const ut_unit* unit, void* result) {
  ++static_cast<Unit*>(result)->powers[symbol_of(unit)];
  return UT_SUCCESS;
}

ut_status visit_product(const ut_unit*, int count, const ut_unit* const* basic, const int* powers, void* result) {
  for (int i = 0; i < count; ++i) static_cast<Unit*>(result)->powers[symbol_of(basic[i])] += powers[i];
  return UT_SUCCESS;
}

ut_status visit_galilean(const ut_unit*, double scale, const ut_unit* underlying, double offset, void* result);

ut_status visit_timestamp(const ut_unit*, const ut_unit*, double, void* result) {
  static_cast<Unit*>(result)->plain = false;
  return UT_SUCCESS;
}

ut_status visit_logarithmic(const ut_unit*, double, const ut_unit*, void* result) {
  static_cast<Unit*>(result)->plain = false;
  return UT_SUCCESS;
}

const ut_visitor kVisitor = {visit_basic, visit_product, visit_galilean, visit_timestamp, visit_logarithmic};

ut_status visit_galilean(const ut_unit*, double scale, const ut_unit* underlying, double offset, void* result) {
  auto* unit = static_cast<Unit*>(result);
  unit->scale *= scale;
  if (offset != 0.0) unit->plain = false;
  return ut_accept_visitor(underlying, &kVisitor, result);
}

// UDUNITS' parser and its status are global to the process; everything that touches it holds this lock.
std::mutex& udunits_lock() {
  static std::mutex lock;
  return lock;
}

// Call with the lock held. Never freed: it lives as long as the process.
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* read = ut_read_xml(nullptr);
    if (read == nullptr) {
      throw ComputationError(
          "UDUNITS-2 cannot read its table of units (udunits2.xml); install libudunits2-data or "
          "set UDUNITS2_XML_PATH");
    }
    // UDUNITS knows "degree" but not "deg", nor what astronomers and surveyors write; its "as" is an attosecond.
    const UnitPtr degree(ut_get_unit_by_name(read, "degree")), arcsecond(ut_get_unit_by_name(read, "arc_second"));
    const auto map = [](const char* name, const UnitPtr& of, double factor) {
      const UnitPtr unit(of == nullptr ? nullptr : ut_scale(factor, of.get()));
      if (unit != nullptr) ut_map_name_to_unit(name, UT_UTF8, unit.get());
    };
    map("deg", degree, 1.0);
    map("gon", degree, 0.9);
    map("mas", arcsecond, 1e-3);
    for (const char* name : {"uas", "\u00b5as", "\u03bcas"}) map(name, arcsecond, 1e-6);
    return read;
  }();
  return system;
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (static_cast<unsigned char>(c) & 0x80) != 0;
}
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }

// UDUNITS' grammar also takes further factors ("2 mm"), offsets and dates. Only names, powers, products and quotients are
// let through: a digit must belong to a power, or be the lone "1" of "1" and "1/s".
bool is_written_as_unit(std::string_view text) {
  if (text.empty() || text.size() > 64) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i], before = i == 0 ? ' ' : text[i - 1];
    if (is_digit(c)) {
      const bool in_power = is_letter(before) || is_digit(before) || before == '^' || before == '-' || before == ')';
      const bool lone_one = c == '1' && i == 0 && (text.size() == 1 || text[1] == '/');
      if (!in_power && !lone_one) return false;
      if (is_digit(before) && i >= 2 && is_digit(text[i - 2])) return false;  // no power has three digits
    } else if (c == '-') {
      if (before != '^' && !is_letter(before)) return false;
    } else if (!is_letter(c) && !is_blank(c) && std::string_view("*/^.%()").find(c) == std::string_view::npos) {
      return false;
    }
  }
  return true;
}

// The unit taken apart, or nullptr if it is not one.
const Unit* known_unit(std::string_view text) {
  if (!is_written_as_unit(text)) return nullptr;
  const std::lock_guard<std::mutex> guard(udunits_lock());
  static std::map<std::string, std::unique_ptr<const Unit>, std::less<>> seen;  // good ones only, entries never move
  if (const auto it = seen.find(text); it != seen.end()) return it->second.get();
  const std::string copy(text);
  const UnitPtr parsed(ut_parse(unit_system(), copy.c_str(), UT_UTF8));
  if (parsed == nullptr) return nullptr;
  auto unit = std::make_unique<Unit>();
  if (ut_accept_visitor(parsed.get(), &kVisitor, unit.get()) != UT_SUCCESS) return nullptr;
  if (!unit->plain || !std::isfinite(unit->scale) || unit->scale <= 0.0) return nullptr;
  std::erase_if(unit->powers, [](const auto& entry) { return entry.second == 0; });
  return (seen[copy] = std::move(unit)).get();
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Reads a finite decimal number at the beginning of `text` and removes it.
bool take_number(std::string_view& text, double& value) {
  std::string_view rest = text;
  if (!rest.empty() && rest.front() == '+') rest.remove_prefix(1);
  const std::size_t first = !rest.empty() && rest.front() == '-' && rest.size() == text.size() ? 1 : 0;
  if (rest.size() <= first || !(is_digit(rest[first]) || rest[first] == '.')) return false;  // no "nan", no "inf"
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return false;
  text = rest.substr(static_cast<std::size_t>(end - rest.data()));
  return true;
}

// Whether it is a unit whose numbers count from a zero of their own, as those of a Celsius thermometer do.
bool counts_from_a_zero(std::string_view text) {
  if (!is_written_as_unit(text)) return false;
  const std::lock_guard<std::mutex> guard(udunits_lock());
  const UnitPtr parsed(ut_parse(unit_system(), std::string(text).c_str(), UT_UTF8));
  Unit unit;
  return parsed != nullptr && ut_accept_visitor(parsed.get(), &kVisitor, &unit) == UT_SUCCESS && !unit.plain;
}

// What is proposed in place of an unknown unit.
constexpr std::array<const char*, 28> kCommonUnits = {
    "mm", "um", "m",  "km", "deg", "arcmin", "arcsec", "rad", "mrad", "urad",   "rpm",    "rad/s", "deg/s", "Hz",
    "s",  "ms", "kg", "g",  "N",   "kN",     "N m",    "N/m", "GPa",  "kg/m^3", "kg m^2", "m/s",   "mm/s",  "m/s^2"};
// Others.
constexpr const char* kMoreUnits[] = {
    "cm",     "nm",   "us",   "ns",     "min",    "h",        "mg",  "t",    "mN",   "MN",     "mN m",
    "Nm",     "kN m", "Pa",   "kPa",    "MPa",    "kHz",      "MHz", "N/mm", "N/um", "kN/m",   "N s/m",
    "g/cm^3", "K",    "mK",   "1/K",    "m^-1",   "1/m",      "s/m", "um/s", "km/s", "mm/s^2", "rad/s^2",
    "mas",    "gon",  "nrad", "degree", "mrad/s", "arcsec/s", "%",   "ppm",  "1"};

bool is_of(const Unit& unit, const SiUnit& expected) {
  for (std::string_view rest = expected.unit; !rest.empty();) {
    const std::string_view one = rest.substr(0, rest.find('|'));
    if (const Unit* si = known_unit(one); si != nullptr && unit.powers == si->powers) return true;
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
  }
  return false;
}

// Those that would do: nobody means an angle who writes a temperature.
std::vector<std::string> common_units_of(const SiUnit& expected) {
  std::vector<std::string> fitting;
  for (const char* common : kCommonUnits)
    if (const Unit* unit = known_unit(common); unit != nullptr && is_of(*unit, expected)) fitting.push_back(common);
  return fitting;
}

// "asec" is an attosecond, where an angle is asked for an arcsec; "kg" is what it says.
std::string read_as_another(std::string_view text, const SiUnit& expected) {
  const std::string written(text);
  if (std::find(kCommonUnits.begin(), kCommonUnits.end(), text) != kCommonUnits.end() || written.size() < 3) return "";
  const std::string nearest = nearest_name(written, common_units_of(expected));
  return 2 * edit_distance(written, nearest) <= written.size() ? nearest : "";
}

double convert(std::string_view unit_text, const SiUnit& expected, const std::string& shown) {
  const Unit* unit = known_unit(unit_text);
  if (unit == nullptr && counts_from_a_zero(unit_text))
    throw ValueFault(shown + ", whose unit counts from a zero of its own", expectation(expected));
  if (unit == nullptr)
    throw ValueFault(shown + " with the unknown unit " + in_quotes(unit_text), expectation(expected),
                     nearest_name(std::string(unit_text), common_units_of(expected)));
  for (std::string_view rest = expected.unit;;) {
    const std::string_view one = rest.substr(0, rest.find('|'));
    const Unit* si = known_unit(one);
    if (si == nullptr) throw ComputationError("UDUNITS-2 does not know the unit " + std::string(one));
    if (unit->powers == si->powers) return unit->scale / si->scale;
    if (one.size() == rest.size()) throw ValueFault(shown, expectation(expected), read_as_another(unit_text, expected));
    rest.remove_prefix(one.size() + 1);
  }
}

}  // namespace

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMostLetters = 80, kShown = 60;
  return "\"" + shortened(text, kMostLetters, kShown) + "\"";
}

std::string expectation(const SiUnit& unit) {
  if (*unit.example == '\0') return std::string(unit.what) + " in " + unit.unit;
  return std::string(unit.what) + " such as \"" + unit.example + "\"";
}

bool parse_number(std::string_view text, double& value) {
  text = trimmed(text);
  return take_number(text, value) && text.empty();
}

std::string unit_as_written(std::string_view text) {
  std::string_view rest = trimmed(text);
  double number = 0.0;
  return take_number(rest, number) ? std::string(trimmed(rest)) : "";
}

std::vector<std::string> common_units(const SiUnit& of, bool fitting) {
  std::vector<std::string> found;
  const auto look_at = [&](const char* common) {
    if (const Unit* unit = known_unit(common); unit != nullptr && is_of(*unit, of) == fitting) found.push_back(common);
  };
  for (const char* common : kCommonUnits) look_at(common);
  for (const char* common : kMoreUnits) look_at(common);
  return found;
}

double scale_of_unit(std::string_view unit, const SiUnit& expected) {
  return convert(trimmed(unit), expected, in_quotes(unit));
}

double parse_quantity(std::string_view text, const SiUnit& expected) {
  std::string_view rest = trimmed(text);
  double number = 0.0;
  if (!take_number(rest, number)) throw ValueFault(in_quotes(text), expectation(expected));
  rest = trimmed(rest);
  if (rest.empty()) throw ValueFault(in_quotes(text) + " without a unit", expectation(expected));
  const double value = number * convert(rest, expected, in_quotes(text));
  if (!std::isfinite(value)) throw ValueFault(in_quotes(text) + ", which is too large", expectation(expected));
  return value;
}

bool takes_numbers(const SiUnit& unit) { return std::string_view(unit.unit).ends_with("|1"); }

SiUnit unit_called(const char* si_unit, bool or_share) {
  const std::string_view called = si_unit;
  if (or_share && called == kAngle.unit) return kShareOrAngle;
  if (or_share && called == kLength.unit) return kShareOrLength;
  static const SiUnit known[] = {kLength,         kMass,     kInertia,      kDuration,  kAngle,
                                 kAngularRate,    kSpeed,    kAcceleration, kForce,     kTorque,
                                 kStiffness,      kDamping,  kFrequency,    kDensity,   kPerLength,
                                 kElasticModulus, kPerSpeed, kTemperature,  kExpansion, kRatio};
  for (const SiUnit& unit : known)
    if (called == unit.unit) return unit;
  return {"a value", si_unit, ""};
}

}  // namespace boresight
