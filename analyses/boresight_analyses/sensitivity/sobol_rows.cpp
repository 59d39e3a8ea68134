#include "boresight_analyses/sensitivity/sobol_rows.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace boresight {

ParameterGroups single_parameters(int dimensions) {
  ParameterGroups groups;
  for (int j = 0; j < dimensions; ++j) groups.push_back({j});
  return groups;
}

bool SobolRow::failed() const {
  return !std::isfinite(a) || !std::isfinite(b) ||
         !std::all_of(exchanged.begin(), exchanged.end(), [](double v) { return std::isfinite(v); });
}

Points sobol_row_points(const Point& ab, const ParameterGroups& groups) {
  const auto d = static_cast<std::ptrdiff_t>(ab.size() / 2);
  const Point a(ab.begin(), ab.begin() + d), b(ab.begin() + d, ab.end());
  Points points = {a, b};
  for (const auto& group : groups) {
    points.push_back(a);
    for (const int j : group) points.back()[j] = b[j];
  }
  return points;
}

std::vector<SobolRow> sobol_rows(const BatchModel& model, const Points& ab, const ParameterGroups& groups) {
  Points points;
  for (const Point& row : ab)
    for (Point& p : sobol_row_points(row, groups)) points.push_back(std::move(p));
  const std::vector<double> values = model(points);
  if (values.size() != points.size()) throw std::logic_error("a batch model must give one value per point");
  std::vector<SobolRow> rows;
  for (auto v = values.begin(); v != values.end(); v += static_cast<std::ptrdiff_t>(groups.size()) + 2)
    rows.push_back({v[0], v[1], {v + 2, v + 2 + static_cast<std::ptrdiff_t>(groups.size())}});
  return rows;
}

}  // namespace boresight
