#include "program_trial.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <regex>
#include <sstream>

#include "studies.hpp"

namespace boresight::gauntlet {
namespace {

constexpr double kAutoAccuracy = 0.05;
constexpr int kInterrupted = 130;
constexpr double kNoise = 0.01;
constexpr int kNoiseSeed = 5;

void write(const std::string& file, const std::string& text) { std::ofstream(file) << text; }

std::string read(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

// The last line that says something.
std::string last_line(const std::string& output) {
  std::string last, line;
  std::stringstream lines(output);
  while (std::getline(lines, line))
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  return last;
}

}  // namespace

ProgramTrial::ProgramTrial(const Mechanism& mechanism, const std::string& text, const TrialOptions& options,
                           Verdict& verdict)
    : mechanism_(mechanism), options_(options), verdict_(verdict) {
  std::string pattern = (std::filesystem::temp_directory_path() / "gauntlet-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  folder_ = pattern;
  write(path("scene.toml"), text);
}

ProgramTrial::~ProgramTrial() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

int ProgramTrial::call(const std::string& stage, const std::vector<std::string>& arguments, const std::string& out) {
  std::vector<std::string> all = {options_.program};
  all.insert(all.end(), arguments.begin(), arguments.end());
  for (const std::string& a : {std::string("--quiet"), std::string("--out"), out}) all.push_back(a);
  Limits limits = options_.limits;
  limits.cpu_seconds *= 2.0;
  const ProgramOutcome outcome = run_program(limits, folder_, all);
  verdict_.cpu_seconds += outcome.cpu_seconds;
  if (outcome.end == Outcome::End::crashed) verdict_.fault("crash", stage, outcome.reason);
  if (outcome.end == Outcome::End::out_of_time) verdict_.fault("hang", stage, outcome.reason);
  if (outcome.end != Outcome::End::answered) return -1;
  const std::string said = last_line(outcome.output);
  if (outcome.asked_to_end &&
      outcome.status == kInterrupted) {  // long, but it hears; what it wrote must still be whole
    verdict_.refusals.push_back({stage, "longer than the limit, ended when asked to"});
    if (std::filesystem::exists(path(out) + "/summary.json")) search_outputs(stage, out);
    return -1;
  }
  if (outcome.status == 2 || outcome.status == 3) {
    if (said.empty()) verdict_.fault("silent", stage, fmt::format("status {} without a word", outcome.status));
    // A study of the gauntlet's own that is refused for how it is written shows nothing of the program.
    static const std::regex in_a_study(R"(\b(?!scene\.)[a-z]+\.toml:\d+: )");
    if (outcome.status == 2 && std::regex_search(said, in_a_study)) verdict_.fault("verb", stage, said);
    if (outcome.output.find("a fault in the program itself") != std::string::npos) verdict_.fault("crash", stage, said);
    verdict_.refusals.push_back({stage, said});
  } else if (outcome.status != 0 && outcome.status != 1) {
    verdict_.fault("crash", stage, fmt::format("status {}: {}", outcome.status, said));
  } else {
    search_outputs(stage, out);
  }
  return outcome.status;
}

void ProgramTrial::search_outputs(const std::string& stage, const std::string& out) {
  static const std::regex in_table(R"((^|[,\n])-?(nan|inf)\b)", std::regex::icase);
  for (const auto& entry : std::filesystem::directory_iterator(path(out))) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".csv") continue;
    std::smatch found;
    const std::string text = read(entry.path());
    if (std::regex_search(text, found, in_table))
      verdict_.fault("not finite", stage, entry.path().filename().string() + " holds " + found.str(2));
    // Numbers that are none are written as nothing; in a motion's history each has one.
    static const std::regex nothing(R"((\n,|,,|,\n))");
    if (entry.path().filename() == "timeseries.csv" && std::regex_search(text, nothing))
      verdict_.fault("not finite", stage, "timeseries.csv has cells without a number");
  }
  if (stage == "export") return;  // writes a table and nothing else
  const Json json = summary(out);
  if (json.is_discarded()) {
    verdict_.fault("verb", stage, "summary.json is missing or no JSON");
    return;
  }
  if (!json.contains("index") || !json["index"].is_object()) return;
  for (const auto& [name, value] : json["index"].items())
    if (value.is_null() || (value.is_object() && value.contains("max") && value["max"].is_null()))
      verdict_.fault("not finite", stage, "index." + name + " is null");
}

Json ProgramTrial::summary(const std::string& out) const {
  return Json::parse(read(path(out) + "/summary.json"), nullptr, false);
}

void ProgramTrial::check() { call("check", {"check", "scene.toml"}, "check"); }

void ProgramTrial::automatic(const AutoReference& reference) {
  if (call("auto", {"run", "scene.toml", "--accuracy", fmt::format("{} %", 100 * kAutoAccuracy)}, "auto") != 0) return;
  const Json json = summary("auto");
  const double value = json["index"]["position_error"]["max"];
  // Where the program says that it does not know better, its word holds.
  const std::string why = json.value("rung_why", std::string());
  double error = 0.0;
  if (json.contains("pilot") && json["pilot"]["reference_error"].is_number()) error = json["pilot"]["reference_error"];
  if (json.contains("pilot") && json["pilot"]["reference_error"].is_null()) return;  // it says that it knows none
  // Where there is no play and no error there is no rung to choose, and all that there is is what steps leave out: of that too its word holds.
  const Json& steps = json["error_estimate"]["discretisation"];
  const double by_steps = !json.contains("pilot") && steps.is_number() ? steps.get<double>() * value : 0.0;
  const double allowed = (kAutoAccuracy + error) * reference.value + by_steps + reference.slack;
  if (std::abs(value - reference.value) > allowed)
    verdict_.fault(
        "auto", json.value("rung", std::string("?")),
        fmt::format("{:.4g}, reference {:.4g} ({:.2g} % apart, {:.2g} % allowed): {}", value, reference.value,
                    100 * std::abs(value / reference.value - 1.0), 100 * allowed / reference.value, why));
}

void ProgramTrial::verbs() {
  const int ran = call("run quasistatic", {"run", "scene.toml", "--rung", "quasistatic"}, "quasistatic");
  const int motion = call("run perturbation", {"run", "scene.toml", "--rung", "perturbation"}, "data");
  double typical = 1e-4;
  for (const auto& [status, out] : {std::pair{ran, "quasistatic"}, std::pair{motion, "data"}})
    if (status == 0) typical = std::max(1e-12, summary(out)["index"]["position_error"]["rms"].get<double>());
  if (motion == 0) {
    // The first columns of a run's own series, as a rig would measure them: with noise, a hundredth of what there is to see.
    std::mt19937_64 bits(kNoiseSeed);
    std::normal_distribution<double> noise(0.0, kNoise * typical);
    std::stringstream in(read(path("data/timeseries.csv"))), out;
    std::string line;
    for (bool first = true; std::getline(in, line); first = false) {
      std::vector<std::string> cells;
      std::stringstream row(line);
      for (std::string cell; std::getline(row, cell, ',') && cells.size() < 4;) cells.push_back(cell);
      if (cells.size() < 4) continue;
      for (std::size_t k = 1; k < cells.size() && !first; ++k)
        cells[k] = fmt::format("{:.9g}", std::stod(cells[k]) + noise(bits));
      out << (first ? "t [s], dx [m], dy [m], dz [m]" : fmt::format("{}", fmt::join(cells, ", "))) << '\n';
    }
    write(path("measured.csv"), out.str());
  }
  for (const Study& study : studies(mechanism_, typical, "measured.csv")) {
    if (study.verb == "calibrate" && motion != 0) continue;
    if (study.verb == "export" && !std::filesystem::exists(path("out montecarlo"))) continue;
    if (!study.file.empty()) write(path(study.file), study.text);
    std::vector<std::string> arguments = {study.verb, study.verb == "export" ? "out montecarlo"
                                                      : study.file.empty()   ? "scene.toml"
                                                                             : study.file};
    arguments.insert(arguments.end(), study.arguments.begin(), study.arguments.end());
    call(study.stage, arguments, study.verb == "export" ? "exported" : "out " + study.stage);
  }
}

}  // namespace boresight::gauntlet
