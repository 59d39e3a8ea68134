#include "command_claims.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

namespace boresight::app {

double largest(const nlohmann::json& summary, const char* quantity) { return summary["index"][quantity]["max"]; }

std::map<long, std::vector<double>> rows_by_millisecond(const std::string& table) {
  std::map<long, std::vector<double>> rows;
  std::istringstream in(table);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<double> row;
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::strtod(cell.c_str(), nullptr));
    rows[std::lround(1e3 * row.at(0))] = row;
  }
  return rows;
}

std::vector<double> numbers(const std::string& table, long millisecond, const std::string& first, std::size_t count) {
  std::istringstream head(table.substr(0, table.find('\n')));
  std::size_t column = 0;
  for (std::string name; std::getline(head, name, ',') && name != first;) ++column;
  const std::vector<double> row = rows_by_millisecond(table).at(millisecond);
  return {row.begin() + static_cast<std::ptrdiff_t>(column), row.begin() + static_cast<std::ptrdiff_t>(column + count)};
}

void expect_numbers(const std::vector<double>& found, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], tolerance) << k;
}

std::function<void(const Left&)> freedoms(int mobility, int redundant) {
  return [=](const Left& left) {
    EXPECT_EQ(left.summary["kinematics"]["mobility"], mobility);
    EXPECT_EQ(left.summary["kinematics"]["redundant_rows"], redundant);
    EXPECT_TRUE(left.summary["findings"].empty());
    for (const auto& [joint, contact] : left.summary["contacts"].items())
      EXPECT_GT(contact["largest_stable_step"].get<double>(), 1e-5) << joint;
  };
}

void expect_error_follows_play(const Left& left, const std::string& path, const char* quantity) {
  const double nominal = largest(left.summary, quantity), half = largest(left.again({"--set", path}), quantity);
  EXPECT_LT(half, 0.75 * nominal);
  EXPECT_GT(half, 0.2 * nominal);
}

}  // namespace boresight::app
