// boresight export DIR: the samples of a study as CSV, one table for each store: samples.db becomes samples.csv; of a study on several
// rungs, whose samples bear the same numbers on each, samples-perturbation.db becomes samples-perturbation.csv.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/runs/sample_store.hpp"
#include "command_line/verb.hpp"
#include "results/output_directory.hpp"
#include "results/stored_samples.hpp"
#include "results/tables.hpp"
#include "terminal/exit_status.hpp"
#include "terminal/readable.hpp"
#include "terminal/terminal.hpp"

namespace boresight::app {
namespace {

// Written row by row under another name, synced and renamed: a table of any size, whole or not there. It replaces a table that was
// there only where all of whose lines are also in the new one, in their order: an earlier export of fewer samples. The other name is
// always the same and locked while it is written, so that the next export goes over what a killed one left.
class TableFile {
 public:
  explicit TableFile(std::filesystem::path file) : file_(std::move(file)) {
    const int descriptor = locked(file_.parent_path() / ("." + file_.filename().string() + ".part"));
    stream_ = ::ftruncate(descriptor, 0) == 0 ? ::fdopen(descriptor, "w") : nullptr;
    if (stream_ == nullptr) fail();
    std::error_code error;
    there_ = std::filesystem::exists(std::filesystem::symlink_status(file_, error));
    if (there_ && !std::filesystem::is_regular_file(file_, error)) refuse();
    old_.open(file_);
    next_old_line();
  }
  ~TableFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());  // while it is still locked
    if (stream_ != nullptr) std::fclose(stream_);
  }
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;

  void line(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size() || std::fputc('\n', stream_) == EOF) fail();
    if (old_line_ && *old_line_ == text) next_old_line();
  }
  void finish() {
    if (there_ && old_line_) refuse();
    if (std::fflush(stream_) != 0 || ::fsync(::fileno(stream_)) != 0) fail();
    if (std::rename(temporary_.c_str(), file_.c_str()) != 0) fail();
    temporary_.clear();
    std::fclose(stream_);
    stream_ = nullptr;
  }

 private:
  // A descriptor of this file, made where it is not there, that no other process has.
  int locked(const std::filesystem::path& part) {
    for (;;) {
      const int descriptor = ::open(part.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC | O_NOFOLLOW, 0666);
      if (descriptor < 0) fail();
      if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        ::close(descriptor);
        throw OutputDirectoryError(file_.string() +
                                   ": another export is writing it; wait for it to end, or give another --out");
      }
      // Whoever had it may have renamed or removed it meanwhile.
      struct stat own = {}, there = {};
      if (::fstat(descriptor, &own) == 0 && ::stat(part.c_str(), &there) == 0 && own.st_ino == there.st_ino &&
          own.st_dev == there.st_dev) {
        temporary_ = part.string();
        return descriptor;
      }
      ::close(descriptor);
    }
  }
  void next_old_line() {
    std::string text;
    if (std::getline(old_, text))
      old_line_ = text;
    else
      old_line_.reset();
  }
  [[noreturn]] void fail() const { throw WriteError("cannot write " + file_.string() + ": " + std::strerror(errno)); }
  [[noreturn]] void refuse() const {
    throw OutputDirectoryError(
        file_.string() +
        ": is there already and holds other lines than these samples; give another --out, or remove it");
  }

  std::filesystem::path file_;
  std::string temporary_;
  std::FILE* stream_ = nullptr;
  std::ifstream old_;
  std::optional<std::string> old_line_;
  bool there_ = false;
};

class ExportVerb : public Verb {
 public:
  std::string name() const override { return "export"; }
  std::string file_kind() const override { return "results"; }
  std::string operand() const override { return "DIR"; }
  std::string operand_is() const override { return "the folder of a study's results"; }
  std::string out_is() const override { return "where the tables go; otherwise into DIR itself"; }
  std::string summary() const override {
    return "the samples of a study as CSV: samples.csv, or one table for each rung";
  }
  std::string example() const override {
    return "boresight montecarlo antenna/montecarlo.toml\n  boresight export results/montecarlo";
  }
  std::vector<std::string> unused_options() const override { return {"--set", "--rung", "--accuracy", "--json"}; }

  int execute(const Command& command) override {
    const std::filesystem::path folder = command.file,
                                to = command.out.empty() ? folder : std::filesystem::path(command.out);
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
      throw InputError({"command line", 0}, "DIR", "\"" + command.file + "\"", "a folder of results");
    const std::vector<std::filesystem::path> stores = stored_samples(folder);
    if (stores.empty()) throw StoreRefused(no_samples(folder));
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
      const std::string name = entry.path().filename().string();
      if (name != "samples.db" && name.starts_with("samples.") && name.ends_with(".db"))
        fmt::print(
            stderr,
            "boresight: {} holds samples of a lost rank that are left out: the next montecarlo there merges them\n",
            printable(entry.path().string()));
    }
    std::filesystem::create_directories(to, error);
    if (error) throw OutputDirectoryError("--out " + to.string() + ": cannot create the directory: " + error.message());
    if (::access(to.c_str(), W_OK | X_OK) != 0)
      throw OutputDirectoryError("--out " + to.string() + ": cannot write there: " + std::strerror(errno) +
                                 "; give another --out");

    bool damaged = false;
    for (const std::filesystem::path& file : stores) {
      const SampleStore store(file);
      const std::filesystem::path table = to / file.filename().replace_extension(".csv");
      const std::uint64_t rows = write_table(store, table);
      const bool points = file.filename().string().starts_with("points");  // of a tail that is not whole
      if (!command.quiet) tell("{}: {}\n", how_many(rows, points ? "point" : "sample"), table.string());
      if (store.damage().empty()) continue;
      fmt::print(stderr, "boresight: {}\n", printable(store.damage()));
      damaged = true;
    }
    return damaged ? kFailed : kDone;  // nobody should take these for all of them
  }

 private:
  static std::uint64_t write_table(const SampleStore& store, const std::filesystem::path& file) {
    TableFile table(file);
    std::string header = "sample";
    for (const std::string& path : store.parameters()) header += "," + csv_field(path);
    table.line(header + ",value,status");
    std::uint64_t rows = 0;
    store.read(~std::uint64_t{0} >> 1, [&](const SampleRecord& record) {
      std::string row = std::to_string(record.number);
      for (const double input : record.inputs) row += "," + exact(input);
      row += "," + exact(record.outcome.value) + "," + to_string(record.outcome.status);
      table.line(row);
      ++rows;
    });
    table.finish();
    return rows;
  }

  // What is missing, and why where the folder's own summary says so.
  static std::string no_samples(const std::filesystem::path& folder) {
    std::ifstream in(folder / "summary.json");
    const nlohmann::json summary = nlohmann::json::parse(in, nullptr, false);
    if (summary.is_object() && summary.contains("tail"))
      return folder.string() +
             " holds no samples: the points of a tail are drawn where the search looked, not as the parameters "
             "scatter, and are dropped once it is known; levels.csv has what was found";
    return "found no " + (folder / "samples.db").string() +
           ", expected a store of samples, or one for each rung of a study on several";
  }
};

}  // namespace

std::unique_ptr<Verb> make_export_verb() { return std::make_unique<ExportVerb>(); }

}  // namespace boresight::app
