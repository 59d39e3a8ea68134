// Whether a store of samples is what was stored, and what to keep of one that is not.
#pragma once

#include <sqlite3.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace boresight {

// What is wrong with an open store, in a few words; "" where all of it is what was stored, or it is empty. Reads all of it.
std::string damage_of(sqlite3* db, const std::filesystem::path& file);

// Puts a store in the place of a damaged one that has all of its samples that are whole, and keeps the damaged file beside it under
// another name. facts, parameters: of the study that it has to be of. Samples are kept only where it can be told whose they are
// and on which rung they were computed. Returns what was done, in a sentence. Nobody may have the store open. Throws StoreRefused
// where it is another study's, StoreFailed where the new one cannot be written: the damaged one is then as it was.
std::string salvage_store(const std::filesystem::path& file, const std::string& fault,
                          const std::map<std::string, std::string>& facts, const std::vector<std::string>& parameters);

}  // namespace boresight
