#include "reference/sections.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "boresight/keys/mechanism_keys.hpp"
#include "boresight_analyses/budget/budget_keys.hpp"
#include "boresight_analyses/random/random_keys.hpp"
#include "boresight_analyses/study/study_keys.hpp"
#include "command_line/verb.hpp"

namespace boresight::app {
namespace {

// The tables of a study that rooms above its reader bring, by their names.
const std::map<std::string, const KeyTable*>& tables_of_studies() {
  static const std::map<std::string, const KeyTable*> all = [] {
    std::map<std::string, const KeyTable*> tables = {{"random", &random_keys()}, {"correlation", &correlation_keys()}};
    for (const auto& verb : all_verbs())
      if (const KeyTable* own = verb->study_table()) tables[verb->name()] = own;
    return tables;
  }();
  return all;
}

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream in(list);
  for (std::string word; std::getline(in >> std::ws, word, ',');) words.push_back(word);
  return words;
}

void add_missing(std::vector<std::string>& to, const std::vector<std::string>& from) {
  for (const std::string& word : from)
    if (std::find(to.begin(), to.end(), word) == to.end()) to.push_back(word);
}

void collect(std::vector<Section>& all, const Section& section) {
  for (Section& known : all)
    if (known.file == section.file && known.keys == section.keys) {
      add_missing(known.paths, section.paths);
      add_missing(known.verbs, section.verbs);
      for (const Key& key : section.keys->keys)  // those inside stand there too
        if (const KeyTable* inside = table_inside(key))
          collect(all, {section.file, {section.path_of(key)}, key.kind == KeyKind::tables, inside, section.verbs});
      return;
    }
  all.push_back(section);
  // What a pattern repeats is known by its own table first.
  for (const bool pattern : {false, true})
    for (const Key& key : section.keys->keys) {
      const KeyTable* inside = table_inside(key);
      if (inside == nullptr || (key.name == "pattern") != pattern) continue;
      collect(all, {section.file,
                    {section.path_of(key)},
                    key.kind == KeyKind::tables,
                    inside,
                    key.verbs.empty() ? section.verbs : words_of(key.verbs)});
    }
}

}  // namespace

std::string Section::heading() const {
  if (path().empty()) return "a " + file + " file";
  return many ? "[[" + path() + "]]" : "[" + path() + "]";
}

const KeyTable* table_inside(const Key& key) {
  if (key.inside != nullptr) return &key.inside();
  if (key.kind != KeyKind::table && key.kind != KeyKind::tables) return nullptr;
  const auto known = tables_of_studies().find(key.name);
  return known == tables_of_studies().end() ? nullptr : known->second;
}

const std::vector<Section>& sections() {
  static const std::vector<Section> all = [] {
    std::vector<Section> found;
    collect(found, {"mechanism", {""}, false, &mechanism_keys(), {}});
    collect(found, {"study", {""}, false, &study_keys(), {}});
    collect(found, {"posterior", {""}, false, &posterior_keys(), {"budget"}});
    return found;
  }();
  return all;
}

}  // namespace boresight::app
