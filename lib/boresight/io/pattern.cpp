#include <cmath>
#include <numbers>

#include "boresight/io/mechanism_sections.hpp"
#include "boresight/keys/mechanism_keys.hpp"

namespace boresight {
namespace {

// The springs and loads of a mechanism have no names; their paths count from 1 over the whole file.
void number_tables(std::vector<Cursor>& tables, const std::string& kind) {
  for (std::size_t k = 0; k < tables.size(); ++k) tables[k].rename(kind + "." + std::to_string(k + 1));
}

void append(std::vector<Cursor>& to, const std::vector<Cursor>& tables) {
  to.insert(to.end(), tables.begin(), tables.end());
}

void append_copies(std::vector<Cursor>& to, const std::vector<Cursor>& tables, int number, const Mat3& turn) {
  for (const Cursor& table : tables) to.push_back(table.copy(number, turn));
}

}  // namespace

Sections gather_sections(Cursor& root) {
  Sections sections;
  append(sections.bodies, root.tables("body"));
  append(sections.joints, root.tables("joint"));
  append(sections.clearances, root.tables("clearance"));
  append(sections.springs, root.tables("spring"));
  append(sections.loads, root.tables("load"));
  append(sections.errors, root.tables("error"));
  for (Cursor& pattern : root.tables("pattern")) {
    pattern.only(pattern_keys());
    const long long count = pattern.integer("count");
    const std::string axis = pattern.choice("axis");
    const auto bodies = pattern.tables("body"), joints = pattern.tables("joint"),
               clearances = pattern.tables("clearance"), springs = pattern.tables("spring"),
               loads = pattern.tables("load"), errors = pattern.tables("error");
    for (int i = 1; i <= count; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i - 1) / static_cast<double>(count);
      const Mat3 turn =
          i == 1 ? Mat3::Identity() : Eigen::AngleAxisd(angle, Vec3::Unit(axis[0] - 'x')).toRotationMatrix();
      append_copies(sections.bodies, bodies, i, turn);
      append_copies(sections.joints, joints, i, turn);
      append_copies(sections.clearances, clearances, i, turn);
      append_copies(sections.springs, springs, i, turn);
      append_copies(sections.loads, loads, i, turn);
      append_copies(sections.errors, errors, i, turn);
    }
    pattern.finish();
  }
  number_tables(sections.springs, "spring");
  number_tables(sections.loads, "load");
  return sections;
}

}  // namespace boresight
