// The report of `boresight laws`.
#pragma once

#include <string>
#include <vector>

#include "boresight_analyses/laws/law_table.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

namespace boresight::app {

// What the table is about: a joint of a mechanism, or the default pin.
struct LawsSubject {
  std::string mechanism;  // "" without a file
  std::string hash;
  std::string joint;
  ClearanceParameters parameters;
  std::string contact_law, friction_law;  // that the joint uses; "" without a file
  double largest_load = 0.0;              // along the ideal motion [N]; 0: not known
  double mass = 1.0, speed = 0.1;         // of the impact [kg], [m/s]
  std::vector<std::string> warnings;      // of laws used outside of their range
};

// Where a law holds, in words, with this joint's largest load held against it.
std::string range_of(const NormalLawRow& row, const LawsSubject& subject);

report::Document laws_report(const Command& command, const LawsSubject& subject,
                             const std::vector<NormalLawRow>& normal, const std::vector<FrictionLawRow>& friction);

}  // namespace boresight::app
