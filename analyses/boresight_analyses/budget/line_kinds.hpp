// What the lines of a budget are: clearances, what scatters, standing errors by what makes them vary, and contributors from outside.
#pragma once

#include <string>

#include "boresight_analyses/budget/budget_plan.hpp"

namespace boresight {

inline constexpr const char* kClearanceKind = "clearance";
inline constexpr const char* kScatterKind = "scatter";
// Of standing errors of the mechanism, by what makes them vary: nothing (they are built in), the drive's own motion, the temperature; or
// several of these.
inline constexpr const char* kGeometryKind = "built geometry";
inline constexpr const char* kDriveKind = "drive";
inline constexpr const char* kTemperatureKind = "temperature";
inline constexpr const char* kErrorsKind = "standing errors";
// Of a standing error to which the mechanism file gives a value and the study no scatter.
inline constexpr const char* kKnownKind = "known error";

const char* kind_of(const ErrorDescription& error);
// Whether a line is a group of parameters, known from the members of the attribution.
bool is_of_group(const std::string& kind);
// Which kind this group of the plan's is.
std::string kind_of_group(const BudgetPlan& plan, std::size_t group, const MechanismDescription& mechanism);
// Whether a line is known from a column of influence: a known error, or a contributor that is a standing error.
bool is_by_influence(const std::string& kind);
// The class of a contributor; of a standing error's course in time what makes that error vary.
std::string kind_of(const Contributor& contributor);

}  // namespace boresight
