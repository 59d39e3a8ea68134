#include "results/output_directory.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include "terminal/terminal.hpp"

namespace boresight::app {
namespace fs = std::filesystem;
namespace {

// The files by which a directory is known to hold results although its summary.json is missing.
const std::vector<std::string> kResultFiles = {
    "report.html",     "timeseries.csv", "events.csv",      "poincare.csv",    "parts.csv",        "sweep.csv",
    "restitution.csv", "samples.db",     "sobol.csv",       "local.csv",       "posterior.toml",   "limits.csv",
    "growth.csv",      "allocation.csv", "evaluations.csv", "levels.csv",      "rungs.csv",        "evaluations.db",
    "chart.csv",       "flight.csv",     "unfinished.db",   "confirmation.db", "conditioning.csv", "classical.csv",
    "spectra.csv",     "report.json"};

enum class Owner { nobody, this_study, another_study, unknown };

Owner owner_of(const fs::path& directory, const nlohmann::json& identity) {
  std::error_code failed;
  if (!fs::exists(directory, failed)) return Owner::nobody;
  std::ifstream summary(directory / "summary.json");
  if (!summary) {
    const bool results = std::any_of(kResultFiles.begin(), kResultFiles.end(), [&](const std::string& name) {
      std::error_code unreadable;
      return fs::exists(directory / name, unreadable);
    });
    return results || fs::exists(directory / "summary.json", failed) ? Owner::unknown : Owner::nobody;
  }
  const nlohmann::json found = nlohmann::json::parse(summary, nullptr, false);
  if (!found.is_object() || !found.contains("identity")) return Owner::unknown;
  return found["identity"] == identity ? Owner::this_study : Owner::another_study;
}

// The folders of this path that are not there yet, outermost first.
std::vector<fs::path> missing_folders(const fs::path& path) {
  std::vector<fs::path> missing;
  std::error_code failed;
  for (fs::path folder = path; !folder.empty() && !fs::exists(folder, failed); folder = folder.parent_path()) {
    missing.insert(missing.begin(), folder);
    if (folder == folder.parent_path()) break;
  }
  return missing;
}

void remove_empty(const std::vector<fs::path>& made) {
  for (auto folder = made.rbegin(); folder != made.rend(); ++folder)
    if (::rmdir(folder->c_str()) != 0) return;
}

bool has_store(const fs::path& directory) {
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(directory, failed))
    if (entry.path().extension() == ".db") return true;
  return false;
}

[[noreturn]] void refuse(const fs::path& directory, const std::string& why) {
  throw OutputDirectoryError("--out " + directory.string() + ": " + why);
}

struct Opened {
  std::optional<FolderClaim> claim;  // nothing: another process writes there
  std::vector<fs::path> made;
  Owner owner = Owner::nobody;
};

// Makes the folder where there is none, claims it, and says whose it is.
Opened open_folder(const fs::path& path, const nlohmann::json& identity) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_directory(path, error))
    refuse(path, "found a file, expected a directory or a new name");
  Opened opened;
  for (int attempt = 0; !opened.claim; ++attempt) {
    opened.made = missing_folders(path);
    fs::create_directories(path, error);
    if (error) refuse(path, "cannot create the directory: " + error.message());
    opened.claim = FolderClaim::take(path);
    if (!opened.claim) {
      opened.owner = owner_of(path, identity);
      return opened;
    }
    // One that ended just now may have removed it, being empty.
    if (!fs::exists(path, error) && attempt < 100) opened.claim.reset();
  }
  if (::access(path.c_str(), W_OK | X_OK) == 0) recover(path);
  opened.owner = owner_of(path, identity);
  return opened;
}

bool free_for_us(const Opened& opened) {
  return opened.claim && (opened.owner == Owner::nobody || opened.owner == Owner::this_study);
}

}  // namespace

OutputDirectory::OutputDirectory(fs::path path, nlohmann::json identity, std::optional<FolderClaim> claim,
                                 std::vector<fs::path> made)
    : path_(std::move(path)), identity_(std::move(identity)), claim_(std::move(claim)), made_(std::move(made)) {}

OutputDirectory::OutputDirectory(OutputDirectory&& other) noexcept
    : path_(std::move(other.path_)),
      identity_(std::move(other.identity_)),
      claim_(std::exchange(other.claim_, std::nullopt)),
      made_(std::move(other.made_)) {}

OutputDirectory::~OutputDirectory() {
  if (!claim_) return;  // moved from
  discard_staged(path_);
  remove_empty(made_);
}

OutputDirectory OutputDirectory::open(const std::string& asked, const std::string& verb, const std::string& file,
                                      nlohmann::json identity) {
  return open(asked, verb, file, "", std::move(identity));
}

OutputDirectory OutputDirectory::open(const std::string& asked, const std::string& verb, const std::string& file,
                                      const std::string& name, nlohmann::json identity) {
  fs::path path = asked;
  Opened opened;
  if (asked.empty()) {
    const std::string stem = fs::path(file).stem().string();
    // "clearance-sweep.toml" swept is results/clearance-sweep, not results/clearance-sweep-sweep.
    const bool named_after_verb = stem == verb || (stem.size() > verb.size() && stem.ends_with("-" + verb));
    const fs::path base = fs::path("results") / (!name.empty() ? name : named_after_verb ? stem : stem + "-" + verb);
    path = base;
    for (int n = 2;; ++n) {
      opened = open_folder(path, identity);
      if (free_for_us(opened)) break;
      // A study that keeps its runs goes on in its own folder, once that is free.
      if (!opened.claim && opened.owner == Owner::this_study && has_store(path)) break;
      path = base.string() + "-" + std::to_string(n);
    }
  } else {
    opened = open_folder(path, identity);
  }
  if (!opened.claim) refuse(path, "another run is writing there; wait for it to end, or give another --out");
  switch (opened.owner) {
    case Owner::another_study:
      refuse(path,
             "holds the results of another study (other verb, file, settings or options); "
             "give another --out, or remove it");
    case Owner::unknown:
      refuse(path,
             "holds results without a readable summary.json to say whose they are; "
             "give another --out, or remove it");
    case Owner::nobody:
    case Owner::this_study:
      break;
  }
  if (::access(path.c_str(), W_OK | X_OK) != 0)
    refuse(path, std::string("cannot write there: ") + std::strerror(errno));
  return OutputDirectory(std::move(path), std::move(identity), std::move(opened.claim), std::move(opened.made));
}

void OutputDirectory::write(const std::string& name, const std::function<void(std::ostream&)>& content) const {
  std::ostringstream text;
  content(text);
  stage(path_, name, std::move(text).str());
}

void OutputDirectory::publish() const {
  if (!app::publish(path_))
    fmt::print(stderr, "boresight: interrupted; {} keeps the whole results that it held before\n",
               printable(path_.string()));
}

}  // namespace boresight::app
