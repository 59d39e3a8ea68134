// Every table that a mechanism, study or posterior file may hold, collected from the tables of keys that the readers use.
#pragma once

#include <string>
#include <vector>

#include "boresight/keys/key.hpp"

namespace boresight::app {

struct Section {
  std::string file;  // "mechanism", "study", "posterior"
  std::vector<std::string>
      paths;          // where it may stand: "montecarlo.requirement", "allocate.requirement"; "" for the file itself
  bool many = false;  // [[...]]
  const KeyTable* keys = nullptr;
  std::vector<std::string> verbs;  // that read it; none: all that take such a file

  const std::string& path() const { return paths.front(); }
  std::string heading() const;  // "[[clearance]]", "[clearance.friction]", "a mechanism file"
  std::string path_of(const Key& key) const { return path().empty() ? key.name : path() + "." + key.name; }
};

// In the order of the files, a table before those inside it; each table once for a file.
const std::vector<Section>& sections();

// The table behind a key of a table of the file's: a study's verbs bring their own. nullptr where nothing is read from it.
const KeyTable* table_inside(const Key& key);

}  // namespace boresight::app
