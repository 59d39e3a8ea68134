#include "boresight_analyses/budget/read_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <stdexcept>

#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/budget/noise_keys.hpp"
#include "boresight_analyses/random/csv_column.hpp"

namespace boresight {
namespace {

void read_table(Cursor table, const SiUnit& unit, PowerDensity& density) {
  table.only(spectrum_table_keys());
  density.frequency = read_column(table, "frequency", table.text("frequency"));
  density.density = read_column(table, "density", table.text("density"));
  double scale = 1.0;
  try {
    scale = scale_of_unit(table.text("unit"), unit);
  } catch (const ValueFault& fault) {
    throw InputError(table.origin("unit"), table.path("unit"), fault.found, fault.expected, fault.nearest);
  }
  table.require(density.frequency.size() >= 2, "file", "at least two rows");
  for (std::size_t k = 0; k < density.frequency.size(); ++k) {
    // As the file has it: arcsec^2/Hz are some 1e-11 rad^2/Hz.
    const auto row = [&](double value) {
      char text[60];
      std::snprintf(text, sizeof text, "%.6g in row %zu", value, k + 1);
      return std::string(text);
    };
    if (!(density.frequency[k] > (k == 0 ? 0.0 : density.frequency[k - 1])))
      table.fail_found("frequency", row(density.frequency[k]), "frequencies above zero that rise from row to row");
    if (!(density.density[k] > 0.0))
      table.fail_found("density", row(density.density[k]),
                       "densities above zero; outside of the table's ends there are none");
    density.density[k] *= scale;
  }
  table.finish();
}

TransferFunction read_ratio(Cursor& table) {
  std::vector<double> numerator = table.numbers("numerator"), denominator = table.numbers("denominator");
  for (std::vector<double>* p : {&numerator, &denominator}) std::reverse(p->begin(), p->end());
  try {
    return TransferFunction(numerator, denominator);
  } catch (const std::invalid_argument&) {
    table.fail("numerator", "no higher power of s than that of the denominator");
  }
}

TransferFunction read_one(Cursor& table) {
  table.only(through_keys());
  const std::string kind = table.the_one();
  Cursor of = table.table(kind);
  of.only(through_keys().find(kind)->inside());
  TransferFunction out({1.0}, {1.0});
  if (kind == "first_order") {
    out = TransferFunction::first_order(of.quantity("bandwidth"));
  } else if (kind == "second_order" || kind == "sensitivity") {
    const double frequency = of.quantity("frequency"), damping = of.number("damping");
    out = kind == "sensitivity" ? TransferFunction::sensitivity(frequency, damping)
                                : TransferFunction::second_order(frequency, damping);
  } else {
    out = read_ratio(of);
    if (kind == "loop") {
      if (out.at_infinity() == -1.0)
        of.fail_found("numerator", "an open loop that is -1 at the highest frequencies",
                      "one that is not: closed, 1 / (1 + L) grows without bound there");
      out = of.choice("seen_by") == "sensor" ? out.closed_on_sensor() : out.closed_on_disturbance();
    }
  }
  if (!out.is_stable()) {
    const std::vector<std::complex<double>> poles = out.poles();
    double worst = -std::numeric_limits<double>::infinity();
    for (const std::complex<double>& p : poles) worst = std::max(worst, p.real());
    char text[80];
    std::snprintf(text, sizeof text, "a pole with the real part %.6g 1/s", worst);
    of.fail_found(kind == "ratio" || kind == "loop" ? "denominator" : "damping", text,
                  "a stable function, all of whose poles have negative real parts");
  }
  of.finish();
  table.finish();
  return out;
}

}  // namespace

std::vector<double> read_column(Cursor& table, const char* key, const std::string& column) {
  try {
    return read_csv_column(beside(table.origin().file, table.text("file")), column);
  } catch (const ColumnFault& fault) {
    const char* blamed = fault.about_the_file ? "file" : key;
    throw InputError(table.origin(blamed), table.path(blamed), fault.found, fault.expected, fault.nearest);
  }
}

std::vector<TransferFunction> read_through(Cursor& table, const std::string& key) {
  std::vector<TransferFunction> out;
  for (Cursor& one : table.tables(key)) out.push_back(read_one(one));
  return out;
}

TransferFunction in_a_row(const std::vector<TransferFunction>& functions) {
  TransferFunction all({1.0}, {1.0});
  for (const TransferFunction& one : functions) all = all * one;
  return all;
}

UnitOfInput::UnitOfInput(Cursor& contributor, Cursor& inside, const std::string& si_unit, bool squared) {
  const std::string of = inside.text("of", "");
  if (!of.empty() && !contributor.has("through"))
    inside.fail("of", "through beside it: transfer functions that make the index of it");
  const std::string unit = of.empty() ? si_unit : of;
  unit_ = squared ? "(" + unit + ")^2/Hz" : unit;
  const std::string shown = !of.empty() ? of : si_unit == "rad" ? "arcsec" : "um";
  example_ = "1 " + (!squared ? shown : of.empty() ? shown + "^2/Hz" : "(" + shown + ")^2/Hz");
  what_ = squared ? "a power spectral density" : "a value";
  if (of.empty()) return;
  try {
    scale_of_unit(unit_, si());
  } catch (const ValueFault&) {
    inside.fail_found("of", "\"" + of + "\"", "a unit, such as \"N m\"");
  }
}

Noise read_noise(Cursor& contributor, const std::string& si_unit) {
  Cursor spectrum = contributor.table("spectrum");
  spectrum.only(spectrum_keys());
  const UnitOfInput unit(contributor, spectrum, si_unit, true);
  PowerDensity density;
  if (spectrum.has("table")) {
    for (const char* key : {"white", "flicker", "exponent", "lower", "upper"})
      if (spectrum.has(key)) spectrum.fail_found(key, std::string("table and ") + key, "one of the two");
    read_table(spectrum.table("table"), unit.si(), density);
  } else {
    if (!spectrum.has("white") && !spectrum.has("flicker"))
      throw InputError(spectrum.origin(), spectrum.path(), "none of them", "white, flicker or table");
    if (spectrum.has("white")) density.white = spectrum.quantity("white", unit.si());
    if (spectrum.has("flicker")) density.flicker = spectrum.quantity("flicker", unit.si());
    if (spectrum.has("exponent") && !spectrum.has("flicker"))
      spectrum.fail("exponent", "flicker beside it, whose exponent it is");
    density.exponent = spectrum.number("exponent");
    density.lower = spectrum.quantity("lower", 0.0);
    density.upper = spectrum.quantity("upper", std::numeric_limits<double>::infinity());
    spectrum.require(density.upper > density.lower, "upper", "more than lower");
  }
  spectrum.finish();
  Noise noise(density, read_through(contributor));
  const std::string unbounded = noise.unbounded();
  if (!unbounded.empty())
    throw InputError(spectrum.origin(), spectrum.path(unbounded.starts_with("a lower") ? "lower" : "upper"), "nothing",
                     unbounded);
  return noise;
}

}  // namespace boresight
