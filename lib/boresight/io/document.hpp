// A TOML file as a plain tree with line numbers, the settings that replace some of its values, and a record of both.
//
// Every value has a path ("clearance.F1.radial"). A setting PATH=VALUE replaces the value of that path before it is read,
// so it passes the same checks as the file's own text; a `*` between dots stands for any one name. The document remembers which
// paths were asked for, so that a setting that meets none can be refused with the nearest path that exists.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "boresight/mechanism/description.hpp"

namespace boresight {

// "PATH=VALUE" taken apart. Throws InputError if there is no "=" or no path.
Setting parse_setting(const std::string& text);

// One TOML value. Members keep the order of the file.
struct Node {
  enum class Kind { table, array, string, integer, number, boolean, date };
  Kind kind = Kind::table;
  std::string text;                                   // string: its characters; otherwise the value as it is shown
  double number = 0.0;                                // integer and number
  long long integer = 0;                              // integer
  bool boolean = false;                               // boolean
  std::vector<std::pair<std::string, Node>> members;  // table
  std::vector<Node> items;                            // array
  int line = 0;

  Node();  // not here: asking whether a pair of a name and a node can be made needs the whole of Node
  const Node* member(const std::string& key) const;
};

// What a node is, for the "found ..." of an error: "the number 5", "a table", the text itself in quotation marks.
std::string shown(const Node& node);

class Document {
 public:
  // Throws InputError: file not there, larger than 16 MiB, not TOML (with the line).
  static Document from_file(const std::string& path, std::vector<Setting> settings = {});
  static Document from_text(std::string_view text, const std::string& filename, std::vector<Setting> settings = {});

  const Node& root() const { return root_; }
  const std::string& filename() const { return filename_; }
  const std::string& content_hash() const { return content_hash_; }
  const std::vector<Setting>& settings() const { return settings_; }

  // The last setting that applies to this path, or nullptr. Marks it, and any earlier ones, as used.
  const Setting* setting_for(const std::string& path);
  // The last setting that applies to this path or to one below it, or nullptr. Marks nothing. by_star: those count whose path holds a star.
  const Setting* setting_under(const std::string& path, bool by_star = true) const;

  // An error of this name is read from here on: its paths are taken apart behind it.
  void name_error(const std::string& name) { error_names_.insert(name); }

  // From here on every path that is asked for is remembered, even where there are no settings.
  void record_paths() { records_paths_ = true; }
  const std::set<std::string>& asked_paths() const { return asked_; }
  // And so is how each number that is read is written, in the file or in a setting: "0.1 mm", by its path.
  void record_written(const std::string& path, const std::string& text) {
    if (records_paths_) written_[path] = text;
  }
  const std::map<std::string, std::string>& written() const { return written_; }

  // Throws InputError for the first setting whose path nothing asked for.
  void refuse_unused_settings() const;

 private:
  std::string filename_, content_hash_;
  Node root_;
  std::vector<Setting> settings_;
  std::vector<bool> used_;
  std::set<std::string> asked_;
  std::map<std::string, std::string> written_;
  std::set<std::string> error_names_;
  bool records_paths_ = false;
};

// "--set PATH=VALUE", where an error in a setting is reported.
Origin origin_of(const Setting& setting);

}  // namespace boresight
