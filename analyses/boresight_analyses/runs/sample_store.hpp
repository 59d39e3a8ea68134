// The store of samples: one SQLite file, to which samples are added as they finish.
//
// A sample is in the file once it is committed (every quarter of a second or so) and stays in it: a kill -9 loses what
// was computed since, a full disk leaves what was there (write-ahead log). A number is stored once: adding it again
// changes nothing. The file belongs to one study, named by a text; another study's samples are refused. One process
// has it open at a time; ranks write a file each, which are then merged.
//
// Every sample has a checksum. Opening a store to go on with it looks through all of it: what is damaged is left out, the rest is
// kept, and damage() says so.
//
//   tables: study(key, value)    rung(id, name, step)
//           sample(number, status, value, one column per random parameter, cpu_seconds, model_error, discretisation_error,
//                  rung, message, checksum)
//           history(number, doubles)      of the samples that keep one; native byte order
//           header(id, text, checksum)    study, rung and parameter once more
//           part(id, cpu_seconds, wall_seconds)    one for each time that it was gone on with
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/runs/sample_record.hpp"

namespace boresight {

class SampleStore {
 public:
  // Opens or makes it; of a damaged one keeps what is whole. `facts` name the study; those found in a file must be equal. Throws
  // StoreRefused, StoreFailed.
  SampleStore(const std::filesystem::path& file, const std::map<std::string, std::string>& facts,
              const std::vector<std::string>& parameters);
  // Opens what is there, to read it; it may be on a disk that cannot be written. Throws StoreRefused if nothing is.
  explicit SampleStore(const std::filesystem::path& file);
  ~SampleStore();  // commits what it can, and closes
  SampleStore(const SampleStore&) = delete;
  SampleStore& operator=(const SampleStore&) = delete;

  const std::filesystem::path& file() const { return file_; }
  const std::vector<std::string>& parameters() const { return parameters_; }
  std::string fact(const std::string& key) const;  // "" if there is none
  // What it holds instead of samples with these facts, in a few words (stored_header.hpp); "": it holds those.
  std::string another_than(const std::map<std::string, std::string>& facts) const;
  // Throws StoreRefused where it holds anything else.
  void require(const std::map<std::string, std::string>& facts) const;
  // Kept beside the facts, and no part of what names the study. Several at once: all of them, or, after a kill, none.
  void note(const std::map<std::string, std::string>& notes);
  void note(const std::string& key, const std::string& value) { note({{key, value}}); }

  // The rung that samples from now on were computed with.
  void use_rung(const std::string& name, double step);
  using StoredRung = boresight::StoredRung;
  std::vector<StoredRung> rungs() const;

  void add(const SampleRecord& record);
  // One that is no longer needed, with its history; its place in the file is used again.
  void remove(std::uint64_t number);
  void commit();

  // What was damaged and what became of it, in a sentence; "" where nothing was. Of a store that is only read: what read() left out
  // so far.
  std::string damage() const;
  // What the study took before this process had the store open, and in other ranks [s].
  struct Cost {
    double cpu_seconds = 0.0, wall_seconds = 0.0;
  };
  Cost earlier() const { return earlier_; }

  // All samples of another store of the same study, without histories; its file is then closed, and removed by the
  // caller. Commits.
  void merge(const std::filesystem::path& other);

  std::uint64_t count() const;
  // Numbers below `end` that are not stored, in ascending ranges.
  std::vector<NumberRange> missing(std::uint64_t end) const;
  // In ascending order of number, those below `end`; one that is not what was stored is left out.
  void read(std::uint64_t end, const std::function<void(const SampleRecord&)>& each) const;
  // Of one sample; empty if it kept none. read() leaves them out.
  std::vector<double> history(std::uint64_t number) const;

 private:
  struct Database;
  void open();
  void open_to_read();
  void read_layout();
  void put_cost();
  void begin();  // a transaction, unless one is open
  void change_header(const std::function<void()>& change);
  void add_history(std::uint64_t number, std::span<const double> doubles);

  std::filesystem::path file_;
  std::vector<std::string> parameters_;
  std::unique_ptr<Database> db_;
  int rung_ = 0;
  bool has_checksums_ = false, has_parts_ = false;
  std::int64_t part_ = 0;  // of this process; 0: none yet; -1: the store is only read
  std::chrono::steady_clock::time_point opened_ = std::chrono::steady_clock::now();
  static double process_cpu_seconds();
  double opened_cpu_ = process_cpu_seconds();
  Cost earlier_;
  mutable std::string damage_;
  mutable std::optional<std::uint64_t> count_;  // kept up once it is known: counting reads the whole file
};

}  // namespace boresight
