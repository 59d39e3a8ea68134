#include "results/assumed.hpp"

#include <set>

#include "terminal/terminal.hpp"

namespace boresight::app {

std::vector<AssumedValue> assumed_by(const Command& command, const Mechanism& mechanism) {
  try {
    return assumed_values(mechanism.description().origin.file, command.settings);
  } catch (const InputError&) {
    return {};  // the file went away, or changed, while it was computed with
  }
}

nlohmann::ordered_json assumed_json(const std::vector<AssumedValue>& assumed) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const AssumedValue& a : assumed) json["clearance." + a.joint + "." + a.key] = a.value;
  return json;
}

std::vector<std::string> material_warnings(const std::vector<AssumedValue>& assumed) {
  std::set<std::string> bare;
  for (const AssumedValue& a : assumed)
    if (a.key == "contact.young" || a.key == "contact.poisson" || a.key == "contact.restitution") bare.insert(a.joint);
  std::vector<AssumedValue> of_bare;
  for (const AssumedValue& a : assumed)
    if (bare.contains(a.joint) && a.key.starts_with("contact.")) of_bare.push_back(a);
  return in_words(of_bare);
}

void tell_warnings(const std::vector<std::string>& warnings, const Command& command, const Mechanism& mechanism) {
  for (const std::string& warning : warnings) tell("  warning: {}\n", warning);
  for (const std::string& warning : material_warnings(assumed_by(command, mechanism))) tell("  warning: {}\n", warning);
}

}  // namespace boresight::app
