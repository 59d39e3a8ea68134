#include "boresight/io/varied_paths.hpp"

#include <algorithm>

#include "boresight/io/document.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/parameter_path.hpp"

namespace boresight {
namespace {

// None for what is no number that studies vary: a drive, a law.
std::vector<std::string> numbers_set_by(const Setting& setting, const MechanismDescription& mechanism) {
  try {
    return single_paths(mechanism, setting.path);
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

void VariedPaths::take(const Origin& origin, const std::string& key, const std::vector<std::string>& paths,
                       OwnValue own, const std::string& once) {
  for (const std::string& path : paths)
    for (const std::string& single : single_paths(mechanism_, path)) {
      if (!taken_.insert(single).second) throw InputError(origin, key, in_quotes(single) + " a second time", once);
      if (own == OwnValue::unread) replaced_.insert(single);
    }
  if (own == OwnValue::unread) refuse_settings_without_effect(origin);
}

// A * that sets others too has an effect.
void VariedPaths::refuse_settings_without_effect(const Origin& varied_at) const {
  for (const Setting& setting : mechanism_.settings) {
    const std::vector<std::string> set = numbers_set_by(setting, mechanism_);
    if (set.empty() || !std::all_of(set.begin(), set.end(), [&](const auto& one) { return replaced_.contains(one); }))
      continue;
    throw InputError(origin_of(setting), setting.path,
                     "a value that would have no effect: the study varies it (" + varied_at.file + ":" +
                         std::to_string(varied_at.line) + ")",
                     "no --set of it; change its values in the study");
  }
}

}  // namespace boresight
