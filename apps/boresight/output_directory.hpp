// The directory of one study's results: whose it is, and files that are whole or not there.
//
// A directory belongs to the study whose identity its summary.json carries (verb, hashes, settings, options).
// The same study may be run again in it; another study's results are never overwritten. Every file is written
// to a temporary name beside its own, synced to the disk and renamed, so that a full disk or a kill leaves
// the old file or the new one.
//
//   OutputDirectory out = OutputDirectory::open(options.out, "run", "3-rrcpr.toml", identity);
//   out.write("summary.json", [&](std::ostream& s) { s << summary.dump(2) << '\n'; });
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace boresight::app {

// The directory that was asked for cannot be used: exit status 2.
class OutputDirectoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A result could not be written: exit status 3.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class OutputDirectory {
 public:
  // `asked`: the --out of the user; "" means ./results/FILESTEM-VERB, or the same with -2, -3, ... where that
  // holds another study's results. `identity` is compared with the "identity" of a summary.json found there.
  // Creates the directory. Throws OutputDirectoryError.
  static OutputDirectory open(const std::string& asked, const std::string& verb, const std::string& file,
                              nlohmann::json identity);

  const std::filesystem::path& path() const { return path_; }
  const nlohmann::json& identity() const { return identity_; }

  // Throws WriteError, naming the file and what the system said; the file then is as it was before.
  void write(const std::string& name, const std::function<void(std::ostream&)>& content) const;

 private:
  OutputDirectory(std::filesystem::path path, nlohmann::json identity);

  std::filesystem::path path_;
  nlohmann::json identity_;
};

// Writes one file wholly or not at all. Throws WriteError.
void write_atomically(const std::filesystem::path& file, const std::string& content);

}  // namespace boresight::app
