#include "boresight_analyses/runs/store_salvage.hpp"

#include <unistd.h>

#include <fstream>
#include <memory>
#include <optional>

#include "boresight_analyses/runs/sample_store.hpp"
#include "boresight_analyses/runs/sqlite_statement.hpp"
#include "boresight_analyses/runs/stored_header.hpp"
#include "boresight_analyses/runs/whole_rows.hpp"

namespace boresight {
namespace fs = std::filesystem;
namespace {

struct Close {
  void operator()(sqlite3* db) const { sqlite3_close(db); }
};
using Connection = std::unique_ptr<sqlite3, Close>;

Connection open_as_it_is(const fs::path& file) {
  sqlite3* db = nullptr;
  const int code = sqlite3_open_v2(file.c_str(), &db, SQLITE_OPEN_READWRITE, nullptr);
  Connection connection(db);
  if (code != SQLITE_OK) fail(db, file, code);
  sqlite3_exec(db, "PRAGMA locking_mode = EXCLUSIVE", nullptr, nullptr, nullptr);
  return connection;
}

bool is_of(const StoredHeader& header, const std::map<std::string, std::string>& facts,
           const std::vector<std::string>& parameters) {
  return header.parameters == parameters && another_than(facts, header.facts).empty();
}

// Whose the samples are and how they were computed; nothing where that cannot be told. Throws StoreRefused where they are another
// study's for certain.
std::optional<StoredHeader> header_of_study(sqlite3* db, const fs::path& file,
                                            const std::map<std::string, std::string>& facts,
                                            const std::vector<std::string>& parameters) {
  std::optional<StoredHeader> text;
  try {
    text = header_of_text(db, file);
  } catch (const StoreDamaged&) {
  }
  if (text && !is_of(*text, facts, parameters)) {
    const std::string another = another_than(facts, text->facts);
    throw StoreRefused(file.parent_path().string() + " holds " +
                       (another.empty() ? "the samples of another study" : another) +
                       "; give another --out, or remove it");
  }
  if (text) return text;
  try {
    if (StoredHeader header = header_of_tables(db, file); is_of(header, facts, parameters)) return header;
  } catch (const StoreDamaged&) {
  }
  return std::nullopt;
}

void put_copy(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error)
    throw StoreFailed("cannot write " + to.string() + ": " + error.message() + "; the damaged store is as it was");
}

void remove_store(const fs::path& file) {
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) ::unlink((file.string() + suffix).c_str());
}

// The first page of a store says where its tables are: the same for all stores of the same parameters. It is put into a copy.
void renew_first_page(const fs::path& copy, const fs::path& scratch, const std::vector<std::string>& parameters) {
  constexpr std::size_t kPage = 4096, kCounter = 24, kPages = 28, kFree = 32, kValidFor = 92;
  remove_store(scratch);
  { const SampleStore model(scratch, {}, parameters); }
  std::string page(kPage, '\0');
  std::ifstream(scratch, std::ios::binary).read(page.data(), kPage);
  remove_store(scratch);
  std::error_code error;
  const std::uint64_t pages = fs::file_size(copy, error) / kPage;
  for (int byte = 0; byte < 4; ++byte) {
    page[kPages + byte] = static_cast<char>(pages >> (24 - 8 * byte));
    page[kValidFor + byte] = page[kCounter + byte];
  }
  for (std::size_t byte = kFree; byte < kFree + 8; ++byte) page[byte] = '\0';
  std::fstream out(copy, std::ios::binary | std::ios::in | std::ios::out);
  out.write(page.data(), kPage);
}

// All that can be read of the damaged store goes into the new one. Returns how many samples; nothing where nobody knows whose
// they are.
std::optional<std::uint64_t> take_whole_samples(const fs::path& from, const fs::path& to,
                                                const std::map<std::string, std::string>& facts,
                                                const std::vector<std::string>& parameters) {
  const Connection db = open_as_it_is(from);
  const std::optional<StoredHeader> header = header_of_study(db.get(), from, facts, parameters);
  if (!header) return std::nullopt;
  remove_store(to);
  SampleStore store(to, header->facts, parameters);
  for (const SampleStore::StoredRung& rung : header->rungs) store.use_rung(rung.name, rung.step);
  int current = static_cast<int>(header->rungs.size());
  const RowsRead read =
      read_whole_rows(db.get(), from, parameters.size(), ~std::uint64_t{0} >> 1, [&](SampleRecord& record, int rung) {
        if (rung != current && rung >= 1 && static_cast<std::size_t>(rung) <= header->rungs.size()) {
          const SampleStore::StoredRung& own = header->rungs[static_cast<std::size_t>(rung) - 1];
          store.use_rung(own.name, own.step);
          current = rung;
        }
        store.add(record);
      });
  store.commit();
  return read.whole;
}

fs::path free_name(const fs::path& file) {
  const fs::path base = file.parent_path() / ("damaged-" + file.filename().string());
  fs::path name = base;
  std::error_code error;
  for (int n = 2; fs::exists(name, error); ++n) name = base.string() + "-" + std::to_string(n);
  return name;
}

}  // namespace

std::string damage_of(sqlite3* db, const fs::path& file) {
  try {
    Statement tables(db, file, "SELECT count(*) FROM sqlite_master");
    if (tables.step() && tables.integer(0) == 0) return "";
    std::error_code error;
    if (sqlite3_db_readonly(db, "main") == 1 && ::access(file.c_str(), W_OK) == 0)
      return "its first page is not what was stored";
    Statement check(db, file, "PRAGMA quick_check(1)");
    if (!check.step() || check.text(0) != "ok") return "its pages do not fit together";
    const StoredHeader header = header_of_tables(db, file);
    if (has_table(db, file, "header")) {
      const std::optional<StoredHeader> text = header_of_text(db, file);
      if (!text || !(*text == header)) return "what it says of itself is not what was stored";
    }
    const RowsRead read =
        read_whole_rows(db, file, header.parameters.size(), ~std::uint64_t{0} >> 1, [](SampleRecord&, int) {});
    if (!read.good()) return std::to_string(read.damaged) + " of its samples are not what was stored";
  } catch (const StoreDamaged&) {
    return "its pages do not fit together";
  }
  return "";
}

std::string salvage_store(const fs::path& file, const std::string& fault,
                          const std::map<std::string, std::string>& facts, const std::vector<std::string>& parameters) {
  const fs::path renewed = file.string() + "-renewed", copy = file.string() + "-copy",
                 scratch = file.string() + "-scratch";
  const std::string wal = file.string() + "-wal";
  std::error_code error;
  const auto take_from_copy = [&](bool new_first_page) -> std::optional<std::uint64_t> {
    remove_store(copy);
    put_copy(file, copy);
    if (fs::exists(wal, error)) put_copy(wal, copy.string() + "-wal");
    if (new_first_page) renew_first_page(copy, scratch, parameters);
    std::optional<std::uint64_t> kept;
    try {
      kept = take_whole_samples(copy, renewed, facts, parameters);
    } catch (const StoreDamaged&) {
    }
    remove_store(copy);
    return kept;
  };
  std::optional<std::uint64_t> kept = take_from_copy(false);
  if (!kept) kept = take_from_copy(true);
  if (!kept) {
    remove_store(renewed);
    const SampleStore empty(renewed, facts, parameters);
  }
  const fs::path damaged = free_name(file);
  if (::link(file.c_str(), damaged.c_str()) != 0) put_copy(file, damaged);
  // The log belongs to the old file and must not be read with the new one.
  if (fs::exists(wal, error)) fs::rename(wal, damaged.string() + "-wal", error);
  if (::rename(renewed.c_str(), file.c_str()) != 0)
    throw StoreFailed("cannot write " + file.string() + "; the damaged store is kept as " + damaged.string());
  const std::string begun = file.filename().string() + " was damaged (" + fault + "): ";
  return begun +
         (kept ? std::to_string(*kept) + " samples in it are whole and kept, those that are missing are computed anew"
               : "it does not tell any more whose its samples are, so that all are computed anew") +
         "; the damaged file is kept as " + damaged.filename().string();
}

}  // namespace boresight
