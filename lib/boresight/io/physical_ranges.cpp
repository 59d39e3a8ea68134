#include "boresight/io/physical_ranges.hpp"

#include <cmath>

namespace boresight {
namespace {

void check(const Cursor& cursor, const std::string& key, const PhysicalRange& range, double value) {
  if (!holds(range, value)) cursor.fail(key, in_words(range));
}

}  // namespace

std::string in_words(const PhysicalRange& range) {
  const std::string what = range.unit.what, least = range.least, most = range.most;
  return least.empty() ? what + " of at most " + most : what + " from " + least + " to " + most;
}

bool holds(const PhysicalRange& range, double value) {
  constexpr double kRounding = 1e-12;  // of the bound itself, written in another unit
  const double size = std::abs(value);
  if (*range.most != '\0' && size > parse_quantity(range.most, range.unit) * (1.0 + kRounding)) return false;
  return *range.least == '\0' || value == 0.0 || size >= parse_quantity(range.least, range.unit) * (1.0 - kRounding);
}

double quantity_in(Cursor& cursor, const std::string& key, const PhysicalRange& range) {
  const double value = cursor.quantity(key, range.unit);
  check(cursor, key, range, value);
  return value;
}

double quantity_in(Cursor& cursor, const std::string& key, const PhysicalRange& range, double otherwise) {
  return cursor.has(key) ? quantity_in(cursor, key, range) : cursor.quantity(key, range.unit, otherwise);
}

std::vector<double> quantities_in(Cursor& cursor, const std::string& key, const PhysicalRange& range,
                                  const std::vector<std::string>& names, const std::vector<double>* otherwise) {
  const std::vector<double> values = cursor.quantities(key, range.unit, names, otherwise);
  for (const double value : values) check(cursor, key, range, value);
  return values;
}

Vec3 vector_in(Cursor& cursor, const std::string& key, const PhysicalRange& range) {
  const Vec3 value = cursor.vector(key, range.unit);
  for (const double component : value) check(cursor, key, range, component);
  return value;
}

std::vector<Vec3> points_in(Cursor& cursor, const std::string& key, std::size_t count) {
  const std::vector<Vec3> values = cursor.points(key, count);
  for (const Vec3& point : values)
    for (const double component : point) check(cursor, key, kCoordinateRange, component);
  return values;
}

}  // namespace boresight
