#include "boresight_analyses/study/study.hpp"

#include <cstdio>
#include <filesystem>
#include <vector>

#include "boresight/io/names_of.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
Study read_study(Cursor& root, const std::string& content_hash) {
  if (!root.has("mechanism") && root.has("body"))
    root.fail_found("body", "a mechanism file", "a study file, which names its mechanism: mechanism = \"FILE\"");
  root.only({"format", "mechanism", "accuracy", "index", "random", "correlation", "sweep", "montecarlo", "sensitivity",
             "match", "allocate", "calibrate", "budget", "chart"});
  const long long format = root.integer("format");
  root.require(format == 1, "format", "1");

  Study study;
  study.file = root.origin().file;
  study.content_hash = content_hash;
  const std::filesystem::path mechanism = root.text("mechanism");
  study.mechanism_file =
      mechanism.is_absolute()
          ? mechanism.string()
          : (std::filesystem::path(study.file).parent_path() / mechanism).lexically_normal().string();
  if (root.has("accuracy")) {
    study.accuracy = root.quantity("accuracy", kRatio);
    root.require(*study.accuracy > 0.0 && *study.accuracy < 1.0, "accuracy", "more than 0 % and less than 100 %");
  }
  if (root.has("index")) {
    Cursor index = root.table("index");
    index.only({"quantity", "statistic", "start"});
    study.index_origin = index.origin("quantity");
    study.start_origin = index.origin("start");
    study.index.quantity = index.choice("quantity", names_of(quantity_names()), study.index.quantity);
    study.index.statistic = index.choice("statistic", names_of(statistic_names()), study.index.statistic);
    study.index.start = index.quantity("start", kDuration, 0.0);
    index.require(study.index.start >= 0.0, "start", "a time of zero or more");
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
