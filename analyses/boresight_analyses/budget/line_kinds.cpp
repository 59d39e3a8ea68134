#include "boresight_analyses/budget/line_kinds.hpp"

namespace boresight {
namespace {

constexpr const char *kOverTime = " over time", *kConstant = ", constant";

}  // namespace

const char* kind_of(const ErrorDescription& error) {
  switch (error.kind) {
    case ErrorDescription::Kind::translation:
    case ErrorDescription::Kind::rotation:
      return kGeometryKind;
    case ErrorDescription::Kind::drive:
      return kDriveKind;
    case ErrorDescription::Kind::expansion:
      return kTemperatureKind;
  }
  return kErrorsKind;
}

bool is_of_group(const std::string& kind) {
  return kind == kScatterKind || kind == kGeometryKind || kind == kDriveKind || kind == kTemperatureKind ||
         kind == kErrorsKind;
}

std::string kind_of_group(const BudgetPlan& plan, std::size_t group, const MechanismDescription& mechanism) {
  if (!plan.is_of_errors(group)) return kScatterKind;
  std::string kind;
  for (const int i : plan.groups.members[group])
    for (const std::string& path : plan.inputs.parameters[static_cast<std::size_t>(i)].paths) {
      const std::vector<std::string> named = single_paths(mechanism, path);
      for (const ErrorDescription& error : mechanism.errors) {
        if (std::find(named.begin(), named.end(), "error." + error.name) == named.end()) continue;
        kind = kind.empty() || kind == kind_of(error) ? kind_of(error) : kErrorsKind;
      }
    }
  return kind;
}

bool is_by_influence(const std::string& kind) {
  return kind == kKnownKind || kind.ends_with(kOverTime) || kind.ends_with(kConstant);
}

std::string kind_of(const Contributor& contributor) {
  if (!contributor.of_error) return to_string(contributor.kind);
  return contributor.of_error->what + (contributor.of_error->course ? kOverTime : kConstant);
}

}  // namespace boresight
