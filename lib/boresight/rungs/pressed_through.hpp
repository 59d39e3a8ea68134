// Contacts as deep as the insert is thick: they are none, for the journal would be through its sleeve. What is computed beyond means nothing,
// whatever the law: loads, masses or stiffness are out of all proportion to each other.
#pragma once

#include <optional>
#include <string>

#include "boresight/mechanism/mechanism.hpp"
#include "boresight/rungs/run_result.hpp"

namespace boresight {

// Of a journal, ball or round slider its radius, of a pad its own, of a rectangular slider or pad half of the narrower side [m].
double insert_thickness(const ClearanceParameters& parameters);

// One sentence on the first joint whose contact was pressed in that deep; nothing where all hold. parameters: of that run.
std::optional<std::string> pressed_through(const Mechanism& mechanism, const Parameters& parameters,
                                           const RunResult& result);
// The same where only the deepest of all contacts is known: of the thickest insert, so that it is true whichever it was.
std::optional<std::string> pressed_through(const Parameters& parameters, double deepest);

}  // namespace boresight
