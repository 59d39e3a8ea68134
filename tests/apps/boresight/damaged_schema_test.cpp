// The schemas against the readers, fault by fault: every file of the corpus is damaged at each of its places in turn.
//
// What the reader takes the schema takes. The other way it holds for what is wrong whatever else the file says: a type, an unknown key. What hangs
// on other values, on the unit's dimension or on files beside this one is the reader's alone.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <utility>

#include "boresight/mechanism/error.hpp"
#include "damaged_files.hpp"
#include "file_corpus.hpp"
#include "schema_verdict.hpp"

namespace boresight::app {
namespace damaged_schema_test {

namespace fs = std::filesystem;

// What the corpus holds, where damaged files can stand beside those that they name.
class Copies {
 public:
  Copies() : root_(fs::temp_directory_path() / ("damaged-" + std::to_string(::getpid()))) {
    int deep = 0;
    for (const char* folder : {BORESIGHT_EXAMPLES, BORESIGHT_TEMPLATES, BORESIGHT_EVERY_KEY}) {
      const fs::path to = deep == 0 ? root_ / "examples" : root_ / "a/b/c" / std::to_string(deep);
      ++deep;
      for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (const fs::path& from = entry.path(); from.extension() == ".toml" || from.extension() == ".csv") {
          const fs::path copy = to / fs::relative(from, folder);
          fs::create_directories(copy.parent_path());
          fs::copy_file(from, copy);
          if (from.extension() == ".toml") files_.emplace_back(from, copy);
        }
    }
  }
  ~Copies() { fs::remove_all(root_); }

  fs::path beside(const fs::path& original) const {
    for (const auto& [from, copy] : files_)
      if (from == original) return copy.parent_path() / "damaged.toml";
    throw std::out_of_range(original.string());
  }

 private:
  fs::path root_;
  std::vector<std::pair<fs::path, fs::path>> files_;
};

// "" where the reader takes the file.
std::string fault_of_reader(const fs::path& file, const std::string& kind) {
  try {
    read_whole(file, kind);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

// one_in: of the damaged files, every so many-th; reading the paper's mechanism for each study takes its time.
void expect_one_verdict(const std::string& kind, std::size_t one_in) {
  const Copies copies;
  const SchemaVerdict schema(kind);
  std::set<std::pair<std::string, std::string>> seen;
  std::vector<CorpusFile> files = file_corpus();
  // Examples come last, with what only they hold: their mechanisms take longer to read.
  const auto is_example = [](const CorpusFile& file) { return file.path.string().starts_with(BORESIGHT_EXAMPLES); };
  std::stable_partition(files.begin(), files.end(), std::not_fn(is_example));
  for (const CorpusFile& file : files) {
    if (file.kind != kind) continue;
    const fs::path damaged = copies.beside(file.path);
    for_each_damage(Document::from_file(file.path).root(), [&](const Damage& damage, const Node& root) {
      if (!seen.emplace(damage.at, damage.what).second || seen.size() % one_in != 0) return;
      std::ofstream(damaged) << toml_of(root);
      std::string by_reader;
      const std::string by_schema = schema.fault_of(json_of(root));
      ASSERT_NO_THROW(by_reader = fault_of_reader(damaged, kind))
          << file.path << ": " << damage.at << ", " << damage.what;
      const std::string here = file.path.string() + ": " + damage.at + ", " + damage.what + "; " + by_reader;
      if (by_reader.empty()) {
        EXPECT_EQ(by_schema, "") << here;
      } else if (damage.by_itself) {
        EXPECT_NE(by_schema, "") << here;
      }
    });
  }
  EXPECT_GT(seen.size(), 1000u);
}

TEST(Schemas, JudgeDamagedStudiesAsTheirReadersDo) { expect_one_verdict("study", 11); }

TEST(Schemas, JudgeDamagedMechanismsAsTheirReaderDoes) { expect_one_verdict("mechanism", 3); }

TEST(SchemasNight, JudgeEveryDamagedStudyAsItsReaderDoes) { expect_one_verdict("study", 1); }

TEST(SchemasNight, JudgeEveryDamagedMechanismAsItsReaderDoes) { expect_one_verdict("mechanism", 1); }

}  // namespace damaged_schema_test
}  // namespace boresight::app
