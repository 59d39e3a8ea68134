#include "results/whole_results.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

namespace boresight::app {
namespace fs = std::filesystem;
namespace {

const char* const kStaged = ".being-written";
const char* const kPublished = ".written";
const char* const kSummary = "summary.json";

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

void move(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0) fail(to, "renaming it into place", errno);
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed)) names.push_back(entry.path().filename().string());
  return names;
}

nlohmann::json read_json(const fs::path& file) {
  std::ifstream in(file);
  return nlohmann::json::parse(in, nullptr, false);
}

bool is_interrupted(const fs::path& summary) {
  const nlohmann::json json = read_json(summary);
  return json.is_object() && json.value("interrupted", nlohmann::json(false)) == true;
}

// Of a study that keeps its runs, what is new holds all that was there before.
bool is_whole_without_store(const fs::path& summary) {
  const nlohmann::json json = read_json(summary);
  if (!json.is_object() || json.value("interrupted", nlohmann::json(true)) != false || !json.contains("files"))
    return false;
  for (const auto& file : json["files"])
    if (file.is_string() && file.get<std::string>().ends_with(".db")) return false;
  return true;
}

// The files that a summary names as its own, but for the stores.
std::set<std::string> files_of(const fs::path& summary) {
  std::set<std::string> names;
  const nlohmann::json json = read_json(summary);
  if (!json.is_object() || !json.contains("files") || !json["files"].is_array()) return names;
  for (const auto& file : json["files"]) {
    if (!file.is_string()) continue;
    const std::string name = file.get<std::string>();
    if (name.find('/') == std::string::npos && name != kSummary && !name.ends_with(".db") && !name.starts_with("."))
      names.insert(name);
  }
  return names;
}

void move_into_place(const fs::path& folder) {
  const fs::path published = folder / kPublished;
  std::error_code failed;
  if (fs::exists(published / kSummary, failed)) {
    std::set<std::string> old = files_of(folder / kSummary);
    for (const std::string& name : files_of(published / kSummary)) old.erase(name);
    // Without a summary the folder says that it is incomplete, until the new one comes last.
    ::unlink((folder / kSummary).c_str());
    for (const std::string& name : names_in(published)) {
      old.erase(name);
      if (name != kSummary) move(published / name, folder / name);
    }
    for (const std::string& name : old) ::unlink((folder / name).c_str());
    move(published / kSummary, folder / kSummary);
    sync_directory(folder);
  }
  fs::remove_all(published, failed);
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

void stage(const fs::path& folder, const std::string& name, const std::string& content) {
  const fs::path staged = folder / kStaged;
  if (::mkdir(staged.c_str(), 0777) != 0 && errno != EEXIST)
    fail(folder / name, "making a folder to write it in", errno);
  try {
    write_atomically(staged / name, content);
  } catch (const WriteError& error) {
    // The user knows the file by the place it would have come to.
    std::string said = error.what();
    const std::string inner = (staged / name).string();
    if (const std::size_t at = said.find(inner); at != std::string::npos)
      said.replace(at, inner.size(), (folder / name).string());
    throw WriteError(said);
  }
}

bool publish(const fs::path& folder) {
  const fs::path staged = folder / kStaged;
  std::error_code failed;
  if (!fs::exists(staged, failed)) return true;
  if (is_interrupted(staged / kSummary) && is_whole_without_store(folder / kSummary)) {
    discard_staged(folder);
    return false;
  }
  sync_directory(staged);
  move(staged, folder / kPublished);
  sync_directory(folder);
  move_into_place(folder);
  return true;
}

void place_staged(const fs::path& folder) {
  for (const std::string& name : names_in(folder / kStaged)) move(folder / kStaged / name, folder / name);
  discard_staged(folder);
  sync_directory(folder);
}

void recover(const fs::path& folder) {
  std::error_code failed;
  if (fs::exists(folder / kPublished, failed)) move_into_place(folder);
  discard_staged(folder);
  // Of a write_atomically() that a kill cut short.
  for (const std::string& name : names_in(folder))
    if (name.starts_with("." + std::string(kSummary) + ".")) ::unlink((folder / name).c_str());
}

void discard_staged(const fs::path& folder) noexcept {
  std::error_code failed;
  fs::remove_all(folder / kStaged, failed);
}

}  // namespace boresight::app
