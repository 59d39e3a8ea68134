// A study file: a question about a mechanism. Here is what every study says; what a verb asks stands in the
// verb's own table
// ([sweep], [montecarlo], ...) and is read by the verb's analysis with the same `Cursor`.
//
//   Document document = Document::from_file("clearance-sweep.toml");
//   Cursor root(document);
//   const Study study = read_study(root);
//   const Mechanism mechanism(read_mechanism(study.mechanism_file, settings));
#pragma once

#include <optional>
#include <string>

#include "boresight/io/cursor.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "boresight_analyses/study/index_choice.hpp"

namespace boresight {

struct Study {
  std::string file;
  std::string mechanism_file;      // relative names are taken from the study file's folder
  std::optional<double> accuracy;  // relative, of the index
  IndexChoice index;
  Origin index_origin, start_origin;  // of its quantity, of its start
  std::string content_hash;           // of the study file
};

// Throws InputError. Tables of other verbs may stand in the file and are left alone.
Study read_study(Cursor& root, const std::string& content_hash);
// Throws InputError where the mechanism's motion does not have the index: no line of sight, a start beyond its end.
void check_index(const Study& study, const Mechanism& mechanism);
// The same of an index and a start that options name.
void check_line_of_sight(const IndexChoice& index, const Mechanism& mechanism, const Origin& origin,
                         const std::string& key);
void check_start(double start, const Mechanism& mechanism, const Origin& origin, const std::string& key);

}  // namespace boresight
