// The directory of one study's results: whose it is, who writes in it now, and results that are whole or not there.
//
// A directory belongs to the study whose identity its summary.json carries (verb, hashes, settings, options). The same study
// may be run again in it; another study's results are never overwritten, and while one process writes in it no other does.
// What is written is set aside and takes its places all at once with publish(), so that a full disk or a kill leaves the
// old results or the new ones.
//
//   OutputDirectory out = OutputDirectory::open(options.out, "run", "3-rrcpr.toml", identity);
//   out.write("summary.json", [&](std::ostream& s) { s << summary.dump(2) << '\n'; });
//   out.publish();
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "results/folder_claim.hpp"
#include "results/whole_results.hpp"

namespace boresight::app {

// The directory that was asked for cannot be used: exit status 2.
class OutputDirectoryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class OutputDirectory {
 public:
  // `asked`: the --out of the user; "" means ./results/FILESTEM-VERB, or the same with -2, -3, ... where that
  // holds another study's results or is being written in. `identity` is compared with the "identity" of a summary.json
  // found there. Creates the directory, and claims it until the end. Throws OutputDirectoryError.
  static OutputDirectory open(const std::string& asked, const std::string& verb, const std::string& file,
                              nlohmann::json identity);
  // name: of the folder in ./results, in place of FILESTEM-VERB, where it is not empty.
  static OutputDirectory open(const std::string& asked, const std::string& verb, const std::string& file,
                              const std::string& name, nlohmann::json identity);

  OutputDirectory(OutputDirectory&& other) noexcept;
  OutputDirectory& operator=(OutputDirectory&&) = delete;
  // What was not published is gone, and so is the directory where it was made here and nothing came into it.
  ~OutputDirectory();

  const std::filesystem::path& path() const { return path_; }
  const nlohmann::json& identity() const { return identity_; }

  // Sets one file of the result aside. Throws WriteError, naming the file and what the system said.
  void write(const std::string& name, const std::function<void(std::ostream&)>& content) const;
  // Everything written since the last time takes its place; but what was interrupted does not replace what was whole, which is then
  // said on standard error. Throws WriteError.
  void publish() const;

 private:
  OutputDirectory(std::filesystem::path path, nlohmann::json identity, std::optional<FolderClaim> claim,
                  std::vector<std::filesystem::path> made);

  std::filesystem::path path_;
  nlohmann::json identity_;
  std::optional<FolderClaim> claim_;
  std::vector<std::filesystem::path> made_;  // by this one, outermost first
};

}  // namespace boresight::app
