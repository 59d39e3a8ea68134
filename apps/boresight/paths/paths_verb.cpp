// boresight paths FILE: every path that --set and studies may name, with its value.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>

#include "boresight/io/cursor.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/io/referred_file.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/parameter_path.hpp"
#include "boresight_analyses/study/study.hpp"
#include "command_line/declared_option.hpp"
#include "command_line/verb.hpp"
#include "results/summary.hpp"
#include "terminal/columns.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

// A number of the mechanism: --set, [[random]] and their like take it.
struct NumberPath {
  std::string path, unit;      // unit: what it is computed in
  bool is_scale = false;       // of a drive: a share, whatever it is computed in
  std::vector<double> values;  // SI: one, or each where those that the path names differ
  std::string written;         // "0.1 mm"; "" where nobody gave it
};

struct Paths {
  std::vector<NumberPath> numbers;
  std::vector<std::string> others;  // --set alone takes these
};

// A study's mechanism, or the file itself.
std::string mechanism_of(const std::string& file) {
  Document document = Document::from_file(file);
  Cursor root(document);
  return root.has("mechanism") ? read_study(root, document.content_hash()).mechanism_file : file;
}

// Whether a number is what this text says: not where a copy of a pattern is turned, or another key decides the value.
bool says(const std::string& written, const NumberPath& n) {
  try {
    const double value =
        n.unit == "1" ? std::strtod(written.c_str(), nullptr) : parse_quantity(written, unit_called(n.unit, true));
    return std::all_of(n.values.begin(), n.values.end(),
                       [&](double x) { return std::abs(value - x) <= 1e-12 * std::abs(x); });
  } catch (const ValueFault&) {
    return false;
  }
}

Paths paths_of(const std::string& file, const std::vector<Setting>& settings) {
  const MechanismDescription mechanism = read_mechanism(file, settings);
  std::set<std::string> settable = settable_paths(file, settings);
  const Parameters parameters = nominal_parameters(mechanism);
  const std::map<std::string, std::string> written = written_values(file, settings);
  Paths paths;
  for (const std::string& path : parameter_paths(mechanism)) {
    if (settable.erase(path) == 0) continue;  // of another law
    const ParameterPath place(mechanism, path);
    NumberPath& number = paths.numbers.emplace_back(
        NumberPath{path, place.unit(), names_scales(mechanism, path), place.values(parameters), ""});
    if (const auto found = written.find(path); found != written.end() && says(found->second, number))
      number.written = found->second;
  }
  for (const std::string& path : settable)  // "body[2].name": of a table whose name is not read yet
    if (path.find('[') == std::string::npos && path != "format") paths.others.push_back(path);
  return paths;
}

Json json_of(const Paths& paths) {
  Json numbers = Json::array();
  for (const NumberPath& n : paths.numbers) {
    const Json value = n.values.size() == 1 ? Json(n.values.front()) : Json(n.values);
    numbers.push_back({{"path", n.path}, {"value", value}, {"unit", n.is_scale ? "1" : n.unit}});
    if (!n.written.empty()) numbers.back()["written"] = n.written;
  }
  return {{"numbers", numbers}, {"others", paths.others}};
}

void print(const Paths& paths) {
  const std::size_t widest = widest_of(paths.numbers, [](const NumberPath& n) { return n.path; });
  tell(
      "--set and the [[random]], [[sweep.axis]] ... of studies take these numbers (a * stands for any name: "
      "clearance.*.radial):\n");
  for (const NumberPath& n : paths.numbers)
    tell("  {}  {}\n", padded(n.path, widest),
         !n.written.empty()
             ? n.written
             : fmt::format("{:.6g}{}", fmt::join(n.values, " and "), n.is_scale || n.unit == "1" ? "" : " " + n.unit));
}

void print_others(const Paths& paths) {
  tell("--set alone takes these:\n");
  for (const std::string& path : paths.others) tell("  {}\n", path);
}

class PathsVerb : public Verb {
 public:
  std::string name() const override { return "paths"; }
  std::string file_kind() const override { return "mechanism or study"; }
  std::string summary() const override { return "every path that --set and studies may name, with value and unit"; }
  std::string json_is() const override { return "as JSON, to standard output"; }
  std::string example() const override { return "boresight paths antenna/mechanism.toml"; }
  std::vector<std::string> unused_options() const override {
    return {"--out", "--rung", "--accuracy", "--jobs", "--quiet"};
  }

  void declare_options(CLI::App& app) override {
    declare_flag(app, "--all", all_, "also what --set alone takes: points, axes, names, laws, expressions");
  }

  int execute(const Command& command) override {
    const Paths paths = paths_of(mechanism_of(command.file), command.settings);
    if (command.json) {
      std::cout << json_of(paths).dump(2) << "\n";
      return kDone;
    }
    print(paths);
    if (all_)
      print_others(paths);
    else
      tell("--set alone takes {} more, such as motion.duration; --all lists them\n", paths.others.size());
    return kDone;
  }

 private:
  bool all_ = false;
};

}  // namespace

std::unique_ptr<Verb> make_paths_verb() { return std::make_unique<PathsVerb>(); }

}  // namespace boresight::app
