// The report of `check`: what would go wrong before it does.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/mechanism/kinematic_report.hpp"
#include "boresight/scene/starting_journals.hpp"
#include "check/error_effects.hpp"
#include "command_line/command.hpp"
#include "report/document.hpp"

namespace boresight::app {

// Everything `check` found out.
struct CheckResult {
  KinematicReport kinematics;
  std::vector<ContactFrequency> contacts;  // empty where the ideal motion cannot be followed
  double step_of_springs = 0.0;            // of RK4, stable for springs and dampers alone [s]; 0 where there are none
  StartingJournals start;
  std::vector<ErrorEffect> errors;    // of the standing errors; empty where the ideal motion cannot be followed
  std::vector<std::string> findings;  // what stands in the way, most serious first; empty: nothing
  std::vector<std::string> notes;     // worth knowing, but no obstacle
};

CheckResult check_mechanism(const std::shared_ptr<const Mechanism>& mechanism);

report::Document check_report(const Command& command, const Mechanism& mechanism, const CheckResult& result);

}  // namespace boresight::app
