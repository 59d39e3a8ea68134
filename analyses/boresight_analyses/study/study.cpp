#include "boresight_analyses/study/study.hpp"

#include <cstdio>
#include <filesystem>
#include <vector>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/study/study_keys.hpp"

namespace boresight {

Study read_study(Cursor& root, const std::string& content_hash) {
  if (!root.has("mechanism") && root.has("body"))
    root.fail_found("body", "a mechanism file", "a study file, which names its mechanism: mechanism = \"FILE\"");
  root.only(study_keys());
  root.integer("format");

  Study study;
  study.file = root.origin().file;
  study.content_hash = content_hash;
  const std::filesystem::path mechanism = root.text("mechanism");
  study.mechanism_file =
      mechanism.is_absolute()
          ? mechanism.string()
          : (std::filesystem::path(study.file).parent_path() / mechanism).lexically_normal().string();
  if (root.has("random")) root.tables("random");  // there are some, whichever verb reads them
  if (root.has("accuracy")) study.accuracy = root.quantity("accuracy");
  if (root.has("index")) {
    Cursor index = root.table("index");
    index.only(index_keys());
    study.index_origin = index.origin("quantity");
    study.start_origin = index.origin("start");
    study.index.quantity = index.choice("quantity");
    study.index.statistic = index.choice("statistic");
    study.index.start = index.quantity("start");
    index.finish();
  }
  return study;
}

void check_line_of_sight(const IndexChoice& index, const Mechanism& mechanism, const Origin& origin,
                         const std::string& key) {
  if (index.kind() != PointingQuantity::line_of_sight_error || mechanism.pointing().line_of_sight) return;
  throw InputError(origin, key, "\"line_of_sight_error\" of a mechanism that names no target",
                   "a [pointing] table with a target or a distance in " + mechanism.description().origin.file);
}

void check_start(double start, const Mechanism& mechanism, const Origin& origin, const std::string& key) {
  if (start < mechanism.duration()) return;
  char found[80], expected[80];
  std::snprintf(found, sizeof found, "%.6g s", start);
  std::snprintf(expected, sizeof expected, "a time before the motion's end at %.6g s", mechanism.duration());
  throw InputError(origin, key, found, expected);
}

void check_index(const Study& study, const Mechanism& mechanism) {
  check_line_of_sight(study.index, mechanism, study.index_origin, "index.quantity");
  check_start(study.index.start, mechanism, study.start_origin, "index.start");
}

}  // namespace boresight
