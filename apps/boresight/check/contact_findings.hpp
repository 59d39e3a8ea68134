// What no joint can bear, or nothing can be computed of: numbers without bounds, journals pressed through their sleeves.
#pragma once

#include <string>
#include <vector>

#include "boresight/contact_events/contact_report.hpp"
#include "boresight/mechanism/mechanism.hpp"

namespace boresight::app {

// One sentence for each such joint. contacts: of the mechanism's clearances, in their order.
std::vector<std::string> contact_findings(const Mechanism& mechanism, const std::vector<ContactFrequency>& contacts);

}  // namespace boresight::app
