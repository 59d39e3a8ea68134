#include "boresight_analyses/runs/whole_rows.hpp"

#include <algorithm>
#include <future>
#include <optional>

#include "boresight_analyses/runs/row_checksum.hpp"
#include "boresight_analyses/runs/sqlite_statement.hpp"
#include "boresight_analyses/runs/stored_header.hpp"

namespace boresight {
namespace {

// Rows that were read and not yet told. While the checksums of one lot are computed by another thread, the next is read; the store
// is used, and the rows are told, by the caller's thread only.
class Lots {
 public:
  Lots(const std::function<void(SampleRecord&, int)>& each, std::size_t parameters)
      : each_(each), parameters_(parameters) {}

  struct Row {
    SampleRecord record;
    int rung = 0;
    std::int64_t status = 0;
    std::optional<std::int64_t> checksum;
    bool whole = false;
  };

  // Where the next row goes.
  Row& place() {
    if (used_ == rows_.size()) rows_.emplace_back().record.inputs.resize(parameters_);
    return rows_[used_];
  }
  // The row in its place is one.
  void keep() {
    doubles_ += parameters_ + rows_[used_].record.outcome.history.size();
    ++used_;
    if (used_ == kMostRows || doubles_ > kMostDoubles) hand_over();
  }
  RowsRead finish() {
    tell_checked();
    check(rows_, used_);
    tell(rows_, used_);
    used_ = doubles_ = 0;
    return read_;
  }

 private:
  // A lot that costs many times what the thread does, and a few megabytes of histories.
  static constexpr std::size_t kMostRows = 512, kMostDoubles = std::size_t{1} << 20;

  void hand_over() {
    tell_checked();
    rows_.swap(lot_);
    lot_size_ = used_;
    checking_ = std::async(std::launch::async, [this] { check(lot_, lot_size_); });
    used_ = doubles_ = 0;
  }
  void tell_checked() {
    if (!checking_.valid()) return;
    checking_.get();
    tell(lot_, lot_size_);
  }
  static void check(std::vector<Row>& rows, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
      Row& row = rows[k];
      row.whole = (row.status == 0 || row.status == 1) &&
                  (!row.checksum || checksum_of(row.record, row.rung, row.record.outcome.history) == *row.checksum);
    }
  }
  void tell(std::vector<Row>& rows, std::size_t n) {
    for (std::size_t k = 0; k < n; ++k) {
      ++(rows[k].whole ? read_.whole : read_.damaged);
      if (rows[k].whole) each_(rows[k].record, rows[k].rung);
    }
  }

  const std::function<void(SampleRecord&, int)>& each_;
  const std::size_t parameters_;
  std::vector<Row> rows_, lot_;
  std::size_t used_ = 0, doubles_ = 0, lot_size_ = 0;
  RowsRead read_;
  std::future<void> checking_;  // last: waited for before the rest goes
};

class Rows {
 public:
  Rows(sqlite3* db, const std::filesystem::path& file, std::size_t parameters,
       const std::function<void(SampleRecord&, int)>& each)
      : lots_(each, parameters),
        get_(db, file, "SELECT * FROM sample WHERE number >= ? AND number < ? ORDER BY number") {
    checksum_ = static_cast<int>(parameters) + 8;
    has_checksums_ = sqlite3_column_count(get_.handle()) > checksum_;
    try {
      if (has_table(db, file, "history")) history_.emplace(db, file, "SELECT doubles FROM history WHERE number = ?");
    } catch (const StoreDamaged&) {
      pages_damaged = true;
    }
  }

  // Throws StoreDamaged, StoreFailed where a page cannot be read; what came before it is kept.
  void take(std::uint64_t first, std::uint64_t end) {
    get_.reset();
    get_.bind(1, static_cast<std::int64_t>(first));
    get_.bind(2, static_cast<std::int64_t>(end));
    while (get_.step()) take_row();
    get_.reset();
  }
  RowsRead finish() {
    RowsRead read = lots_.finish();
    read.pages_damaged = pages_damaged;
    return read;
  }

  std::uint64_t next = 0;  // behind the last that was taken
  bool pages_damaged = false;

 private:
  void take_row() {
    Lots::Row& row = lots_.place();
    SampleRecord& record = row.record;
    int column = 0;
    record.number = static_cast<std::uint64_t>(get_.integer(column++));
    if (record.number < next) return;
    row.status = get_.integer(column++);
    record.outcome.status = static_cast<Outcome::Status>(row.status);
    record.outcome.value = get_.real(column++);
    for (double& input : record.inputs) input = get_.real(column++);
    record.outcome.cpu_seconds = get_.real(column++);
    record.outcome.model_error = get_.real(column++);
    record.outcome.discretisation_error = get_.real(column++);
    row.rung = static_cast<int>(get_.integer(column++));
    record.outcome.message = get_.text(column++);
    record.outcome.history = history_of(record.number);
    if (has_checksums_) row.checksum = get_.integer(checksum_);
    next = record.number + 1;
    lots_.keep();
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

  Lots lots_;
  Statement get_;
  std::optional<Statement> history_;
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
    return rows->finish();
  } catch (const StoreDamaged&) {
    if (!rows) return {.whole = 0, .damaged = 0, .pages_damaged = true};
  }
  // Around what cannot be read: block by block, and where a block cannot be read, number by number.
  rows->pages_damaged = true;
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
  return rows->finish();
}

}  // namespace boresight
