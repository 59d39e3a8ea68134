// boresight import FILE: a mechanism file from URDF, SDF or MJCF.
#include <fmt/format.h>

#include <filesystem>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight/mechanism/mechanism.hpp"
#include "command_line/declared_option.hpp"
#include "command_line/verb.hpp"
#include "exchange/mechanism_text.hpp"
#include "exchange/readers.hpp"
#include "results/output_directory.hpp"
#include "results/whole_results.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

namespace fs = std::filesystem;

// "camera:z", "camera:-x", "camera".
void set_boresight(ImportChoices& choices, const std::string& text) {
  if (text.empty()) return;
  const std::size_t colon = text.rfind(':');
  const std::string axis = colon == std::string::npos ? "" : text.substr(colon + 1);
  const bool back = axis.starts_with("-");
  const std::size_t k = std::string("xyz").find(back ? axis.substr(1) : axis);
  if (axis.size() == (back ? 2u : 1u) && k != std::string::npos) {
    choices.boresight_part = text.substr(0, colon);
    choices.boresight_axis = (back ? -1.0 : 1.0) * Vec3::Unit(static_cast<int>(k));
  } else {
    choices.boresight_part = text;  // names of SDF hold colons
  }
}

// "pan=0.5*sin(t); tilt; lift=0.1": joints, and their courses.
void set_drives(ImportChoices& choices, const std::string& text) {
  if (text.empty()) return;
  choices.drives_given = true;
  if (text == "none") return;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    std::string one = text.substr(begin, end - begin);
    begin = end + 1;
    const auto trim = [](std::string t) {
      while (!t.empty() && t.front() == ' ') t.erase(0, 1);
      while (!t.empty() && t.back() == ' ') t.pop_back();
      return t;
    };
    const std::size_t equals = one.find('=');
    const std::string name = trim(one.substr(0, equals));
    const std::string course = equals == std::string::npos ? "0" : trim(one.substr(equals + 1));
    if (name.empty() || course.empty())
      throw InputError({"command line", 0}, "--drive", "\"" + text + "\"",
                       "joints such as \"pan=0.5*sin(t); tilt\", or none");
    if (!choices.drives.emplace(name, course).second)
      throw InputError({"command line", 0}, "--drive", "\"" + name + "\" twice", "each joint once");
  }
}

class ImportVerb : public Verb {
 public:
  std::string name() const override { return "import"; }
  std::string file_kind() const override { return "URDF, SDF or MJCF"; }
  std::string summary() const override {
    return "a mechanism file from URDF, SDF or MJCF, with what could not be taken over";
  }
  std::string example() const override {
    return "boresight convert antenna/mechanism.toml --to antenna.sdf\n  boresight import antenna.sdf --to ideal.toml";
  }
  std::string next(const Command&, bool) const override { return ""; }
  std::vector<std::string> unused_options() const override {
    return {"--set", "--out", "--rung", "--accuracy", "--jobs", "--json"};
  }
  void declare_options(CLI::App& app) override {
    declare_option(app, "--to,--out", to_, "the mechanism file to write; otherwise FILE's name with .toml, here",
                   "FILE");
    declare_option(
        app, "--boresight", boresight_,
        "the link that points, and its axis that does: camera:x; otherwise x of the link furthest from the ground",
        "LINK:AXIS");
    declare_option(
        app, "--drive", drive_,
        "driven joints and their courses: \"pan=0.5*sin(t); tilt\"; none: no joint; otherwise those that FILE drives",
        "JOINTS");
    declare_option(app, "--ground", ground_, "a link that stands still; otherwise as FILE says", "LINK");
    declare_option_with_default(app, "--duration", duration_, "how long the motion lasts", "TIME");
  }

  int execute(const Command& command) override {
    ImportChoices choices;
    set_boresight(choices, boresight_);
    set_drives(choices, drive_);
    choices.ground = ground_;
    choices.duration = duration_;
    Drawing drawing = read_drawing(command.file);
    // The file's name may hold bytes that no TOML may.
    const std::string source = printable(fs::path(command.file).filename().string()) + " (" + drawing.format + ")";
    const Assembly assembly = assembled(std::move(drawing), choices);
    const std::string text = mechanism_text(assembly, source, duration_);
    const fs::path to = to_.empty() ? fs::path(fs::path(command.file).stem().string() + ".toml") : fs::path(to_);
    check(text, command.file);
    std::error_code error;
    if (fs::exists(fs::symlink_status(to, error)))
      throw OutputDirectoryError(to.string() + ": is there already; give another --to, or remove it");
    write_atomically(to, text);
    if (!command.quiet) say(assembly, to.string());
    return kDone;
  }

 private:
  // What is written can be read, or nothing is written. A fault is one of the option or of the file that it came from.
  static void check(const std::string& text, const std::string& file) {
    try {
      Mechanism{read_mechanism_text(text, file)};
    } catch (const InputError& fault) {
      const bool of_drive = fault.key.starts_with("motion.drives"), of_duration = fault.key == "motion.duration";
      const Origin from = of_drive || of_duration ? Origin{"command line", 0} : Origin{file, 0};
      const std::string key = of_drive ? "--drive" : of_duration ? "--duration" : fault.key;
      throw InputError(from, key, fault.found, fault.expected, fault.nearest);
    }
  }

  static void say(const Assembly& assembly, const std::string& to) {
    const MechanismDescription& m = assembly.mechanism;
    double mass = 0.0;
    for (const BodyDescription& body : m.bodies) mass += body.mass;
    tell("{}: {} of {:.4g} kg together, {}, {} of them driven\n", to, how_many(m.bodies.size(), "body", "bodies"), mass,
         how_many(m.joints.size(), "joint"), assembly.drives.size());
    const auto list = [](const char* title, const std::vector<Remark>& remarks) {
      if (remarks.empty()) return;
      tell("{}\n", title);
      for (const std::string& line : grouped(remarks)) tell("  {}\n", line);
    };
    list("assumed, to be checked:", assembly.assumed);
    list("left out:", assembly.left_out);
    tell("next: boresight check {}\n", shell_word(to));
  }

  std::string to_, boresight_, drive_, ground_, duration_ = "1 s";
};

}  // namespace

std::unique_ptr<Verb> make_import_verb() { return std::make_unique<ImportVerb>(); }

}  // namespace boresight::app
