#include "boresight_analyses/runs/stored_header.hpp"

#include <cstdio>
#include <cstdlib>

#include "boresight_analyses/runs/row_checksum.hpp"
#include "boresight_analyses/runs/sqlite_statement.hpp"

namespace boresight {
namespace {

std::string quoted(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

void execute(sqlite3* db, const std::filesystem::path& file, const std::string& sql) {
  const int code = sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(db, file, code);
}

// Texts one after the other, each behind its length: "5:study".
class Writer {
 public:
  void add(const std::string& text) { out_ += std::to_string(text.size()) + ":" + text; }
  void add(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    add(std::string(text));
  }
  const std::string& text() const { return out_; }

 private:
  std::string out_;
};

class Reader {
 public:
  explicit Reader(const std::string& text) : text_(text) {}
  std::string next() {
    const std::size_t colon = text_.find(':', at_);
    const std::size_t size =
        colon == std::string::npos ? text_.size() : std::strtoull(text_.c_str() + at_, nullptr, 10);
    if (colon == std::string::npos || size > text_.size() - colon - 1) {
      good_ = false;
      return "";
    }
    at_ = colon + 1 + size;
    return text_.substr(colon + 1, size);
  }
  std::size_t count() { return std::strtoull(next().c_str(), nullptr, 10); }
  bool good() const { return good_; }

 private:
  const std::string& text_;
  std::size_t at_ = 0;
  bool good_ = true;
};

std::int64_t checksum_of(const std::string& text) {
  Checksum sum;
  sum.add(text);
  return sum.value();
}

}  // namespace

std::string StoredHeader::text() const {
  Writer out;
  out.add(std::to_string(facts.size()));
  for (const auto& [key, value] : facts) out.add(key), out.add(value);
  out.add(std::to_string(rungs.size()));
  for (const StoredRung& rung : rungs) out.add(rung.name), out.add(rung.step);
  out.add(std::to_string(parameters.size()));
  for (const std::string& path : parameters) out.add(path);
  return out.text();
}

std::optional<StoredHeader> StoredHeader::from_text(const std::string& text) {
  Reader in(text);
  StoredHeader header;
  for (std::size_t k = in.count(); k > 0 && in.good(); --k) {
    const std::string key = in.next();
    header.facts[key] = in.next();
  }
  for (std::size_t k = in.count(); k > 0 && in.good(); --k) {
    const std::string name = in.next();
    header.rungs.push_back({name, std::strtod(in.next().c_str(), nullptr)});
  }
  for (std::size_t k = in.count(); k > 0 && in.good(); --k) header.parameters.push_back(in.next());
  if (!in.good()) return std::nullopt;
  return header;
}

std::string another_than(const std::map<std::string, std::string>& wanted,
                         const std::map<std::string, std::string>& found) {
  const auto said = [&](const std::string& key) {
    const auto fact = found.find(key);
    return fact == found.end() ? std::string() : fact->second;
  };
  const auto differs = [&](const std::string& key) { return wanted.contains(key) && said(key) != wanted.at(key); };
  if (!differs("study") && differs(kVersionFact))
    return "results of " + (said(kVersionFact).empty() ? "an earlier version" : "version " + said(kVersionFact)) +
           ", and this is " + wanted.at(kVersionFact) + ": results of two versions are not mixed";
  for (const auto& [key, value] : wanted)
    if (said(key) != value) return "the samples of another study (its " + key + " differs)";
  return "";
}

// In this order, so that every store of the same parameters begins with the same page.
void make_store_tables(sqlite3* db, const std::filesystem::path& file, const StoredHeader& header) {
  std::string columns;
  for (const std::string& name : header.parameters) columns += quoted(name) + " REAL, ";
  execute(db, file,
          "BEGIN; CREATE TABLE study(key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;"
          "CREATE TABLE rung(id INTEGER PRIMARY KEY, name TEXT NOT NULL, step REAL NOT NULL);"
          "CREATE TABLE parameter(place INTEGER PRIMARY KEY, path TEXT NOT NULL);"
          "CREATE TABLE sample(number INTEGER PRIMARY KEY, status INTEGER NOT NULL, value REAL, " +
              columns +
              "cpu_seconds REAL, model_error REAL, discretisation_error REAL, rung INTEGER, message TEXT, checksum "
              "INTEGER);"
              "CREATE TABLE history(number INTEGER PRIMARY KEY, doubles BLOB NOT NULL);"
              "CREATE TABLE header(id INTEGER PRIMARY KEY, text TEXT NOT NULL, checksum INTEGER NOT NULL);"
              "CREATE TABLE part(id INTEGER PRIMARY KEY, cpu_seconds REAL NOT NULL, wall_seconds REAL NOT NULL);");
  for (const auto& [key, value] : header.facts) {
    Statement put(db, file, "INSERT INTO study VALUES (?, ?)");
    put.bind(1, key);
    put.bind(2, value);
    put.step();
  }
  for (const StoredRung& rung : header.rungs) {
    Statement put(db, file, "INSERT INTO rung(name, step) VALUES (?, ?)");
    put.bind(1, rung.name);
    put.bind(2, rung.step);
    put.step();
  }
  for (std::size_t k = 0; k < header.parameters.size(); ++k) {
    Statement put(db, file, "INSERT INTO parameter VALUES (?, ?)");
    put.bind(1, static_cast<std::int64_t>(k));
    put.bind(2, header.parameters[k]);
    put.step();
  }
  renew_header_text(db, file);
  execute(db, file, "COMMIT");
}

void renew_header_text(sqlite3* db, const std::filesystem::path& file) {
  if (!has_table(db, file, "header")) return;  // a store of a version before
  const std::string text = header_of_tables(db, file).text();
  Statement put(db, file, "INSERT OR REPLACE INTO header VALUES (1, ?, ?)");
  put.bind(1, text);
  put.bind(2, checksum_of(text));
  put.step();
}

bool has_table(sqlite3* db, const std::filesystem::path& file, const std::string& name) {
  Statement there(db, file, "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = ?");
  there.bind(1, name);
  return there.step() && there.integer(0) > 0;
}

StoredHeader header_of_tables(sqlite3* db, const std::filesystem::path& file) {
  StoredHeader header;
  Statement facts(db, file, "SELECT key, value FROM study");
  while (facts.step()) header.facts[facts.text(0)] = facts.text(1);
  Statement rungs(db, file, "SELECT name, step FROM rung ORDER BY id");
  while (rungs.step()) header.rungs.push_back({rungs.text(0), rungs.real(1)});
  Statement paths(db, file, "SELECT path FROM parameter ORDER BY place");
  while (paths.step()) header.parameters.push_back(paths.text(0));
  return header;
}

std::optional<StoredHeader> header_of_text(sqlite3* db, const std::filesystem::path& file) {
  if (!has_table(db, file, "header")) return std::nullopt;
  Statement get(db, file, "SELECT text, checksum FROM header WHERE id = 1");
  if (!get.step()) return std::nullopt;
  const std::string text = get.text(0);
  return checksum_of(text) == get.integer(1) ? StoredHeader::from_text(text) : std::nullopt;
}

}  // namespace boresight
