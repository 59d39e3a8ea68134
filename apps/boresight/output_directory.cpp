#include "output_directory.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <vector>

namespace boresight::app {
namespace fs = std::filesystem;
namespace {

// The files by which a directory is known to hold results although its summary.json is missing.
const std::vector<std::string> kResultFiles = {"report.html", "timeseries.csv", "events.csv", "sweep.csv", "restitution.csv",
                                               "samples.db"};

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

bool free_for(const fs::path& directory, const nlohmann::json& identity) {
  const Owner owner = owner_of(directory, identity);
  return owner == Owner::nobody || owner == Owner::this_study;
}

[[noreturn]] void fail(const fs::path& file, const char* step, int error) {
  throw WriteError("cannot write " + file.string() + ": " + step + ": " + std::strerror(error));
}

// Closes and removes the temporary file unless it was given its final name.
struct TemporaryFile {
  std::string name;
  int descriptor = -1;
  bool renamed = false;
  ~TemporaryFile() {
    if (descriptor >= 0) ::close(descriptor);
    if (!renamed && !name.empty()) ::unlink(name.c_str());
  }
};

void sync_directory(const fs::path& directory) {
  const int descriptor = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) return;  // the rename has happened; only its durability against a power cut is at stake
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

void write_atomically(const fs::path& file, const std::string& content) {
  const fs::path directory = file.has_parent_path() ? file.parent_path() : fs::path(".");
  TemporaryFile temporary;
  temporary.name = (directory / ("." + file.filename().string() + ".XXXXXX")).string();
  temporary.descriptor = ::mkstemp(temporary.name.data());
  if (temporary.descriptor < 0) {
    const int error = errno;
    temporary.name.clear();
    fail(file, "creating it", error);
  }
  for (std::size_t done = 0; done < content.size();) {
    const ssize_t n = ::write(temporary.descriptor, content.data() + done, content.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(file, "writing it", errno);
    done += static_cast<std::size_t>(n);
  }
  const mode_t mask = ::umask(0);
  ::umask(mask);
  if (::fchmod(temporary.descriptor, 0666 & ~mask) != 0) fail(file, "setting its permissions", errno);
  if (::fsync(temporary.descriptor) != 0 && errno != EINVAL) fail(file, "syncing it", errno);
  const int descriptor = temporary.descriptor;
  temporary.descriptor = -1;
  if (::close(descriptor) != 0) fail(file, "closing it", errno);
  if (::rename(temporary.name.c_str(), file.c_str()) != 0) fail(file, "renaming it into place", errno);
  temporary.renamed = true;
  sync_directory(directory);
}

OutputDirectory::OutputDirectory(fs::path path, nlohmann::json identity)
    : path_(std::move(path)), identity_(std::move(identity)) {}

OutputDirectory OutputDirectory::open(const std::string& asked, const std::string& verb,
                                      const std::string& file, nlohmann::json identity) {
  fs::path path = asked;
  if (asked.empty()) {
    const std::string stem = fs::path(file).stem().string();
    // "clearance-sweep.toml" swept is results/clearance-sweep, not results/clearance-sweep-sweep.
    const bool named_after_verb = stem == verb || (stem.size() > verb.size() && stem.ends_with("-" + verb));
    const fs::path base = fs::path("results") / (named_after_verb ? stem : stem + "-" + verb);
    path = base;
    for (int n = 2; !free_for(path, identity); ++n) path = base.string() + "-" + std::to_string(n);
  }
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_directory(path, error))
    throw OutputDirectoryError("--out " + path.string() +
                               ": found a file, expected a directory or a new name");
  switch (owner_of(path, identity)) {
    case Owner::another_study:
      throw OutputDirectoryError(
          "--out " + path.string() +
          ": holds the results of another study (other verb, file, settings or options); "
          "give another --out, or remove it");
    case Owner::unknown:
      throw OutputDirectoryError("--out " + path.string() +
                                 ": holds results without a readable summary.json to say whose they are; "
                                 "give another --out, or remove it");
    case Owner::nobody:
    case Owner::this_study:
      break;
  }
  fs::create_directories(path, error);
  if (error)
    throw OutputDirectoryError("--out " + path.string() +
                               ": cannot create the directory: " + error.message());
  if (::access(path.c_str(), W_OK | X_OK) != 0)
    throw OutputDirectoryError("--out " + path.string() + ": cannot write there: " + std::strerror(errno));
  return OutputDirectory(std::move(path), std::move(identity));
}

void OutputDirectory::write(const std::string& name,
                            const std::function<void(std::ostream&)>& content) const {
  std::ostringstream text;
  content(text);
  write_atomically(path_ / name, std::move(text).str());
}

}  // namespace boresight::app
