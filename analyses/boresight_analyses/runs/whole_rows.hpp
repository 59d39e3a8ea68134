// The samples of a store that are what was stored, whatever else in the file is damaged.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "boresight_analyses/runs/sample_record.hpp"

namespace boresight {

struct RowsRead {
  std::uint64_t whole = 0;
  std::uint64_t damaged = 0;   // rows that are there and are not what was stored
  bool pages_damaged = false;  // rows that cannot be read, nobody knows how many
  bool good() const { return damaged == 0 && !pages_damaged; }
};

// In ascending order of number, each once, those below `end`: the sample, its rung's number, its history. `each` is called
// by the caller's thread and may use the store.
// parameters: how many columns of inputs there are. Stores of versions before have no checksums: their rows count as whole if they
// can be read. Throws StoreRefused where the store is in use.
RowsRead read_whole_rows(sqlite3* db, const std::filesystem::path& file, std::size_t parameters, std::uint64_t end,
                         const std::function<void(SampleRecord&, int rung)>& each);

}  // namespace boresight
