#include "boresight/io/document.hpp"

#include <algorithm>

#include "boresight/io/content_hash.hpp"
#include "boresight/io/toml_tree.hpp"
#include "boresight/io/whole_file.hpp"
#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

// A path taken apart at its dots, but for those within the names of what a bearing pair or a universal joint with play is made of:
// clearance, pitch.floating, radial.
std::vector<std::string_view> segments(std::string_view path, const std::set<std::string>& errors) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0;;) {
    const std::size_t dot = path.find('.', begin);
    parts.push_back(path.substr(begin, dot - begin));
    if (dot == std::string_view::npos) break;
    begin = dot + 1;
  }
  constexpr std::string_view kClearanceOf[] = {"floating", "first", "second"};
  const bool of_clearance = parts[0] == "clearance", of_body = parts[0] == "body";
  if (parts.size() > 3 &&
      ((of_body && parts[2] == "cross") || (of_clearance && std::find(std::begin(kClearanceOf), std::end(kClearanceOf),
                                                                      parts[2]) != std::end(kClearanceOf)))) {
    parts[1] = std::string_view(parts[1].data(), parts[1].size() + 1 + parts[2].size());
    parts.erase(parts.begin() + 2);
  }
  // An error's name may hold dots: the longest that is known, or what stands before a key of its table: error, arm.length, rotation, x.
  if (parts[0] == "error" && parts.size() > 2) {
    std::size_t end = 0;
    std::string name(parts[1]);
    for (std::size_t i = 2; i <= parts.size(); ++i) {
      if (errors.contains(name)) end = i;
      if (i < parts.size()) name += "." + std::string(parts[i]);
    }
    if (end == 0)
      for (end = 2; end < parts.size() && error_keys().find(std::string(parts[end])) == nullptr;) ++end;
    for (std::size_t i = 2; i < end; ++i)
      parts[1] = std::string_view(parts[1].data(), parts[1].size() + 1 + parts[i].size());
    if (end > 2) parts.erase(parts.begin() + 2, parts.begin() + static_cast<long>(end));
  }
  return parts;
}

// "*" is any part; "*.floating" the floating bearing of any joint, "*.length" the length of any body, "arm.*" what is wrong with the arm.
bool same(std::string_view wanted, std::string_view present) {
  if (wanted == present || wanted == "*") return true;
  const bool begins = wanted.starts_with("*."), ends = wanted.ends_with(".*");
  if (begins && ends) return wanted == "*.*" && present.find('.') != std::string_view::npos;
  return (begins && present.ends_with(wanted.substr(1))) ||
         (ends && present.starts_with(wanted.substr(0, wanted.size() - 1)));
}

// Does `pattern` name `path` (whole), or something at or below it (not whole)?
bool names(std::string_view pattern, std::string_view path, bool whole, const std::set<std::string>& errors) {
  if (pattern == path) return true;
  const auto wanted = segments(pattern, errors), present = segments(path, errors);
  if (whole ? wanted.size() != present.size() : wanted.size() < present.size()) return false;
  for (std::size_t i = 0; i < present.size(); ++i) {
    if (!same(wanted[i], present[i])) return false;
  }
  return true;
}

}  // namespace

Setting parse_setting(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError({"--set " + text, 0}, "", in_quotes(text), "PATH=VALUE such as \"clearance.F1.radial=0.2mm\"");
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

Origin origin_of(const Setting& setting) { return {"--set " + setting.path + "=" + setting.value, 0}; }

Node::Node() = default;

const Node* Node::member(const std::string& key) const {
  for (const auto& [name, node] : members) {
    if (name == key) return &node;
  }
  return nullptr;
}

std::string shown(const Node& node) {
  constexpr std::size_t kLongestList = 80;
  if (node.kind == Node::Kind::array && !node.items.empty()) {
    std::string list;
    for (const Node& item : node.items) {
      if (item.kind == Node::Kind::table || list.size() > kLongestList)
        return "a list of " + std::to_string(node.items.size());
      const bool is_number = item.kind == Node::Kind::integer || item.kind == Node::Kind::number;
      list += (list.empty() ? "[" : ", ") + (is_number ? item.text : shown(item));
    }
    return list + "]";
  }
  switch (node.kind) {
    case Node::Kind::table:
      return "a table";
    case Node::Kind::array:
      return "an empty list";
    case Node::Kind::string:
      return in_quotes(node.text);
    case Node::Kind::integer:
    case Node::Kind::number:
      return "the number " + node.text;
    case Node::Kind::boolean:
    case Node::Kind::date:
      return node.text;
  }
  return node.text;
}

Document Document::from_file(const std::string& path, std::vector<Setting> settings) {
  return from_text(read_whole_file(path), path, std::move(settings));
}

Document Document::from_text(std::string_view text, const std::string& filename, std::vector<Setting> settings) {
  if (text.size() > kLargestText) {
    throw InputError({filename, 0}, "", "a file of more than 16 MiB", "a smaller file");
  }
  ContentHash hash;
  hash.add(text);
  for (const Setting& setting : settings) {
    hash.add(setting.path);
    hash.add(setting.value);
  }
  Document document;
  document.filename_ = filename;
  document.content_hash_ = hash.hexadecimal();
  document.root_ = parse_toml(text, filename);
  document.root_.line = 1;
  document.used_.assign(settings.size(), false);
  document.settings_ = std::move(settings);
  return document;
}

const Setting* Document::setting_for(const std::string& path) {
  if (settings_.empty() && !records_paths_) return nullptr;
  asked_.insert(path);
  const Setting* last = nullptr;
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    if (names(settings_[i].path, path, true, error_names_)) {
      used_[i] = true;
      last = &settings_[i];
    }
  }
  return last;
}

const Setting* Document::setting_under(const std::string& path, bool by_star) const {
  const Setting* last = nullptr;
  for (const Setting& setting : settings_) {
    if ((by_star || setting.path.find('*') == std::string::npos) && names(setting.path, path, false, error_names_))
      last = &setting;
  }
  return last;
}

void Document::refuse_unused_settings() const {
  for (std::size_t i = 0; i < settings_.size(); ++i) {
    if (used_[i]) continue;
    throw InputError(origin_of(settings_[i]), settings_[i].path, "a path that names nothing", "the path of a value",
                     nearest_name(settings_[i].path, asked_));
  }
}

}  // namespace boresight
