#include "boresight/io/mechanism_file.hpp"

#include <algorithm>
#include <utility>

#include "boresight/io/mechanism_sections.hpp"
#include "boresight/keys/mechanism_keys.hpp"
#include "boresight/mechanism/error.hpp"

namespace boresight {
namespace {

MechanismDescription read(Document& document, std::vector<AssumedValue>* assumed = nullptr) {
  Cursor root(document);
  if (root.has("mechanism") && !root.has("body"))
    root.fail_found("mechanism", "a study file", "a mechanism file, such as the one that it names");
  root.only(mechanism_keys());
  MechanismDescription mechanism;
  mechanism.origin = {document.filename(), 0};
  mechanism.content_hash = document.content_hash();
  mechanism.settings = document.settings();
  root.integer("format");
  mechanism.name = root.text("name", document.filename());
  root.require(!mechanism.name.empty(), "name", "a name, or no key at all");
  mechanism.gravity = root.vector("gravity");

  Sections sections = gather_sections(root);
  for (Cursor& body : sections.bodies) mechanism.bodies.push_back(read_body(body, mechanism));
  if (mechanism.bodies.empty()) root.fail_found("body", "no body", "at least one [[body]]");
  if (std::none_of(mechanism.bodies.begin(), mechanism.bodies.end(),
                   [](const auto& b) { return b.boresight.has_value(); })) {
    root.fail_found("body", "no body with a boresight", "boresight = [0, 0, 1] or another direction on one body");
  }
  if (root.has("payload")) {
    Cursor payload = root.table("payload");
    mechanism.payload = read_payload(payload, mechanism);
  }
  for (Cursor& joint : sections.joints) mechanism.joints.push_back(read_joint(joint, mechanism));
  std::vector<Cursor> clearances = expand_clearances(sections.clearances, mechanism);
  for (Cursor& clearance : clearances) mechanism.clearances.push_back(read_clearance(clearance, mechanism, assumed));
  Cursor motion = root.table("motion");
  mechanism.motion = read_motion(motion, mechanism);
  // After those of the file, whose paths count from 1.
  const std::vector<SpringDescription> preloads = std::exchange(mechanism.springs, {});
  for (Cursor& spring : sections.springs) mechanism.springs.push_back(read_spring(spring, mechanism));
  mechanism.springs.insert(mechanism.springs.end(), preloads.begin(), preloads.end());
  for (Cursor& load : sections.loads) mechanism.loads.push_back(read_load(load, mechanism));
  for (Cursor& error : sections.errors) mechanism.errors.push_back(read_error(error, mechanism));
  Cursor initial = root.table_or_empty("initial");
  read_initial(initial, mechanism);
  if (root.has("pointing")) {
    Cursor pointing = root.table("pointing");
    mechanism.line_of_sight = read_pointing(pointing, mechanism);
  }
  root.finish();
  document.refuse_unused_settings();
  return mechanism;
}

}  // namespace

MechanismDescription read_mechanism(const std::string& path, const std::vector<Setting>& settings) {
  Document document = Document::from_file(path, settings);
  return read(document);
}

MechanismDescription read_mechanism_text(std::string_view text, const std::string& filename,
                                         const std::vector<Setting>& settings) {
  Document document = Document::from_text(text, filename, settings);
  return read(document);
}

std::set<std::string> settable_paths(const std::string& path, const std::vector<Setting>& settings) {
  Document document = Document::from_file(path, settings);
  document.record_paths();
  read(document);
  return document.asked_paths();
}

std::map<std::string, std::string> written_values(const std::string& path, const std::vector<Setting>& settings) {
  Document document = Document::from_file(path, settings);
  document.record_paths();
  read(document);
  return document.written();
}

std::vector<AssumedValue> assumed_values(const std::string& path, const std::vector<Setting>& settings) {
  Document document = Document::from_file(path, settings);
  std::vector<AssumedValue> assumed;
  read(document, &assumed);
  return assumed;
}

std::vector<AssumedValue> assumed_values_of_text(std::string_view text, const std::string& filename,
                                                 const std::vector<Setting>& settings) {
  Document document = Document::from_text(text, filename, settings);
  std::vector<AssumedValue> assumed;
  read(document, &assumed);
  return assumed;
}

}  // namespace boresight
