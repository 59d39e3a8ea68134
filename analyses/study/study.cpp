#include "boresight_analyses/study/study.hpp"

#include <filesystem>
#include <vector>

namespace boresight {
namespace {

template <typename Entries>
std::vector<std::string> names_of(const Entries& entries) {
  std::vector<std::string> names;
  for (const auto& entry : entries) names.emplace_back(entry.name);
  return names;
}

}  // namespace

Study read_study(Cursor& root, const std::string& content_hash) {
  if (!root.has("mechanism") && root.has("body"))
    root.fail_found("body", "a mechanism file",
                    "a study file, which names its mechanism: mechanism = \"FILE\"");
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
    root.require(*study.accuracy > 0.0 && *study.accuracy < 1.0, "accuracy",
                 "more than 0 % and less than 100 %");
  }
  if (root.has("index")) {
    Cursor index = root.table("index");
    index.only({"quantity", "statistic"});
    study.index.quantity = index.choice("quantity", names_of(quantity_names()), study.index.quantity);
    study.index.statistic = index.choice("statistic", names_of(statistic_names()), study.index.statistic);
    index.finish();
  }
  return study;
}

}  // namespace boresight
