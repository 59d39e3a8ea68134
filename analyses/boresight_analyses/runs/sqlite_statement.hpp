// One SQL statement, and what goes wrong with it in the words of a store of samples.
#pragma once

#include <sqlite3.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "boresight_analyses/runs/sample_record.hpp"

namespace boresight {

// What was read does not fit together. Within the store it is sorted out; where it leaves it, it is a StoreRefused.
class StoreDamaged : public StoreRefused {
 public:
  using StoreRefused::StoreRefused;
};

[[noreturn]] inline void fail(sqlite3* db, const std::filesystem::path& file, int code) {
  const std::string said = db != nullptr ? sqlite3_errmsg(db) : sqlite3_errstr(code);
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw StoreRefused(file.string() + " is in use by another run; wait for it to end, or give another --out");
    case SQLITE_CORRUPT:
    case SQLITE_ERROR:  // the statements are fixed: what does not fit them is a schema that was damaged
    case SQLITE_MISMATCH:
    case SQLITE_TOOBIG:
      throw StoreDamaged(file.string() + " is damaged: " + said +
                         "; the same command keeps what is whole in it and computes the rest anew");
    case SQLITE_NOTADB:
      throw StoreDamaged(file.string() + " is no store of samples, or a damaged one (" + said + ")");
    case SQLITE_FULL:
    case SQLITE_IOERR:
      throw StoreFailed("cannot write " + file.string() + ": " + said +
                        "; what was stored before is intact: free space, and the same command goes on");
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
  sqlite3_stmt* handle() const { return statement_; }
  void reset() { sqlite3_reset(statement_); }
  std::int64_t integer(int column) const { return sqlite3_column_int64(statement_, column); }
  double real(int column) const {
    const double value = sqlite3_column_double(statement_, column);  // zero also where nothing is stored
    const bool is_nan = value == 0.0 && sqlite3_column_type(statement_, column) == SQLITE_NULL;
    return is_nan ? std::numeric_limits<double>::quiet_NaN() : value;
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

}  // namespace boresight
