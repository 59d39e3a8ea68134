#include "reference/key_facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace boresight::app {

std::string presence_text(const Key& key) {
  switch (key.presence) {
    case Key::Presence::required:
      return "must be there";
    case Key::Presence::has_default:
      return "default " + default_text(key);
    case Key::Presence::computed:
      return "default: " + key.when;
    case Key::Presence::sometimes:
      return key.when;
  }
  return "";
}

std::string facts_text(const Key& key) {
  std::string text = kind_text(key);
  if (key.distinct) text += ", all different";
  if (const std::string range = range_text(key); !range.empty()) text += "; " + range;
  return text + "; " + presence_text(key);
}

std::string verbs_text(const Section& section, const Key* key) {
  if (key != nullptr && !key->verbs.empty()) return key->verbs;
  if (!section.verbs.empty()) return fmt::format("{}", fmt::join(section.verbs, ", "));
  return section.file == "mechanism" ? "every verb" : "every verb that takes a study";
}

}  // namespace boresight::app
