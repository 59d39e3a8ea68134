// What several commands of the table claim alike of what they left.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "command_table.hpp"

namespace boresight::app {

// Options for the whole motion in multibody and perturbation, without further runs for the steps' error.
inline const std::vector<std::string> kOnce = {"--step-error", "off"};

double largest(const nlohmann::json& summary, const char* quantity);
// Rows of a CSV by the time in their first column.
std::map<long, std::vector<double>> rows_by_millisecond(const std::string& table);
// A row's numbers under the names x, y, z or qw, qx, qy, qz, the first of which is given.
std::vector<double> numbers(const std::string& table, long millisecond, const std::string& first, std::size_t count);
void expect_numbers(const std::vector<double>& found, const std::vector<double>& expected, double tolerance);
// Of `check`: a sound mechanism of this mobility.
std::function<void(const Left&)> freedoms(int mobility, int redundant);
void expect_error_follows_play(const Left& left, const std::string& path, const char* quantity);

}  // namespace boresight::app
