#include "boresight_analyses/montecarlo/sample_store.hpp"

#include <sqlite3.h>

#include <cmath>
#include <cstring>
#include <span>

namespace boresight {
namespace {

std::string quoted(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

[[noreturn]] void fail(sqlite3* db, const std::filesystem::path& file, int code) {
  const std::string said = db != nullptr ? sqlite3_errmsg(db) : sqlite3_errstr(code);
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw StoreRefused(file.string() + " is in use by another run; wait for it to end, or give another --out");
    case SQLITE_NOTADB:
      throw StoreRefused(file.string() + " is no store of samples (" + said + ")");
    case SQLITE_FULL:
    case SQLITE_IOERR:
      throw StoreFailed("cannot write " + file.string() + ": " + said +
                        "; what was stored before is intact: free space and go on with --resume");
    default:
      throw StoreFailed("cannot use " + file.string() + ": " + said);
  }
}

class Statement {
 public:
  Statement(sqlite3* db, const std::filesystem::path& file, const std::string& sql) : db_(db), file_(file) {
    const int code = sqlite3_prepare_v2(db, sql.c_str(), -1, &statement_, nullptr);
    if (code != SQLITE_OK) fail(db, file, code);
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  void bind(int place, std::int64_t value) { check(sqlite3_bind_int64(statement_, place, value)); }
  void bind(int place, double value) {
    check(std::isnan(value) ? sqlite3_bind_null(statement_, place) : sqlite3_bind_double(statement_, place, value));
  }
  void bind(int place, const std::string& text) {
    check(sqlite3_bind_text(statement_, place, text.c_str(), static_cast<int>(text.size()), SQLITE_TRANSIENT));
  }
  void bind(int place, std::span<const double> doubles) {
    check(sqlite3_bind_blob64(statement_, place, doubles.data(), doubles.size_bytes(), SQLITE_TRANSIENT));
  }
  // True: a row is there.
  bool step() {
    const int code = sqlite3_step(statement_);
    if (code == SQLITE_ROW) return true;
    if (code != SQLITE_DONE) {
      sqlite3_reset(statement_);
      fail(db_, file_, code);
    }
    return false;
  }
  void reset() { sqlite3_reset(statement_); }
  std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
  double real(int column) const {
    return sqlite3_column_type(statement_, column) == SQLITE_NULL ? std::numeric_limits<double>::quiet_NaN()
                                                                  : sqlite3_column_double(statement_, column);
  }
  std::vector<double> doubles(int column) const {
    std::vector<double> out(static_cast<std::size_t>(sqlite3_column_bytes(statement_, column)) / sizeof(double));
    if (!out.empty()) std::memcpy(out.data(), sqlite3_column_blob(statement_, column), out.size() * sizeof(double));
    return out;
  }
  std::string text(int column) const {
    const unsigned char* found = sqlite3_column_text(statement_, column);
    return found != nullptr ? reinterpret_cast<const char*>(found) : "";
  }

 private:
  void check(int code) const {
    if (code != SQLITE_OK) fail(db_, file_, code);
  }
  sqlite3* db_;
  const std::filesystem::path& file_;
  sqlite3_stmt* statement_ = nullptr;
};

}  // namespace

struct SampleStore::Database {
  sqlite3* handle = nullptr;
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
  open();
  Statement there(db_->handle, file_, "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'sample'");
  if (there.step() && there.integer(0) == 0) {
    there.reset();
    make_tables(facts);
    return;
  }
  there.reset();
  for (const auto& [key, value] : facts)
    if (fact(key) != value)
      throw StoreRefused(file_.string() + " holds the samples of another study (its " + key +
                         " differs); give another --out, or remove it");
  read_layout();
}

SampleStore::SampleStore(const std::filesystem::path& file) : file_(file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error))
    throw StoreRefused("found no " + file.string() + ", expected a store of samples");
  open();
  Statement there(db_->handle, file_, "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'sample'");
  if (!there.step() || there.integer(0) == 0) throw StoreRefused(file.string() + " is no store of samples");
  there.reset();
  read_layout();
}

SampleStore::~SampleStore() {
  try {
    commit();
  } catch (const std::exception&) {
    // What could not be written is lost; it was reported when it failed first, and will be computed again.
  }
}

void SampleStore::open() {
  db_ = std::make_unique<Database>();
  const int code = sqlite3_open_v2(file_.c_str(), &db_->handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  if (code != SQLITE_OK) fail(db_->handle, file_, code);
  // One process at a time: so the log needs no shared memory and works on network file systems too.
  for (const char* pragma :
       {"PRAGMA locking_mode = EXCLUSIVE", "PRAGMA journal_mode = WAL", "PRAGMA synchronous = NORMAL"})
    db_->execute(file_, pragma);
}

void SampleStore::make_tables(const std::map<std::string, std::string>& facts) {
  std::string columns;
  for (const std::string& name : parameters_) columns += quoted(name) + " REAL, ";
  db_->execute(file_,
               "BEGIN; CREATE TABLE study(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
               "CREATE TABLE rung(id INTEGER PRIMARY KEY, name TEXT NOT NULL, step REAL NOT NULL);"
               "CREATE TABLE parameter(place INTEGER PRIMARY KEY, path TEXT NOT NULL);"
               "CREATE TABLE sample(number INTEGER PRIMARY KEY, status INTEGER NOT NULL, value REAL, " +
                   columns +
                   "cpu_seconds REAL, model_error REAL, discretisation_error REAL, rung INTEGER, message TEXT);");
  for (const auto& [key, value] : facts) {
    Statement put(db_->handle, file_, "INSERT INTO study VALUES (?, ?)");
    put.bind(1, key);
    put.bind(2, value);
    put.step();
  }
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    Statement put(db_->handle, file_, "INSERT INTO parameter VALUES (?, ?)");
    put.bind(1, static_cast<std::int64_t>(k));
    put.bind(2, parameters_[k]);
    put.step();
  }
  db_->execute(file_, "COMMIT");
}

void SampleStore::read_layout() {
  parameters_.clear();
  Statement paths(db_->handle, file_, "SELECT path FROM parameter ORDER BY place");
  while (paths.step()) parameters_.push_back(paths.text(0));
}

std::string SampleStore::fact(const std::string& key) const {
  Statement get(db_->handle, file_, "SELECT value FROM study WHERE key = ?");
  get.bind(1, key);
  return get.step() ? get.text(0) : "";
}

void SampleStore::note(const std::string& key, const std::string& value) {
  commit();
  Statement put(db_->handle, file_, "INSERT OR REPLACE INTO study VALUES (?, ?)");
  put.bind(1, key);
  put.bind(2, value);
  put.step();
}

void SampleStore::use_rung(const std::string& name, double step) {
  commit();
  const std::vector<StoredRung> known = rungs();
  for (std::size_t k = 0; k < known.size(); ++k)
    if (known[k].name == name && known[k].step == step) {
      rung_ = static_cast<int>(k) + 1;
      return;
    }
  Statement put(db_->handle, file_, "INSERT INTO rung(name, step) VALUES (?, ?)");
  put.bind(1, name);
  put.bind(2, step);
  put.step();
  rung_ = static_cast<int>(known.size()) + 1;
}

std::vector<SampleStore::StoredRung> SampleStore::rungs() const {
  std::vector<StoredRung> found;
  Statement get(db_->handle, file_, "SELECT name, step FROM rung ORDER BY id");
  while (get.step()) found.push_back({get.text(0), get.real(1)});
  return found;
}

void SampleStore::add(const SampleRecord& record) {
  if (!db_->in_transaction) {
    db_->execute(file_, "BEGIN");
    db_->in_transaction = true;
  }
  if (!db_->insert) {
    std::string places = "?, ?, ?, ?, ?, ?, ?, ?";
    for (std::size_t k = 0; k < parameters_.size(); ++k) places += ", ?";
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
  put.step();
  put.reset();
  if (!record.outcome.history.empty()) add_history(record.number, record.outcome.history);
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
  db_->execute(file_, "COMMIT");
  db_->in_transaction = false;
}

void SampleStore::merge(const std::filesystem::path& other) {
  commit();
  {
    const SampleStore opened(other);  // replays its log, and refuses what is no store
    if (opened.fact("study") != fact("study") || opened.parameters() != parameters_)
      throw StoreRefused(other.string() + " holds the samples of another study; remove it, or give another --out");
  }
  {
    Statement attach(db_->handle, file_, "ATTACH ? AS other");
    attach.bind(1, other.string());
    attach.step();
  }
  db_->execute(file_, "BEGIN; INSERT OR IGNORE INTO sample SELECT * FROM other.sample; COMMIT");
  db_->execute(file_, "DETACH other");
}

std::uint64_t SampleStore::count() const {
  Statement get(db_->handle, file_, "SELECT count(*) FROM sample");
  get.step();
  return static_cast<std::uint64_t>(get.integer(0));
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
  Statement get(db_->handle, file_, "SELECT * FROM sample WHERE number < ? ORDER BY number");
  get.bind(1, static_cast<std::int64_t>(end));
  SampleRecord record;
  record.inputs.resize(parameters_.size());
  while (get.step()) {
    int column = 0;
    record.number = static_cast<std::uint64_t>(get.integer(column++));
    record.outcome.status = static_cast<Outcome::Status>(get.integer(column++));
    record.outcome.value = get.real(column++);
    for (double& input : record.inputs) input = get.real(column++);
    record.outcome.cpu_seconds = get.real(column++);
    record.outcome.model_error = get.real(column++);
    record.outcome.discretisation_error = get.real(column++);
    ++column;
    record.outcome.message = get.text(column);
    each(record);
  }
}

}  // namespace boresight
