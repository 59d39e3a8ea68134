// apps/boresight/tables.md against what verbs write: every table and column is explained, and every one that is explained is there.
#include <gmock/gmock.h>
#include <sqlite3.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>

#include "program.hpp"

namespace boresight::app {
namespace documented_tables_test {

using Columns = std::set<std::string>;

// The columns that the page explains, by table or file.
std::map<std::string, Columns> explained() {
  std::ifstream in(BORESIGHT_SOURCE "/apps/boresight/tables.md");
  std::map<std::string, Columns> tables;
  std::string table;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("#")) table = line.substr(line.find(' ') + 1);
    if (!line.starts_with("| `")) continue;
    const std::string cell = line.substr(0, line.find('|', 1));
    for (std::size_t open = cell.find('`'); open != std::string::npos;) {
      const std::size_t close = cell.find('`', open + 1);
      tables[table].insert(cell.substr(open + 1, close - open - 1));
      open = cell.find('`', close + 1);
    }
  }
  return tables;
}

std::vector<std::vector<std::string>> rows(const std::filesystem::path& file, const std::string& query) {
  sqlite3* db = nullptr;
  EXPECT_EQ(sqlite3_open_v2(file.c_str(), &db, SQLITE_OPEN_READONLY, nullptr), SQLITE_OK);
  std::vector<std::vector<std::string>> found;
  const auto take = [](void* to, int n, char** values, char**) {
    auto& row = static_cast<std::vector<std::vector<std::string>>*>(to)->emplace_back();
    for (int k = 0; k < n; ++k) row.emplace_back(values[k] == nullptr ? "" : values[k]);
    return 0;
  };
  EXPECT_EQ(sqlite3_exec(db, query.c_str(), take, &found, nullptr), SQLITE_OK) << query;
  sqlite3_close(db);
  return found;
}

class DocumentedTables : public Program {
 protected:
  // Names of joints in front of columns left out. `of`: what the page has after the file's name, where several verbs write one of that name.
  void expect_explained(const std::vector<std::string>& names, const std::string& folder = "out",
                        const std::string& of = "") {
    const auto page = explained();
    for (const std::string& name : names) {
      std::istringstream text(this->text(folder + "/" + name));
      std::string header, cell;
      std::getline(text, header);
      Columns columns;
      for (std::istringstream cells(header); std::getline(cells, cell, ',');)
        columns.insert(cell.starts_with("D.") ? cell.substr(2) : cell);
      ASSERT_TRUE(page.count(name + of)) << name << of;
      EXPECT_EQ(page.at(name + of), columns) << name << of;
    }
  }
};

TEST_F(DocumentedTables, OfAStoreAreThoseThatItHas) {
  std::ofstream(folder_ / "study.toml") << "format = 1\nmechanism = \"" BORESIGHT_EXAMPLES
                                           "/four-bar/four-bar.toml\"\n"
                                           "[[random]]\nparameter = \"clearance.D.radial\"\n"
                                           "distribution = { uniform = { min = \"0.1 mm\", max = \"0.2 mm\" } }\n"
                                           "[montecarlo]\nsamples = 20\nseed = 1\n";
  ASSERT_EQ(call({"montecarlo", "study.toml", "--rung", "quasistatic", "--set", "motion.duration=20ms", "--quiet",
                  "--out", "out"})
                .status,
            0);
  const auto page = explained();
  const std::filesystem::path store = folder_ / "out" / "samples.db";
  std::set<std::string> tables;
  for (const auto& row : rows(store, "SELECT name FROM sqlite_master WHERE type = 'table'")) {
    tables.insert(row[0]);
    ASSERT_TRUE(page.count(row[0])) << "no table " << row[0] << " in tables.md";
    Columns columns;
    for (const auto& column : rows(store, "PRAGMA table_info(" + row[0] + ")")) columns.insert(column[1]);
    if (row[0] == "sample")
      for (const auto& parameter : rows(store, "SELECT path FROM parameter")) {
        EXPECT_EQ(columns.erase(parameter[0]), 1u);
      }
    EXPECT_EQ(page.at(row[0]), columns) << row[0];
  }
  for (const auto& [table, columns] : page)
    if (table.find(".csv") == std::string::npos) {
      EXPECT_TRUE(tables.count(table)) << "tables.md explains " << table << ", which is not there";
    }
  const auto computed = rows(store, "SELECT count(*) FROM sample WHERE status = 0 AND value > 0 AND rung = 1");
  EXPECT_EQ(computed.at(0).at(0), "20");
}

TEST_F(DocumentedTables, OfARunAreThoseThatItWrites) {
  ASSERT_EQ(call({"run", BORESIGHT_EXAMPLES "/four-bar/four-bar.toml", "--set", "motion.duration=20ms", "--quiet",
                  "--out", "out"})
                .status,
            0);
  expect_explained({"timeseries.csv", "events.csv"});
}

TEST_F(DocumentedTables, OfOtherVerbsAreThoseThatTheyWrite) {
  ASSERT_EQ(call({"laws", "--quiet", "--out", "out"}).status, 0);
  expect_explained({"restitution.csv", "force.csv", "friction.csv"});
  ASSERT_EQ(call({"check", BORESIGHT_EXAMPLES "/four-bar/four-bar.toml", "--quiet", "--out", "checked"}).status, 0);
  expect_explained({"conditioning.csv"}, "checked");
  ASSERT_EQ(call({"stability", BORESIGHT_EXAMPLES "/four-bar/four-bar.toml", "--set", "motion.duration=20ms", "--quiet",
                  "--out", "stable"})
                .status,
            0);
  expect_explained({"limits.csv", "growth.csv", "steps.csv", "baumgarte.csv", "horizon.csv", "cases.csv"}, "stable");
}

TEST_F(DocumentedTables, OfTailAndBudgetAreTwoOfOneName) {
  const std::string study = "format = 1\nmechanism = \"" + mechanism_ + R"("
[[random]]
parameter = "clearance.F1.radial"
distribution = { normal = { mean = "0.1 mm", sd = "0.01 mm" }, truncate = ["0.05 mm", "0.15 mm"] }
)";
  const auto answers = [&](const std::string& verb, const std::string& table, std::vector<std::string> more) {
    write("study.toml", study + table);
    more.insert(more.begin(), {verb, "study.toml", "--set", "motion.duration=20ms", "--quiet", "--out", verb});
    const Ended ended = call(more);
    return ended.status == 0 || ended.status == 1;  // whatever it says of the requirement
  };
  ASSERT_TRUE(answers("montecarlo", R"([montecarlo]
requirement = { limit = "0.12 mm", probability = 0.95, confidence = 0.9 }
tail = { cheap = "perturbation", exact = "quasistatic", budget = "0.4 s", pilot = 20 }
)",
                      {}));
  expect_explained({"levels.csv"}, "montecarlo", " of tail");
  ASSERT_TRUE(answers("budget", "[budget]\nattribution = 4\nsampling = \"0.2 ms\"\nwindow = \"2 ms\"\nmembers = 20\n",
                      {"--set", "clearance.F1.axes=free", "--rung", "quasistatic"}));
  expect_explained({"levels.csv", "classical.csv", "contributions.csv"}, "budget");
}

// A table that is new and not explained is found by the name that the sources write it under.
TEST(DocumentedTable, ThereIsOneForEveryFileThatAVerbWrites) {
  const auto page = explained();
  const std::regex name("\"([a-z_]+\\.csv)\"");
  std::set<std::string> written;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(BORESIGHT_SOURCE "/apps/boresight")) {
    if (entry.path().extension() != ".cpp") continue;
    std::ifstream in(entry.path());
    const std::string source((std::istreambuf_iterator<char>(in)), {});
    for (std::sregex_iterator at(source.begin(), source.end(), name), end; at != end; ++at) written.insert((*at)[1]);
  }
  written.erase("samples.csv");  // the table `sample`
  for (const std::string& file : written)
    EXPECT_TRUE(page.count(file) || file == "posterior.csv") << "no table " << file << " in tables.md";
  for (const auto& [table, columns] : page)
    EXPECT_TRUE(!table.ends_with(".csv") || written.count(table)) << table << " is explained, and nothing writes it";
}

}  // namespace documented_tables_test
}  // namespace boresight::app
