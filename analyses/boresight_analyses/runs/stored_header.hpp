// What a store of samples says of itself beside its samples: whose it is, which rungs they were computed on, which parameters they
// have. It stands in three tables and once more as one text with a checksum, so that either can be told from a damaged one.
#pragma once

#include <sqlite3.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "boresight_analyses/runs/sample_record.hpp"

namespace boresight {

struct StoredHeader {
  std::map<std::string, std::string> facts;
  std::vector<StoredRung> rungs;
  std::vector<std::string> parameters;

  std::string text() const;
  static std::optional<StoredHeader> from_text(const std::string& text);
  friend bool operator==(const StoredHeader& a, const StoredHeader& b) { return a.text() == b.text(); }
};

// The fact that says which version of the program computed a store's samples.
inline constexpr const char* kVersionFact = "version";
// What a store with the facts `found` holds instead of samples of `wanted`, in a few words; "" where it holds those. One that does not
// say its version is of another.
std::string another_than(const std::map<std::string, std::string>& wanted,
                         const std::map<std::string, std::string>& found);

// Makes every table of an empty store. Throws StoreFailed.
void make_store_tables(sqlite3* db, const std::filesystem::path& file, const StoredHeader& header);
// Writes the text anew, from what the tables say: in the transaction that changed them, or a store between the two looks damaged.
void renew_header_text(sqlite3* db, const std::filesystem::path& file);

// Stores of versions before have no text: theirs is what the tables say. Both throw StoreDamaged, StoreFailed.
bool has_table(sqlite3* db, const std::filesystem::path& file, const std::string& name);
StoredHeader header_of_tables(sqlite3* db, const std::filesystem::path& file);
// Nothing where the text is damaged or there is none.
std::optional<StoredHeader> header_of_text(sqlite3* db, const std::filesystem::path& file);

}  // namespace boresight
