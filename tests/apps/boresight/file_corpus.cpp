#include "file_corpus.hpp"

#include <algorithm>

#include "boresight/io/mechanism_file.hpp"
#include "boresight_analyses/allocation/allocation_plan.hpp"
#include "boresight_analyses/budget/budget_plan.hpp"
#include "boresight_analyses/calibration/calibration_plan.hpp"
#include "boresight_analyses/matching/matching_plan.hpp"
#include "boresight_analyses/montecarlo/montecarlo_plan.hpp"
#include "boresight_analyses/sensitivity/sensitivity_plan.hpp"
#include "boresight_analyses/sweep/sweep_plan.hpp"
#include "command_line/study_input.hpp"

namespace boresight::app {

std::string kind_of(const Node& root) {
  if (root.member("mechanism") != nullptr) return "study";
  return root.member("format") != nullptr ? "mechanism" : "posterior";
}

nlohmann::json json_of(const Node& node) {
  nlohmann::json json;
  switch (node.kind) {
    case Node::Kind::table:
      json = nlohmann::json::object();
      for (const auto& [key, member] : node.members) json[key] = json_of(member);
      return json;
    case Node::Kind::array:
      json = nlohmann::json::array();
      for (const Node& item : node.items) json.push_back(json_of(item));
      return json;
    case Node::Kind::integer:
      return node.integer;
    case Node::Kind::number:
      return node.number;
    case Node::Kind::boolean:
      return node.boolean;
    case Node::Kind::string:
    case Node::Kind::date:
      return node.text;
  }
  return json;
}

std::vector<CorpusFile> file_corpus() {
  std::vector<CorpusFile> files;
  for (const char* folder : {BORESIGHT_EXAMPLES, BORESIGHT_TEMPLATES, BORESIGHT_EVERY_KEY})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.path().extension() == ".toml") files.push_back({entry.path(), ""});
  std::sort(files.begin(), files.end(), [](const CorpusFile& a, const CorpusFile& b) { return a.path < b.path; });
  for (CorpusFile& file : files) file.kind = kind_of(Document::from_file(file.path).root());
  return files;
}

void read_whole(const std::filesystem::path& file, const std::string& kind) {
  if (kind == "mechanism") read_mechanism(file);
  if (kind != "study") return;  // a posterior is read by the budget that names it
  StudyInput in(file, {});
  Cursor& root = in.root;
  const MechanismDescription& mechanism = in.mechanism->description();
  if (root.has("sweep")) read_sweep_plan(root, mechanism, in.trial);
  if (root.has("montecarlo")) read_montecarlo_plan(root, in.study, mechanism, in.trial);
  if (root.has("sensitivity")) read_sensitivity_plan(root, in.study, mechanism, in.trial);
  if (root.has("match")) read_matching_plan(root, in.study, mechanism, in.trial);
  if (root.has("allocate")) read_allocation_plan(root, in.study, mechanism, in.trial);
  if (root.has("budget")) read_budget_plan(root, in.study, mechanism, in.mechanism->duration(), in.trial);
  if (root.has("calibrate")) read_calibration_plan(root, in.study, mechanism);
}

}  // namespace boresight::app
