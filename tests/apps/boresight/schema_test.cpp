// The JSON schemas accept every file that the program accepts, and refuse what an editor should underline.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/io/toml_tree.hpp"
#include "boresight/mechanism/error.hpp"
#include "file_corpus.hpp"
#include "reference/sections.hpp"
#include "schema_verdict.hpp"

namespace boresight::app {
namespace schema_test {

TEST(Schemas, AcceptEveryFileThatTheProgramTakes) {
  const SchemaVerdict mechanism("mechanism"), study("study");
  int seen = 0;
  for (const CorpusFile& file : file_corpus()) {
    if (file.kind == "posterior") continue;
    const nlohmann::json json = json_of(Document::from_file(file.path).root());
    EXPECT_EQ((file.kind == "mechanism" ? mechanism : study).fault_of(json), "") << file.path;
    ++seen;
  }
  EXPECT_GT(seen, 30);
}

struct Change {
  const char* what;
  const char* with;
};

// The text with the damage is refused by the reader and by the schema, the text without it by none.
template <typename Read>
void expect_both_refuse(const std::filesystem::path& file, const std::string& kind, const std::vector<Change>& damages,
                        const Read& read) {
  const SchemaVerdict schema(kind);
  std::string good;
  {
    std::ifstream in(file);
    good.assign(std::istreambuf_iterator<char>(in), {});
  }
  ASSERT_EQ(schema.fault_of(json_of(parse_toml(good, "f.toml"))), "");
  ASSERT_NO_THROW(read(good));
  for (const Change& damage : damages) {
    std::string text = good;
    const std::size_t at = text.find(damage.what);
    ASSERT_NE(at, std::string::npos) << damage.what;
    text.replace(at, std::string(damage.what).size(), damage.with);
    EXPECT_THROW(read(text), InputError) << damage.with;
    EXPECT_NE(schema.fault_of(json_of(parse_toml(text, "f.toml"))), "") << damage.with;
  }
}

TEST(Schemas, RefuseDamagedMechanisms) {
  expect_both_refuse(BORESIGHT_TEMPLATES "/mechanism.toml", "mechanism",
                     {{"mass = \"0.2 kg\"", "mass = 0.2"},  // without its unit
                      {"mass = \"0.2 kg\"", "mass = \"0.2\""},
                      {"mass = \"0.2 kg\"", "mas = \"0.2 kg\""},  // an unknown key
                      {"mass = \"0.2 kg\"\n", ""},                // a missing key
                      {"[motion]\nduration = \"1 s\"\n", "[motion]\n"},
                      {"type = \"revolute\"", "type = \"revolut\""},  // a wrong choice
                      {"type = \"revolute\"", "type = 1"},
                      {"law = \"flores\"", "law = \"florez\""},
                      {"law = \"modified-coulomb\"", "law = \"coulomb\""},
                      {"restitution = 0.85", "restitution = \"0.85\""},  // a wrong type
                      {"restitution = 0.85", "restitution = 1.5"},       // out of range
                      {"coefficient = 0.05", "coeficient = 0.05"},
                      {"poisson = [0.3, 0.33]", "poisson = [0.3]"},  // too few
                      {"axis = [0, 1, 0]", "axis = [0, 1]"},
                      {"inertia = [\"0.08 kg m^2\", ", "inertia = [\"0.08 kg m^2\", \"0.1 kg m^2\", "},  // three or six
                      {"connects = [\"ground\", \"crank\"]", "connects = [\"ground\"]"},
                      {"driven = true", "driven = \"yes\""},
                      {"format = 1", "format = 2"},
                      {"[motion]", "[[motion]]"},  // tables where one is expected
                      {"[payload]", "[payloads]"}},
                     [](const std::string& text) { read_mechanism_text(text, "f.toml"); });
}

TEST(Schemas, RefuseDamagedStudies) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("schema-" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  std::filesystem::copy_file(BORESIGHT_TEMPLATES "/mechanism.toml", folder / "mechanism.toml");
  const auto read = [&](const std::string& text) {
    std::ofstream(folder / "study.toml") << text;
    read_whole(folder / "study.toml", "study");
  };
  expect_both_refuse(BORESIGHT_TEMPLATES "/montecarlo.toml", "study",
                     {{"accuracy = \"2 %\"", "accuracy = 0.02"},
                      {"mechanism = \"mechanism.toml\"", "mechanism = 1"},
                      {"quantity = \"boresight_error\"", "quantity = \"boresight\""},
                      {"statistic = \"max\"", "statistics = \"max\""},
                      {"samples = 1000", "samples = 1000.5"},
                      {"samples = 1000", "samples = \"1000\""},
                      {"samples = 1000", "samples = 0"},
                      {"seed = 1", "seed = -1"},
                      {"{ uniform = { min = 0.7, max = 0.95 } }", "{ uniform = { min = 0.7 } }"},
                      {"{ uniform = { min = 0.7, max = 0.95 } }", "{ uniforms = { min = 0.7, max = 0.95 } }"},
                      {"{ uniform = { min = 0.7, max = 0.95 } }", "{}"},
                      {"{ uniform = { min = 0.7, max = 0.95 } }", "{ zone = \"normal\" }"},
                      {"{ uniform = { min = 0.7, max = 0.95 } }",
                       "{ uniform = { min = 0.7, max = 0.95 }, normal = { mean = 0.8, sd = 0.1 } }"},
                      {"accuracy = \"2 %\"", "accuracy = \"2 deg\""},
                      {"accuracy = \"2 %\"", "accuracy = \"2000 %\""},
                      {"probability = 0.95", "probability = 1.5"},
                      {"[montecarlo]", "[monte_carlo]"}},
                     read);
  std::filesystem::remove_all(folder);
}

// A table of which one key stands in it, or at least some, says so to editors too; and the keys that it names are its own.
TEST(Schemas, KnowTheTablesThatMayNotBeEmpty) {
  const nlohmann::json study = nlohmann::json::parse(json_schema("study").dump());
  int seen = 0;
  for (const Section& section : sections()) {
    if (section.file != "study" || section.path().empty()) continue;
    const nlohmann::json& schema = study["definitions"][section.keys->name];
    for (const std::string& name : section.keys->one_of) EXPECT_NE(section.keys->find(name), nullptr) << name;
    if (!section.keys->one_of.empty()) {
      EXPECT_EQ(schema["oneOf"].size(), section.keys->one_of.size()) << section.path();
      EXPECT_FALSE(section.keys->one_of_what.empty()) << section.path();
      ++seen;
    }
    if (section.keys->fewest > 0) {
      EXPECT_EQ(schema["minProperties"], section.keys->fewest) << section.path();
      EXPECT_FALSE(section.keys->fewest_expected.empty()) << section.path();
      ++seen;
    }
  }
  EXPECT_GE(seen, 3);  // distribution, through, columns
  EXPECT_EQ(study["properties"]["random"]["minItems"], 1);
}

}  // namespace schema_test
}  // namespace boresight::app
