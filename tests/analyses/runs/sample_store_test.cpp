#include "boresight_analyses/runs/sample_store.hpp"

#include <gmock/gmock.h>
#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>

#include "closed_form.hpp"

namespace boresight {
namespace sample_store_test {

SampleRecord record(std::uint64_t number, double value = 1.5) {
  SampleRecord r;
  r.number = number;
  r.inputs = {0.1 * static_cast<double>(number), -1.0 / 3.0};
  r.outcome.status = Outcome::Status::done;
  r.outcome.value = value;
  return r;
}

TEST(SampleStore, KeepsHistoriesBesideTheSamplesThatHaveOne) {
  const Folder folder("histories");
  const std::vector<double> history = {1.0 / 3.0, -0.0, 1e-300};
  {
    auto store = open_sum_store(folder);
    EXPECT_TRUE(store->history(1).empty());  // before there is any
    SampleRecord with = record(1);
    with.outcome.history = history;
    store->add(with);
    store->add(record(2));
    with.outcome.history = {7.0};
    store->add(with);  // a number is stored once
    store->commit();
  }
  const auto again = open_sum_store(folder);
  EXPECT_EQ(again->history(1), history);
  EXPECT_TRUE(again->history(2).empty());
  EXPECT_EQ(again->count(), 2u);
}

TEST(SampleStore, GivesBackEveryBitInTheOrderOfNumbers) {
  const Folder folder("bits");
  {
    auto store = open_sum_store(folder);
    store->use_rung("sum", 1e-5);
    store->add(record(7, 1.0 / 3.0));
    SampleRecord failed = record(2);
    failed.outcome.status = Outcome::Status::failed;
    failed.outcome.value = std::nan("");
    failed.outcome.message = "singular";
    store->add(failed);
  }
  const SampleStore store(folder.path() / "samples.db");
  std::vector<SampleRecord> found;
  store.read(100, [&](const SampleRecord& r) { found.push_back(r); });
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].number, 2u);
  EXPECT_EQ(found[0].outcome.status, Outcome::Status::failed);
  EXPECT_TRUE(std::isnan(found[0].outcome.value));
  EXPECT_EQ(found[0].outcome.message, "singular");
  EXPECT_EQ(found[1].outcome.value, 1.0 / 3.0);
  EXPECT_EQ(found[1].inputs, record(7).inputs);
  EXPECT_EQ(store.rungs().at(0).step, 1e-5);
}

TEST(SampleStore, ANumberIsStoredOnce) {
  const Folder folder("once");
  auto store = open_sum_store(folder);
  store->add(record(3, 1.0));
  store->add(record(3, 2.0));
  store->commit();
  EXPECT_EQ(store->count(), 1u);
  store->read(10, [](const SampleRecord& r) { EXPECT_EQ(r.outcome.value, 1.0); });
}

TEST(SampleStore, KnowsWhatIsMissing) {
  const Folder folder("missing");
  auto store = open_sum_store(folder);
  for (const std::uint64_t number : {0u, 1u, 4u, 5u, 8u}) store->add(record(number));
  store->commit();
  const std::vector<NumberRange> gaps = store->missing(12);
  ASSERT_EQ(gaps.size(), 3u);
  EXPECT_EQ(gaps[0].first, 2u);
  EXPECT_EQ(gaps[0].end, 4u);
  EXPECT_EQ(gaps[1].first, 6u);
  EXPECT_EQ(gaps[2].end, 12u);
  EXPECT_EQ(store->missing(2).size(), 0u);
}

TEST(SampleStore, AnotherStudysSamplesAreRefused) {
  const Folder folder("other");
  open_sum_store(folder)->add(record(1));
  EXPECT_THROW(SampleStore(folder.path() / "samples.db", {{"study", "product"}}, {"x1", "x2"}), StoreRefused);
  EXPECT_THROW(SampleStore(folder.path() / "nothing.db"), StoreRefused);
  std::ofstream(folder.path() / "text.db") << std::string(5000, 'x');
  EXPECT_THROW(SampleStore(folder.path() / "text.db"), StoreRefused);
}

std::string refusal_of(const std::filesystem::path& file, const std::map<std::string, std::string>& facts) {
  try {
    const SampleStore store(file, facts, {"x1", "x2"});
  } catch (const StoreRefused& refusal) {
    return refusal.what();
  }
  return "taken";
}

TEST(SampleStore, OfAnotherVersionIsRefusedInALineThatSaysWhatToDo) {
  const Folder folder("version");
  const auto with = [](const std::string& version) {
    return std::map<std::string, std::string>{{"study", "sum"}, {"version", version}};
  };
  const std::filesystem::path file = folder.path() / "samples.db";
  SampleStore(file, with("0.9.0"), {"x1", "x2"}).add(record(1));
  EXPECT_EQ(refusal_of(file, with("1.0.0")),
            file.string() +
                " holds results of version 0.9.0, and this is 1.0.0: results of two versions are not mixed; "
                "give another --out, or remove it");
  EXPECT_THAT(refusal_of(file, {{"study", "product"}, {"version", "1.0.0"}}), testing::HasSubstr("another study"));
  EXPECT_EQ(refusal_of(file, with("0.9.0")), "taken");
  EXPECT_EQ(refusal_of(file, {{"study", "sum"}}), "taken") << "who asks for no version";
  EXPECT_EQ(SampleStore(file).count(), 1u) << "who only reads";

  // As versions before wrote them.
  const std::filesystem::path silent = folder.path() / "silent.db";
  SampleStore(silent, {{"study", "sum"}}, {"x1", "x2"}).add(record(1));
  EXPECT_THAT(refusal_of(silent, with("1.0.0")),
              testing::HasSubstr("results of an earlier version, and this is 1.0.0"));

  // A rank's own.
  SampleStore store(file, with("0.9.0"), {"x1", "x2"});
  EXPECT_THROW(store.merge(silent), StoreRefused);

  // A damaged one.
  const std::filesystem::path damaged = folder.path() / "damaged.db";
  {
    SampleStore many(damaged, with("0.9.0"), {"x1", "x2"});
    for (std::uint64_t k = 0; k < 2000; ++k) many.add(record(k));
  }
  std::fstream(damaged, std::ios::binary | std::ios::in | std::ios::out)
      .seekp(static_cast<std::streamoff>(std::filesystem::file_size(damaged) / 2))
      .write("xxxxxxxx", 8);
  EXPECT_THAT(refusal_of(damaged, with("1.0.0")), testing::HasSubstr("results of version 0.9.0, and this is 1.0.0"));
}

// Copies what is on the disk before every commit of whatever has the store open: what a kill between two leaves.
class EveryCommit {
 public:
  explicit EveryCommit(const Folder& folder) {
    from = folder.path() / "samples.db";
    copies = 0;
    sqlite3_auto_extension(reinterpret_cast<void (*)()>(&watch));
  }
  ~EveryCommit() { sqlite3_reset_auto_extension(); }
  static std::filesystem::path copy(int k) {
    return from.parent_path() / ("commit-" + std::to_string(k)) / from.filename();
  }
  static int count() { return copies; }

 private:
  static int watch(sqlite3* db, char**, const void*) {
    sqlite3_commit_hook(db, &before_commit, nullptr);
    return SQLITE_OK;
  }
  static int before_commit(void*) {
    const std::filesystem::path to = copy(copies++);
    std::filesystem::create_directory(to.parent_path());
    std::error_code none_yet;
    for (const char* suffix : {"", "-wal"})
      std::filesystem::copy_file(from.string() + suffix, to.string() + suffix, none_yet);
    return 0;
  }
  static inline std::filesystem::path from;
  static inline int copies = 0;
};

TEST(SampleStore, SaysOfItselfAllOrNothingWheneverItIsKilled) {
  const Folder folder("notes");
  {
    const EveryCommit commits(folder);
    auto store = open_sum_store(folder);
    store->use_rung("sum", 1e-5);
    store->add(record(1));
    store->note("counted_cost", "1e-6");
    store->note({{"mechanism", "a sum"}, {"unit", "m"}});
    store->note("counted_cost", "2e-6");
    store->use_rung("sum", 1e-6);
    store->add(record(2));
  }
  ASSERT_GE(EveryCommit::count(), 6);
  int noted = 0, with_sample = 0;
  for (int k = 0; k < EveryCommit::count(); ++k) {
    const SampleStore killed(EveryCommit::copy(k), {{"study", "sum"}}, {"x1", "x2"});
    EXPECT_EQ(killed.damage(), "") << "before commit " << k;
    EXPECT_EQ(killed.fact("mechanism").empty(), killed.fact("unit").empty()) << "before commit " << k;
    noted += !killed.fact("counted_cost").empty();
    with_sample += killed.count() == 1;
  }
  EXPECT_GE(noted, 3);
  EXPECT_GE(with_sample, noted);
}

TEST(SampleStore, TwoRunsCannotHaveItOpenAtOnce) {
  const Folder folder("busy");
  auto store = open_sum_store(folder);
  store->add(record(1));
  store->commit();
  // Locks are between processes.
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      const SampleStore second(folder.path() / "samples.db");
    } catch (const StoreRefused&) {
      ::_exit(7);
    } catch (...) {
    }
    ::_exit(8);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST(SampleStore, WhatIsCommittedOutlivesAKill) {
  const Folder folder("kill");
  const pid_t child = ::fork();
  if (child == 0) {
    auto store = open_sum_store(folder);
    for (std::uint64_t k = 0; k < 1000; ++k) store->add(record(k));
    store->commit();
    for (std::uint64_t k = 1000; k < 1100; ++k) store->add(record(k));  // never committed
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(SampleStore(folder.path() / "samples.db").count(), 1000u);
}

TEST(SampleStore, StoresOfLostRanksAreMergedWithoutDoubles) {
  const Folder folder("merge");
  auto store = open_sum_store(folder);
  store->add(record(1));
  for (const int rank : {1, 12}) {
    SampleStore shard(folder.path() / ("samples." + std::to_string(rank) + ".db"), {{"study", "sum"}}, {"x1", "x2"});
    shard.add(record(1));
    shard.add(record(static_cast<std::uint64_t>(10 + rank)));
  }
  merge_shards(*store, folder.path());
  EXPECT_EQ(store->count(), 3u);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "samples.12.db"));
}

TEST(SampleStore, AStoreWhoseRankWasKilledAsItBeganBlocksNobody) {
  const Folder folder("begun");
  auto store = open_sum_store(folder);
  store->add(record(1));
  std::ofstream(folder.path() / "samples.1.db");  // before the first page
  sqlite3* begun = nullptr;                       // and before the tables
  ASSERT_EQ(sqlite3_open((folder.path() / "samples.2.db").c_str(), &begun), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(begun, "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(begun);
  ASSERT_GT(std::filesystem::file_size(folder.path() / "samples.2.db"), 0u);
  merge_shards(*store, folder.path());
  EXPECT_EQ(store->count(), 1u);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "samples.1.db"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "samples.2.db"));
}

}  // namespace sample_store_test
}  // namespace boresight
