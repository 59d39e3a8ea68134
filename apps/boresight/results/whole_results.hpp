// The files of one result, which come into their folder all together or not at all.
//
// They are written into a hidden folder beside their places; once all are on the disk, that folder is renamed, and from then
// on the result counts as written: the files are moved to their places, summary.json last. A kill before the renaming leaves
// the old result as it was. A kill after it leaves a folder without summary.json, which the next command that opens it
// completes. So a folder with a summary.json holds the files of one result only.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace boresight::app {

// A result could not be written: exit status 3.
class WriteError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// All of these throw WriteError.

// Writes one file of a result that is still incomplete.
void stage(const std::filesystem::path& folder, const std::string& name, const std::string& content);
// What was staged is the folder's result from now on. Files that the summary.json before names and this result does not have
// are removed, stores of samples excepted. Does nothing where nothing was staged. Returns false, and leaves all as it was, where
// the new result was interrupted and the one before was not, and keeps no store that the new one goes on from.
bool publish(const std::filesystem::path& folder);
// What was staged takes its places, file by file: for files that are no result and stand each for itself.
void place_staged(const std::filesystem::path& folder);
// Completes what a kill interrupted in publish(), and removes what was staged and never published.
void recover(const std::filesystem::path& folder);
// Removes what was staged and never published; never throws.
void discard_staged(const std::filesystem::path& folder) noexcept;

// Writes one file wholly or not at all.
void write_atomically(const std::filesystem::path& file, const std::string& content);

}  // namespace boresight::app
