#include "boresight_analyses/runs/whole_rows.hpp"

#include <algorithm>
#include <optional>

#include "boresight_analyses/runs/row_checksum.hpp"
#include "boresight_analyses/runs/sqlite_statement.hpp"
#include "boresight_analyses/runs/stored_header.hpp"

namespace boresight {
namespace {

class Rows {
 public:
  Rows(sqlite3* db, const std::filesystem::path& file, std::size_t parameters,
       const std::function<void(SampleRecord&, int)>& each)
      : each_(each), get_(db, file, "SELECT * FROM sample WHERE number >= ? AND number < ? ORDER BY number") {
    record_.inputs.resize(parameters);
    checksum_ = static_cast<int>(parameters) + 8;
    has_checksums_ = sqlite3_column_count(get_.handle()) > checksum_;
    try {
      if (has_table(db, file, "history")) history_.emplace(db, file, "SELECT doubles FROM history WHERE number = ?");
    } catch (const StoreDamaged&) {
      read.pages_damaged = true;
    }
  }

  // Throws StoreDamaged, StoreFailed where a page cannot be read; what came before it has been told.
  void take(std::uint64_t first, std::uint64_t end) {
    get_.reset();
    get_.bind(1, static_cast<std::int64_t>(first));
    get_.bind(2, static_cast<std::int64_t>(end));
    while (get_.step()) take_row();
    get_.reset();
  }

  std::uint64_t next = 0;  // behind the last that was told
  RowsRead read;

 private:
  void take_row() {
    int column = 0;
    record_.number = static_cast<std::uint64_t>(get_.integer(column++));
    if (record_.number < next) return;
    const std::int64_t status = get_.integer(column++);
    record_.outcome.status = static_cast<Outcome::Status>(status);
    record_.outcome.value = get_.real(column++);
    for (double& input : record_.inputs) input = get_.real(column++);
    record_.outcome.cpu_seconds = get_.real(column++);
    record_.outcome.model_error = get_.real(column++);
    record_.outcome.discretisation_error = get_.real(column++);
    const int rung = static_cast<int>(get_.integer(column++));
    record_.outcome.message = get_.text(column++);
    record_.outcome.history = history_of(record_.number);
    const bool whole =
        (status == 0 || status == 1) &&
        (!has_checksums_ || checksum_of(record_, rung, record_.outcome.history) == get_.integer(checksum_));
    next = record_.number + 1;
    if (!whole) {
      ++read.damaged;
      return;
    }
    ++read.whole;
    each_(record_, rung);
  }

  std::vector<double> history_of(std::uint64_t number) {
    if (!history_) return {};
    history_->reset();
    history_->bind(1, static_cast<std::int64_t>(number));
    try {
      return history_->step() ? history_->doubles(0) : std::vector<double>{};
    } catch (const StoreDamaged&) {
      return {};  // its sample's checksum then fails
    }
  }

  const std::function<void(SampleRecord&, int)>& each_;
  Statement get_;
  std::optional<Statement> history_;
  SampleRecord record_;
  int checksum_ = 0;
  bool has_checksums_ = false;
};

// Behind the last number that there may be.
std::uint64_t last_number(sqlite3* db, const std::filesystem::path& file, std::uint64_t from, std::uint64_t end) {
  // Where even that cannot be read: many more than there is room for in the file.
  constexpr std::uint64_t kBytesOfARow = 8;
  std::error_code error;
  const std::uint64_t size = std::filesystem::file_size(file, error), guess = error ? 0 : size / kBytesOfARow;
  try {
    Statement get(db, file, "SELECT max(number) FROM sample");
    if (get.step())
      return std::min(end, std::max(from, static_cast<std::uint64_t>(std::max<std::int64_t>(0, get.integer(0))) + 1));
  } catch (const StoreDamaged&) {
  }
  return std::min(end, from + guess);
}

}  // namespace

RowsRead read_whole_rows(sqlite3* db, const std::filesystem::path& file, std::size_t parameters, std::uint64_t end,
                         const std::function<void(SampleRecord&, int)>& each) {
  constexpr std::uint64_t kBlock = 64;
  std::optional<Rows> rows;
  try {
    rows.emplace(db, file, parameters, each);
    rows->take(0, end);
    return rows->read;
  } catch (const StoreDamaged&) {
    if (!rows) return {.whole = 0, .damaged = 0, .pages_damaged = true};
  }
  // Around what cannot be read: block by block, and where a block cannot be read, number by number.
  rows->read.pages_damaged = true;
  const std::uint64_t last = std::min(last_number(db, file, rows->next, end), rows->next + (1u << 26));
  for (std::uint64_t first = rows->next; first < last; first += kBlock) {
    const std::uint64_t stop = std::min(last, first + kBlock);
    try {
      rows->take(first, stop);
    } catch (const StoreDamaged&) {
      for (std::uint64_t number = std::max(first, rows->next); number < stop; ++number) {
        try {
          rows->take(number, number + 1);
        } catch (const StoreDamaged&) {
        }
      }
    }
  }
  return rows->read;
}

}  // namespace boresight
