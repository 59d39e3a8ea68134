#include "boresight_analyses/runs/sample_store.hpp"

#include <time.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "boresight_analyses/runs/row_checksum.hpp"
#include "boresight_analyses/runs/sqlite_statement.hpp"
#include "boresight_analyses/runs/store_salvage.hpp"
#include "boresight_analyses/runs/stored_header.hpp"
#include "boresight_analyses/runs/whole_rows.hpp"

namespace boresight {
namespace {

// A folder of our own for a copy, removed with everything in it.
class CopyOf {
 public:
  explicit CopyOf(const std::filesystem::path& file) {
    std::string name = (std::filesystem::temp_directory_path() / "boresight-store-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw StoreFailed("cannot make a folder for a copy of " + file.string());
    folder_ = name;
    std::error_code error;
    for (const char* suffix : {"", "-wal"}) {
      std::filesystem::copy_file(file.string() + suffix, path().string() + suffix, error);
      if (error)
        throw StoreFailed("cannot copy " + file.string() + suffix + " to " + folder_.string() + ": " + error.message());
      std::filesystem::permissions(path().string() + suffix, std::filesystem::perms::owner_write,
                                   std::filesystem::perm_options::add, error);
    }
  }
  ~CopyOf() {
    std::error_code error;
    std::filesystem::remove_all(folder_, error);
  }
  CopyOf(const CopyOf&) = delete;
  CopyOf& operator=(const CopyOf&) = delete;
  std::filesystem::path path() const { return folder_ / "samples.db"; }

 private:
  std::filesystem::path folder_;
};

bool can_write(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  return ::access(file.c_str(), W_OK) == 0 && ::access(folder.c_str(), W_OK | X_OK) == 0;
}

bool has_no_tables(const std::filesystem::path& file) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READWRITE, nullptr);
  const std::unique_ptr<sqlite3, decltype(&sqlite3_close)> handle(opened, &sqlite3_close);
  if (code != SQLITE_OK) fail(opened, file, code);
  Statement get(opened, file, "SELECT count(*) FROM sqlite_master");
  return get.step() && get.integer(0) == 0;
}

}  // namespace

double SampleStore::process_cpu_seconds() {
  timespec time = {};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

struct SampleStore::Database {
  sqlite3* handle = nullptr;
  std::unique_ptr<CopyOf> copy;  // that is open instead, where the file's folder cannot be written
  std::unique_ptr<Statement> insert, insert_history;
  bool in_transaction = false;

  ~Database() {
    insert.reset();
    insert_history.reset();
    sqlite3_close(handle);
  }
  void execute(const std::filesystem::path& file, const std::string& sql) const {
    const int code = sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr);
    if (code != SQLITE_OK) fail(handle, file, code);
  }
};

SampleStore::SampleStore(const std::filesystem::path& file, const std::map<std::string, std::string>& facts,
                         const std::vector<std::string>& parameters)
    : file_(file), parameters_(parameters) {
  std::error_code error;
  std::string fault;
  if (std::filesystem::exists(file_, error) && std::filesystem::file_size(file_, error) > 0) {
    try {
      open();
      fault = damage_of(db_->handle, file_);
    } catch (const StoreDamaged&) {
      fault = "its first page is not what was stored";
    }
  }
  if (!fault.empty()) {
    db_.reset();
    damage_ = salvage_store(file_, fault, facts, parameters_);
  }
  if (!db_) open();
  if (!has_table(db_->handle, file_, "sample"))
    make_store_tables(db_->handle, file_, {.facts = facts, .rungs = {}, .parameters = parameters_});
  require(facts);
  read_layout();
  if (!damage_.empty()) note("damage", damage_);
  count();  // while it is small
}

SampleStore::SampleStore(const std::filesystem::path& file) : file_(file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw StoreRefused("found no " + file.string() + ", expected a store of samples");
  part_ = -1;
  open_to_read();
  if (!has_table(db_->handle, file_, "sample")) throw StoreRefused(file.string() + " is no store of samples");
  read_layout();
}

SampleStore::~SampleStore() {
  try {
    commit();
    if (db_ && part_ > 0) put_cost();  // what came after the last sample
  } catch (const std::exception&) {
    // What could not be written is lost; it was reported when it failed first, and will be computed again.
  }
}

void SampleStore::open() {
  db_ = std::make_unique<Database>();
  // One thread at a time is in it, by its owner's lock: no need of SQLite's own at every column.
  const int code = sqlite3_open_v2(file_.c_str(), &db_->handle,
                                   SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
  if (code != SQLITE_OK) fail(db_->handle, file_, code);
  // One process at a time: so the log needs no shared memory and works on network file systems too.
  for (const char* pragma :
       {"PRAGMA locking_mode = EXCLUSIVE", "PRAGMA journal_mode = WAL", "PRAGMA synchronous = NORMAL"})
    db_->execute(file_, pragma);
}

// Where nothing can be written the log cannot be replayed in its place: the store is read as it is, or, with a log, from a copy.
void SampleStore::open_to_read() {
  if (can_write(file_)) return open();
  std::error_code error;
  const std::string log = file_.string() + "-wal";
  db_ = std::make_unique<Database>();
  int code = SQLITE_OK;
  if (std::filesystem::exists(log, error) && std::filesystem::file_size(log, error) > 0) {
    db_->copy = std::make_unique<CopyOf>(file_);
    code = sqlite3_open_v2(db_->copy->path().c_str(), &db_->handle, SQLITE_OPEN_READWRITE, nullptr);
  } else {
    std::string uri = "file:";
    for (const char c : std::filesystem::absolute(file_).string()) {
      constexpr const char* kHex = "0123456789ABCDEF";
      const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' ||
                         c == '.' || c == '-' || c == '_';
      if (plain)
        uri += c;
      else
        uri += {'%', kHex[static_cast<unsigned char>(c) >> 4], kHex[static_cast<unsigned char>(c) & 15]};
    }
    code =
        sqlite3_open_v2((uri + "?immutable=1").c_str(), &db_->handle, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI, nullptr);
  }
  if (code != SQLITE_OK) fail(db_->handle, file_, code);
}

void SampleStore::read_layout() {
  parameters_ = header_of_tables(db_->handle, file_).parameters;
  Statement columns(db_->handle, file_, "SELECT count(*) FROM pragma_table_info('sample') WHERE name = 'checksum'");
  has_checksums_ = columns.step() && columns.integer(0) > 0;
  has_parts_ = has_table(db_->handle, file_, "part");
  if (!has_parts_) return;
  Statement spent(db_->handle, file_, "SELECT total(cpu_seconds), total(wall_seconds) FROM part");
  if (spent.step()) earlier_ = {spent.real(0), spent.real(1)};
}

std::string SampleStore::fact(const std::string& key) const {
  Statement get(db_->handle, file_, "SELECT value FROM study WHERE key = ?");
  get.bind(1, key);
  return get.step() ? get.text(0) : "";
}

std::string SampleStore::another_than(const std::map<std::string, std::string>& facts) const {
  std::map<std::string, std::string> found;
  for (const auto& [key, value] : facts) found[key] = fact(key);
  return boresight::another_than(facts, found);
}

void SampleStore::require(const std::map<std::string, std::string>& facts) const {
  if (const std::string another = another_than(facts); !another.empty())
    throw StoreRefused(file_.string() + " holds " + another + "; give another --out, or remove it");
}

// What the tables say and the text that has the same once more change together.
void SampleStore::change_header(const std::function<void()>& change) {
  commit();
  begin();
  try {
    change();
    renew_header_text(db_->handle, file_);
  } catch (...) {
    sqlite3_exec(db_->handle, "ROLLBACK", nullptr, nullptr, nullptr);
    db_->in_transaction = false;
    throw;
  }
  commit();
}

void SampleStore::note(const std::map<std::string, std::string>& notes) {
  change_header([&] {
    for (const auto& [key, value] : notes) {
      Statement put(db_->handle, file_, "INSERT OR REPLACE INTO study VALUES (?, ?)");
      put.bind(1, key);
      put.bind(2, value);
      put.step();
    }
  });
}

void SampleStore::use_rung(const std::string& name, double step) {
  commit();
  const std::vector<StoredRung> known = rungs();
  for (std::size_t k = 0; k < known.size(); ++k)
    if (known[k].name == name && known[k].step == step) {
      rung_ = static_cast<int>(k) + 1;
      return;
    }
  change_header([&] {
    Statement put(db_->handle, file_, "INSERT INTO rung(name, step) VALUES (?, ?)");
    put.bind(1, name);
    put.bind(2, step);
    put.step();
  });
  rung_ = static_cast<int>(known.size()) + 1;
}

std::vector<SampleStore::StoredRung> SampleStore::rungs() const {
  std::vector<StoredRung> found;
  Statement get(db_->handle, file_, "SELECT name, step FROM rung ORDER BY id");
  while (get.step()) found.push_back({get.text(0), get.real(1)});
  return found;
}

void SampleStore::begin() {
  if (db_->in_transaction) return;
  db_->execute(file_, "BEGIN");
  db_->in_transaction = true;
}

void SampleStore::remove(std::uint64_t number) {
  begin();
  for (const char* table : {"sample", "history"}) {
    if (!has_table(db_->handle, file_, table)) continue;
    Statement drop(db_->handle, file_, std::string("DELETE FROM ") + table + " WHERE number = ?");
    drop.bind(1, static_cast<std::int64_t>(number));
    drop.step();
    if (count_ && table == std::string("sample")) *count_ -= static_cast<std::uint64_t>(sqlite3_changes(db_->handle));
  }
}

void SampleStore::add(const SampleRecord& record) {
  begin();
  if (!db_->insert) {
    std::string places = "?, ?, ?, ?, ?, ?, ?, ?";
    for (std::size_t k = 0; k < parameters_.size() + (has_checksums_ ? 1 : 0); ++k) places += ", ?";
    db_->insert =
        std::make_unique<Statement>(db_->handle, file_, "INSERT OR IGNORE INTO sample VALUES (" + places + ")");
  }
  Statement& put = *db_->insert;
  put.reset();
  int place = 0;
  put.bind(++place, static_cast<std::int64_t>(record.number));
  put.bind(++place, static_cast<std::int64_t>(record.outcome.status));
  put.bind(++place, record.outcome.value);
  for (const double input : record.inputs) put.bind(++place, input);
  put.bind(++place, record.outcome.cpu_seconds);
  put.bind(++place, record.outcome.model_error);
  put.bind(++place, record.outcome.discretisation_error);
  put.bind(++place, static_cast<std::int64_t>(rung_));
  put.bind(++place, record.outcome.message);
  if (has_checksums_) put.bind(++place, checksum_of(record, rung_, record.outcome.history));
  put.step();
  const bool added = sqlite3_changes(db_->handle) > 0;  // and not there before
  put.reset();
  if (count_ && added) ++*count_;
  if (added && !record.outcome.history.empty()) add_history(record.number, record.outcome.history);
}

void SampleStore::add_history(std::uint64_t number, std::span<const double> doubles) {
  if (!db_->insert_history) {
    db_->execute(file_, "CREATE TABLE IF NOT EXISTS history(number INTEGER PRIMARY KEY, doubles BLOB NOT NULL)");
    db_->insert_history =
        std::make_unique<Statement>(db_->handle, file_, "INSERT OR IGNORE INTO history VALUES (?, ?)");
  }
  Statement& put = *db_->insert_history;
  put.reset();
  put.bind(1, static_cast<std::int64_t>(number));
  put.bind(2, doubles);
  put.step();
  put.reset();
}

std::vector<double> SampleStore::history(std::uint64_t number) const {
  Statement there(db_->handle, file_, "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'history'");
  if (!there.step() || there.integer(0) == 0) return {};
  Statement get(db_->handle, file_, "SELECT doubles FROM history WHERE number = ?");
  get.bind(1, static_cast<std::int64_t>(number));
  return get.step() ? get.doubles(0) : std::vector<double>{};
}

void SampleStore::commit() {
  if (!db_ || !db_->in_transaction) return;
  put_cost();
  db_->execute(file_, "COMMIT");
  db_->in_transaction = false;
}

// With every commit, so that a kill forgets no more of it than of the samples.
void SampleStore::put_cost() {
  if (!has_parts_ || part_ < 0) return;
  if (part_ == 0) {
    Statement last(db_->handle, file_, "SELECT coalesce(max(id), 0) FROM part");
    last.step();
    part_ = last.integer(0) + 1;
  }
  Statement put(db_->handle, file_, "INSERT OR REPLACE INTO part VALUES (?, ?, ?)");
  put.bind(1, part_);
  put.bind(2, process_cpu_seconds() - opened_cpu_);
  put.bind(3, std::chrono::duration<double>(std::chrono::steady_clock::now() - opened_).count());
  put.step();
}

std::string SampleStore::damage() const { return part_ < 0 || !damage_.empty() ? damage_ : fact("damage"); }

void SampleStore::merge(const std::filesystem::path& other) {
  commit();
  if (has_no_tables(other)) return;  // its rank was killed as it began
  const SampleStore opened(other);   // replays its log, and refuses what is no store
  std::map<std::string, std::string> own_facts{{"study", fact("study")}};
  if (const std::string version = fact(kVersionFact); !version.empty()) own_facts[kVersionFact] = version;
  opened.require(own_facts);
  if (opened.parameters() != parameters_)
    throw StoreRefused(other.string() + " holds the samples of another study; remove it, or give another --out");
  const int own = rung_;
  read_whole_rows(opened.db_->handle, other, parameters_.size(), ~std::uint64_t{0} >> 1,
                  [&](SampleRecord& record, int rung) {
                    rung_ = rung;
                    record.outcome.history.clear();
                    add(record);
                  });
  rung_ = own;
  commit();
  earlier_.cpu_seconds += opened.earlier_.cpu_seconds;  // beside this process: no time of its own
  if (!has_parts_) return;
  Statement put(db_->handle, file_, "INSERT INTO part(cpu_seconds, wall_seconds) VALUES (?, 0.0)");
  put.bind(1, opened.earlier_.cpu_seconds);
  put.step();
}

std::uint64_t SampleStore::count() const {
  if (!count_) {
    Statement get(db_->handle, file_, "SELECT count(*) FROM sample");
    get.step();
    count_ = static_cast<std::uint64_t>(get.integer(0));
  }
  return *count_;
}

std::vector<NumberRange> SampleStore::missing(std::uint64_t end) const {
  std::vector<NumberRange> gaps;
  std::uint64_t next = 0;
  Statement get(db_->handle, file_, "SELECT number FROM sample WHERE number < ? ORDER BY number");
  get.bind(1, static_cast<std::int64_t>(end));
  while (get.step()) {
    const auto number = static_cast<std::uint64_t>(get.integer(0));
    if (number > next) gaps.push_back({next, number});
    next = number + 1;
  }
  if (next < end) gaps.push_back({next, end});
  return gaps;
}

void SampleStore::read(std::uint64_t end, const std::function<void(const SampleRecord&)>& each) const {
  const RowsRead read = read_whole_rows(db_->handle, file_, parameters_.size(), end, [&](SampleRecord& record, int) {
    record.outcome.history.clear();
    each(record);
  });
  if (!read.good())
    damage_ = file_.filename().string() + " is damaged: " + std::to_string(read.whole) + " samples in it are whole" +
              (read.pages_damaged ? ", others cannot be read"
                                  : ", " + std::to_string(read.damaged) + " are not what was stored") +
              "; the same command computes them anew";
}

}  // namespace boresight
