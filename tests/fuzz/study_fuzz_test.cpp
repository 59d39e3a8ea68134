// Damaged studies and data files are either refused in one line or read into something that holds; nothing crashes or hangs.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "boresight/mechanism/error.hpp"
#include "fuzz_seed.hpp"
#include "mutation.hpp"
#include "study_reading.hpp"

namespace boresight {
namespace {

constexpr double kLongest = 10.0;  // [s] for one input, on a busy machine

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::vector<std::string> studies() {
  std::vector<std::string> texts;
  for (const auto& entry : std::filesystem::directory_iterator(BORESIGHT_FUZZ_STUDIES))
    if (entry.path().extension() == ".toml") texts.push_back(bytes_of(entry.path()));
  std::sort(texts.begin(), texts.end());
  return texts;
}

struct Tally {
  int read = 0, refused = 0;
};

// `look`: reads one input, and returns its fault.
template <typename Look>
void see(const std::string& what, Tally& tally, const Look& look) {
  const auto begin = std::chrono::steady_clock::now();
  try {
    EXPECT_EQ(look(), "") << what;
    ++tally.read;
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find_first_of("\n\r"), std::string::npos) << what << "\n" << line;
    EXPECT_LT(line.size(), 2000u) << what;
    EXPECT_NE(line.find("expected "), std::string::npos) << what << "\n" << line;
    for (const char c : line)
      EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20 || c == 0x7f) << "raw text on the terminal: " << what;
    ++tally.refused;
  } catch (const std::exception& error) {
    ADD_FAILURE() << what << "\nthrew something else: " << error.what();
  }
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), kLongest) << what;
}

void run_studies(int count, std::uint64_t seed, Tally& tally) {
  const std::vector<std::string> seeds = studies();
  ASSERT_GE(seeds.size(), 8u);
  for (int k = 0; k < count && !testing::Test::HasFailure(); ++k) {
    const std::uint64_t one = seed + static_cast<std::uint64_t>(k);
    Mutator mutator(one);
    const std::string text = mutator.mutate(seeds[mutator.below(seeds.size())]);
    see("BORESIGHT_FUZZ_SEED=" + std::to_string(one) + ":\n" + text.substr(0, 4000), tally,
        [&] { return fault_of_study(text, BORESIGHT_FUZZ_STUDIES); });
  }
}

// Fields of a table of numbers, damaged as a spreadsheet, a locale or a logger would.
std::string damaged_table(std::string text, Mutator& mutator) {
  const std::string fields[] = {"nan",
                                "NA",
                                "",
                                "1e999",
                                "-inf",
                                "0x10",
                                "1,5",
                                "\"3.2\"",
                                "3.2 um",
                                "+4",
                                " 5 ",
                                "=1+1",
                                "\t",
                                "1e-320",
                                "#",
                                "\r",
                                std::string(300, '9')};
  for (std::size_t n = 1 + mutator.below(3); n > 0; --n) {
    if (mutator.below(3) == 0) {
      text = mutator.mutate(text);
      continue;
    }
    std::vector<std::size_t> commas;
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] == ',' || text[i] == '\n') commas.push_back(i);
    if (commas.size() < 2) continue;
    const std::size_t at = mutator.below(commas.size() - 1);
    text.replace(commas[at] + 1, commas[at + 1] - commas[at] - 1, fields[mutator.below(std::size(fields))]);
  }
  return text;
}

void run_tables(int count, std::uint64_t seed, Tally& tally) {
  std::string table = bytes_of(BORESIGHT_EXAMPLES "/calibration/fast.csv");
  table.resize(table.find('\n', 2000) + 1);  // a few dozen lines
  const std::string file =
      testing::TempDir() + "boresight-fuzz-" +
      std::to_string(std::hash<std::string>{}(testing::UnitTest::GetInstance()->current_test_info()->name())) + ".csv";
  for (int k = 0; k < count && !testing::Test::HasFailure(); ++k) {
    const std::uint64_t one = seed + static_cast<std::uint64_t>(k);
    Mutator mutator(one);
    const std::string text = damaged_table(table, mutator);
    std::ofstream(file, std::ios::binary) << text;
    see("BORESIGHT_FUZZ_SEED=" + std::to_string(one) + ":\n" + text.substr(0, 4000), tally,
        [&] { return fault_of_data(file); });
  }
  std::filesystem::remove(file);
}

TEST(StudyFuzz, EverySeedIsRead) {
  for (const std::string& text : studies()) {
    try {
      EXPECT_EQ(fault_of_study(text, BORESIGHT_FUZZ_STUDIES), "") << text;
    } catch (const InputError& error) {
      ADD_FAILURE() << error.what() << "\n" << text;
    }
  }
}
TEST(StudyFuzz, DamagedStudiesAreRefusedInOneLineOrHold) {
  Tally tally;
  run_studies(4000, fuzz_seed(), tally);
  if (std::getenv("BORESIGHT_FUZZ_SEED") != nullptr) return;  // one input is no crowd
  EXPECT_GT(tally.read, 40);
  EXPECT_GT(tally.refused, 1500);
}
TEST(DataFuzz, DamagedTablesAreRefusedInOneLineOrHold) {
  Tally tally;
  run_tables(2000, fuzz_seed(), tally);
  if (std::getenv("BORESIGHT_FUZZ_SEED") != nullptr) return;
  EXPECT_GT(tally.read, 100);
  EXPECT_GT(tally.refused, 300);
}

// Run by `ctest -L long`.
TEST(LongStudyFuzz, DamagedStudiesAreRefusedInOneLineOrHold) {
  Tally tally;
  run_studies(5000 * fuzz_times(), fuzz_seed() + 100'000, tally);
}
TEST(LongDataFuzz, DamagedTablesAreRefusedInOneLineOrHold) {
  Tally tally;
  run_tables(2500 * fuzz_times(), fuzz_seed() + 200'000, tally);
}

}  // namespace
}  // namespace boresight
