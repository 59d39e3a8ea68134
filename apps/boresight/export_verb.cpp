// boresight export DIR: the samples of a Monte Carlo study as CSV.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/montecarlo/sample_store.hpp"
#include "exit_status.hpp"
#include "output_directory.hpp"
#include "tables.hpp"
#include "verb.hpp"

namespace boresight::app {
namespace {

// Written row by row under another name, synced and renamed: a table of any size, whole or not there.
class TableFile {
 public:
  explicit TableFile(std::filesystem::path file) : file_(std::move(file)), temporary_(file_.string() + ".part") {
    stream_ = std::fopen(temporary_.c_str(), "w");
    if (stream_ == nullptr) fail();
  }
  ~TableFile() {
    if (stream_ == nullptr) return;
    std::fclose(stream_);
    ::unlink(temporary_.c_str());
  }
  TableFile(const TableFile&) = delete;
  TableFile& operator=(const TableFile&) = delete;

  void line(const std::string& text) {
    if (std::fwrite(text.data(), 1, text.size(), stream_) != text.size() || std::fputc('\n', stream_) == EOF) fail();
  }
  void finish() {
    if (std::fflush(stream_) != 0 || ::fsync(::fileno(stream_)) != 0) fail();
    std::fclose(stream_);
    stream_ = nullptr;
    if (std::rename(temporary_.c_str(), file_.c_str()) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const { throw WriteError("cannot write " + file_.string() + ": " + std::strerror(errno)); }

  std::filesystem::path file_, temporary_;
  std::FILE* stream_ = nullptr;
};

class ExportVerb : public Verb {
 public:
  std::string name() const override { return "export"; }
  std::string file_kind() const override { return "results folder, not a"; }
  std::string summary() const override { return "the samples of a study as CSV: samples.csv"; }
  std::string example() const override { return "boresight export results/montecarlo"; }

  int execute(const Command& command) override {
    if (!command.settings.empty())
      throw InputError({"command line", 0}, "--set", command.settings.front().path,
                       "no settings: the samples are computed");
    const std::filesystem::path folder = command.file,
                                to = command.out.empty() ? folder : std::filesystem::path(command.out);
    if (!std::filesystem::is_directory(folder))
      throw InputError({"command line", 0}, "DIR", "\"" + command.file + "\"", "a folder of results");
    const SampleStore store(folder / "samples.db");
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name != "samples.db" && name.starts_with("samples.") && name.ends_with(".db"))
        fmt::print(stderr,
                   "boresight: {} holds samples of a lost rank that are left out: montecarlo --resume merges them\n",
                   entry.path().string());
    }
    std::error_code error;
    std::filesystem::create_directories(to, error);

    TableFile table(to / "samples.csv");
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
    if (!command.quiet) fmt::print("{} samples: {}\n", rows, (to / "samples.csv").string());
    return kDone;
  }
};

}  // namespace

std::unique_ptr<Verb> make_export_verb() { return std::make_unique<ExportVerb>(); }

}  // namespace boresight::app
