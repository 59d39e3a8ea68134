// Stores of samples whose bytes are not what was written: what is whole is kept, what is not is computed anew, and said.
#include <gmock/gmock.h>
#include <sqlite3.h>
#include <time.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <map>
#include <random>
#include <set>

#include "closed_form.hpp"

namespace boresight {
namespace damaged_store_test {

constexpr std::uint64_t kSamples = 400;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put_bytes(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

std::vector<double> uninterrupted() {
  const Folder folder("whole-store");
  auto store = open_sum_store(folder);
  return run_sum(SumModel(), sum_plan(kSamples), *store, folder).values;
}

std::string whole_store() {
  const Folder folder("sound-store");
  {
    auto store = open_sum_store(folder);
    run_sum(SumModel(), sum_plan(kSamples), *store, folder);
  }
  return bytes_of(folder.path() / "samples.db");
}

// One of four faults at a random place.
std::string damaged(std::string bytes, std::mt19937_64& random) {
  const std::size_t at = random() % bytes.size();
  switch (random() % 4) {
    case 0:
      bytes[at] = static_cast<char>(bytes[at] ^ (1 << (random() % 8)));
      break;
    case 1:
      for (std::size_t k = at; k < std::min(bytes.size(), at + 512); ++k) bytes[k] = '\0';
      break;
    case 2:
      for (std::size_t k = at; k < std::min(bytes.size(), at + 64); ++k) bytes[k] = static_cast<char>(random());
      break;
    default:
      bytes.resize(at);
  }
  return bytes;
}

TEST(DamagedStore, TwoHundredStoresLoseNoSampleDoubleNoneBlockNobodyAndGiveNoWrongValue) {
  const std::vector<double> truth = uninterrupted();
  const std::string sound = whole_store();
  std::mt19937_64 random(20);
  std::uint64_t seen = 0, computed = 0;
  for (int k = 0; k < 200; ++k) {
    const Folder folder("damaged-store");
    const std::string bytes = damaged(sound, random);
    put_bytes(folder.path() / "samples.db", bytes);
    const SumModel model;
    std::string said;
    std::vector<double> values;
    ASSERT_NO_THROW({
      auto store = open_sum_store(folder);
      said = store->damage();
      values = run_sum(model, sum_plan(kSamples), *store, folder).values;
      EXPECT_EQ(store->count(), kSamples) << k;
    }) << k;
    ASSERT_EQ(values, truth) << k;
    // Every byte of a sample counts; one that no sample or table uses may change without a word.
    EXPECT_TRUE(model.evaluated == 0 || bytes.empty() || !said.empty()) << k;
    seen += !said.empty();
    computed += model.evaluated;
  }
  EXPECT_GT(seen, 80u) << "most bytes are in use";
  EXPECT_LT(computed, 200 * kSamples / 2) << "the undamaged are kept";
}

TEST(DamagedStore, OneFlippedBitOfAValueCostsThatSampleOnly) {
  const Folder folder("flipped-value");
  double value = 0.0;
  {
    auto store = open_sum_store(folder);
    run_sum(SumModel(), sum_plan(kSamples), *store, folder);
    store->read(8, [&](const SampleRecord& r) { value = r.outcome.value; });
  }
  std::string bytes = bytes_of(folder.path() / "samples.db"), pattern(8, '\0');
  for (int k = 0; k < 8; ++k)
    pattern[static_cast<std::size_t>(k)] = static_cast<char>(std::bit_cast<std::uint64_t>(value) >> (56 - 8 * k));
  const std::size_t at = bytes.find(pattern);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 4] = static_cast<char>(bytes[at + 4] ^ 1);
  put_bytes(folder.path() / "samples.db", bytes);
  {
    const SampleStore read(folder.path() / "samples.db");
    std::uint64_t whole = 0;
    read.read(kSamples, [&](const SampleRecord&) { ++whole; });
    EXPECT_EQ(whole, kSamples - 1);
    EXPECT_THAT(read.damage(), testing::HasSubstr("1 are not what was stored"));
  }
  auto store = open_sum_store(folder);
  EXPECT_EQ(store->count(), kSamples - 1);
  EXPECT_THAT(store->damage(), testing::AllOf(testing::HasSubstr("399 samples in it are whole and kept"),
                                              testing::HasSubstr("damaged-samples.db")));
  EXPECT_EQ(bytes_of(folder.path() / "damaged-samples.db"), bytes);
  const SumModel model;
  EXPECT_EQ(run_sum(model, sum_plan(kSamples), *store, folder).values, uninterrupted());
  EXPECT_EQ(model.evaluated, 1u);
  EXPECT_NE(store->fact("damage"), "") << "it is not forgotten";
}

// SQLite's pages are read block by block; around a lost one, sample by sample.
TEST(DamagedStore, APageThatIsLostCostsTheSamplesOnItOnly) {
  const Folder folder("lost-page");
  std::map<std::uint64_t, std::string> stored;  // the bytes of each sample's value, as SQLite writes numbers
  {
    auto store = open_sum_store(folder);
    run_sum(SumModel(), sum_plan(kSamples), *store, folder);
    store->read(kSamples, [&](const SampleRecord& r) {
      const auto bits = std::bit_cast<std::uint64_t>(r.outcome.value);
      for (int k = 0; k < 8; ++k) stored[r.number] += static_cast<char>(bits >> (56 - 8 * k));
    });
  }
  std::string bytes = bytes_of(folder.path() / "samples.db");
  const std::size_t size = static_cast<unsigned char>(bytes[16]) * 256u + static_cast<unsigned char>(bytes[17]);
  const std::size_t lost = bytes.find(stored.at(150)) / size;
  std::set<std::uint64_t> on_it;
  for (const auto& [number, value] : stored)
    if (bytes.find(value) / size == lost) on_it.insert(number);
  ASSERT_GT(on_it.size(), 5u);
  ASSERT_LT(on_it.size(), 200u);
  std::fill_n(bytes.begin() + static_cast<std::ptrdiff_t>(lost * size), size, '\0');
  put_bytes(folder.path() / "samples.db", bytes);
  auto store = open_sum_store(folder);
  EXPECT_EQ(store->count(), kSamples - on_it.size());
  store->read(kSamples, [&](const SampleRecord& r) { EXPECT_FALSE(on_it.contains(r.number)) << r.number; });
  const SumModel model;
  EXPECT_EQ(run_sum(model, sum_plan(kSamples), *store, folder).values, uninterrupted());
  EXPECT_EQ(model.evaluated, on_it.size());
}

TEST(DamagedStore, ADamagedStoreOfAnotherStudyIsRefusedAndLeftAsItIs) {
  const Folder folder("damaged-other");
  {
    auto store = open_sum_store(folder);
    run_sum(SumModel(), sum_plan(kSamples), *store, folder);
  }
  std::string bytes = bytes_of(folder.path() / "samples.db");
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  put_bytes(folder.path() / "samples.db", bytes);
  EXPECT_THROW(SampleStore(folder.path() / "samples.db", {{"study", "product"}}, {"x1", "x2"}), StoreRefused);
  EXPECT_EQ(bytes_of(folder.path() / "samples.db"), bytes);
}

TEST(DamagedStore, StoresOfVersionsBeforeAreGoneOnWith) {
  const Folder folder("old-store");
  {
    auto store = open_sum_store(folder);
    run_sum(SumModel(), sum_plan(kSamples / 2), *store, folder);
  }
  // As it was made before there were checksums.
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open((folder.path() / "samples.db").c_str(), &db), SQLITE_OK);
  for (const char* sql :
       {"DROP TABLE header", "DROP TABLE part", "DROP TABLE history", "ALTER TABLE sample DROP COLUMN checksum"})
    EXPECT_EQ(sqlite3_exec(db, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sql;
  sqlite3_close(db);
  auto store = open_sum_store(folder);
  EXPECT_EQ(store->damage(), "");
  EXPECT_EQ(store->count(), kSamples / 2);
  EXPECT_EQ(run_sum(SumModel(), sum_plan(kSamples), *store, folder).values, uninterrupted());
}

TEST(SampleStore, KnowsWhatEarlierPartsCost) {
  const Folder folder("parts");
  for (int part = 0; part < 3; ++part) {
    auto store = open_sum_store(folder);
    const SampleStore::Cost earlier = store->earlier();
    EXPECT_EQ(earlier.cpu_seconds > 0.0, part > 0);
    run_sum(SumModel(), sum_plan(100 * (static_cast<std::uint64_t>(part) + 1)), *store, folder);
  }
  // The clock is this process's: three parts are three times what it has taken, about.
  const timespec time = [] {
    timespec now = {};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now;
  }();
  const double now = static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  const double all = open_sum_store(folder)->earlier().cpu_seconds;
  EXPECT_GT(all, 1.5 * now - 0.5);
  EXPECT_LE(all, 3.0 * now);
}

// The number that says how the file is to be written: an SQLite that does not know it reads it all the same, and never writes it.
TEST(DamagedStore, AFirstPageThatForbidsWritingIsSeenWhereTheFileMayBeWritten) {
  const Folder folder("first-page");
  std::string bytes = whole_store();
  bytes[18] = 9;
  put_bytes(folder.path() / "samples.db", bytes);
  auto store = open_sum_store(folder);
  EXPECT_THAT(store->damage(), testing::HasSubstr("its first page is not what was stored"));
  EXPECT_EQ(run_sum(SumModel(), sum_plan(kSamples), *store, folder).values, uninterrupted());
}

}  // namespace damaged_store_test
}  // namespace boresight
