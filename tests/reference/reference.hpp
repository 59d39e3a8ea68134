// Numbers that the programs beside this file compute from first principles: what tests hold the library against. README.md says which test
// takes which; a test of its own runs every program and compares what it prints with the file that is read here.
#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace boresight::reference {

struct Row {
  std::string name;            // its first word, where that is none of the numbers
  std::vector<double> values;  // those after it
  double operator[](std::size_t k) const { return values.at(k); }
};

// A table of tests/reference/`program`.txt. Throws where there is none of this name, or it is empty.
inline std::vector<Row> table(const std::string& program, const std::string& name) {
  const std::string file = std::string(BORESIGHT_REFERENCE) + "/" + program + ".txt";
  std::ifstream in(file);
  std::vector<Row> rows;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("table ")) {
      inside = line.starts_with("table " + name + ":");
      continue;
    }
    if (!inside) continue;
    Row row;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      std::size_t read = 0;
      double value = 0.0;
      try {
        value = std::stod(word, &read);
      } catch (const std::invalid_argument&) {
      }
      if (read == word.size()) {
        row.values.push_back(value);
      } else if (row.values.empty() && row.name.empty()) {
        row.name = word;
      } else {
        throw std::runtime_error(file + ": " + line);
      }
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw std::runtime_error(file + ": no table \"" + name + "\"");
  return rows;
}

// The only row of a table.
inline Row line(const std::string& program, const std::string& name) {
  const std::vector<Row> rows = table(program, name);
  if (rows.size() != 1) throw std::runtime_error(program + ", " + name + ": more rows than one");
  return rows.front();
}

// The row of a table with this name.
inline Row named(const std::string& program, const std::string& table_name, const std::string& name) {
  for (const Row& row : table(program, table_name))
    if (row.name == name) return row;
  throw std::runtime_error(program + ", " + table_name + ": no row " + name);
}

}  // namespace boresight::reference
