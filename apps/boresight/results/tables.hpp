// The CSV tables of a run, column by column as the interface page names them. SI, 17 significant digits.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"

namespace boresight::app {

// A number with 17 significant digits: reading it back gives the same bits. NaN is left empty.
std::string exact(double value);

// A field of CSV, quoted where it must be (RFC 4180). A text that a spreadsheet would take for a formula (it begins with
// = + - @ and is no number) is led by an apostrophe.
std::string csv_field(const std::string& text);

// One row per `every`th sample, and the last one.
void write_timeseries(std::ostream& out, const Mechanism& mechanism, const RunResult& result, std::size_t every = 1);

// One row per contact.
void write_events(std::ostream& out, const Mechanism& mechanism, const RunResult& result);

// The name of the joint that holds this clearance.
const std::string& joint_of_clearance(const Mechanism& mechanism, int clearance);

}  // namespace boresight::app
