#include "documented_summary.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

namespace boresight::app {
namespace {

// From each key that a row of a table begins with to all of that row.
using Rows = std::map<std::string, std::string>;

std::vector<std::string> quoted(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t open = text.find('`'); open != std::string::npos; open = text.find('`', open)) {
    const std::size_t close = text.find('`', open + 1);
    if (close == std::string::npos) break;
    words.push_back(text.substr(open + 1, close - open - 1));
    open = close + 1;
  }
  return words;
}

constexpr const char* kAllVerbs = "";

Rows rows_of(const std::string& verb) {
  std::ifstream in(BORESIGHT_SOURCE "/apps/boresight/summary.md");
  Rows rows;
  std::string part;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## ")) part = line.substr(3);
    if (verb != kAllVerbs && part != "Every verb" && part != verb) continue;
    // Of the sentence on failures, too: it is a row without bars.
    const std::size_t begin = line.starts_with("| ")              ? line.find('|', 1)
                              : line.starts_with("Studies whose") ? line.find(':')
                                                                  : std::string::npos;
    if (begin == std::string::npos) continue;
    for (const std::string& key : quoted(line.substr(0, begin))) rows[key] += line;
  }
  return rows;
}

// One entry per joint, parameter, rung, law, channel or letter: their names are the user's.
const std::set<std::string> kByName = {"contacts",
                                       "start",
                                       "contact",
                                       "compared",
                                       "optimum",
                                       "standard_error",
                                       "standard_error_of_data",
                                       "interval",
                                       "identifiable",
                                       "correlation",
                                       "standing_errors",
                                       "noise",
                                       "errors",
                                       "sobol",
                                       "morris",
                                       "local",
                                       "sources",
                                       "contact_laws",
                                       "friction_laws"};
// "The same", "a level each".
const std::map<std::string, std::string> kAsAnother = {{"errors", "error"}, {"requirements", "levels"}};
const std::set<std::string> kOfAnInterval = {"value", "low", "high", "confidence", "coverage", "basis"};
// Explained in words: values that were assumed are called what files call them.
const std::set<std::string> kInWords = {"assumed", "definitions", "correlation"};

}  // namespace

std::vector<std::string> keys_without_a_source() {
  std::string sources;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(BORESIGHT_SOURCE "/apps/boresight")) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream in(entry.path());
    sources.append(std::istreambuf_iterator<char>(in), {});
  }
  std::vector<std::string> missing;
  for (const auto& [key, row] : rows_of(kAllVerbs))
    if (sources.find('"' + key + '"') == std::string::npos) missing.push_back(key);
  return missing;
}

std::vector<std::string> unexplained_keys(const nlohmann::json& summary) {
  std::vector<std::string> missing;
  const Rows rows = rows_of(summary["verb"]);
  for (const auto& [key, value] : summary.items()) {
    const auto row = rows.find(key);
    if (row == rows.end()) {
      missing.push_back(key);
      continue;
    }
    if (kInWords.contains(key)) continue;
    std::vector<std::string> words = quoted(row->second);
    if (const auto other = kAsAnother.find(key); other != kAsAnother.end())
      for (const std::string& word : quoted(rows.at(other->second))) words.push_back(word);
    if (row->second.find("an interval") != std::string::npos)
      words.insert(words.end(), kOfAnInterval.begin(), kOfAnInterval.end());
    const std::set<std::string> explained(words.begin(), words.end());
    const auto look = [&](const nlohmann::json& entry) {
      if (!entry.is_object()) return;
      for (const auto& [inner, ignored] : entry.items())
        if (!explained.contains(inner)) missing.push_back(key + "." + inner);
    };
    if (kByName.contains(key))
      for (const auto& entry : value) look(entry);
    else if (value.is_array())
      for (const auto& entry : value) look(entry);
    else
      look(value);
  }
  return missing;
}

}  // namespace boresight::app
