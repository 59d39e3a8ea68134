// The reference and the readers cannot drift apart: a reader asks its table of keys (tests/lib/io/key_test.cpp), and here every key
// of every table is read from a file.
#include <gmock/gmock.h>

#include <set>

#include "file_corpus.hpp"
#include "reference/key_help.hpp"
#include "reference/reference_page.hpp"
#include "reference/sections.hpp"

namespace boresight::app {
namespace reference_test {

using testing::HasSubstr;
using testing::IsEmpty;

using Names = std::set<std::string>;

// Names of keys, "clearance.contact: law", that a file has.
void add_keys(const Node& node, const KeyTable& table, Names& found) {
  for (const auto& [name, member] : node.members) {
    const Key* key = table.find(name);
    if (key == nullptr) continue;
    found.insert(table.name + ": " + key->name);
    const KeyTable* inside = table_inside(*key);
    if (inside == nullptr) continue;
    if (member.kind == Node::Kind::table) add_keys(member, *inside, found);
    for (const Node& item : member.items) add_keys(item, *inside, found);
  }
}

const KeyTable& table_of(const std::string& kind) {
  for (const Section& section : sections())
    if (section.file == kind && section.path().empty()) return *section.keys;
  throw std::out_of_range(kind);
}

Names all_keys() {
  Names all;
  for (const Section& section : sections())
    for (const Key& key : section.keys->keys) all.insert(section.keys->name + ": " + key.name);
  return all;
}

TEST(Reference, HasNoKeyThatNoReaderTakes) {
  Names found;
  for (const CorpusFile& file : file_corpus()) {
    ASSERT_NO_THROW(read_whole(file.path, file.kind)) << file.path;  // what is given and never read is refused
    add_keys(Document::from_file(file.path).root(), table_of(file.kind), found);
  }
  Names missing;
  for (const std::string& key : all_keys())
    if (!found.contains(key)) missing.insert(key);
  EXPECT_THAT(missing, testing::ElementsAre("study: chart"));  // taken, and nothing is read from it
}

TEST(Reference, SaysASentenceOfEveryTableAndKey) {
  for (const Section& section : sections()) {
    EXPECT_TRUE(section.keys->says.ends_with('.')) << section.heading();
    for (const Key& key : section.keys->keys) EXPECT_TRUE(key.sentence.ends_with('.')) << section.path_of(key);
  }
}

TEST(Reference, NamesEveryTableOnceInAFile) {
  Names names;
  for (const Section& section : sections())
    EXPECT_TRUE(names.insert(section.file + " " + section.keys->name).second) << section.keys->name;
}

TEST(Reference, HelpKnowsEveryKeyByItsNameAndItsPath) {
  for (const Section& section : sections())
    for (const Key& key : section.keys->keys) {
      EXPECT_THAT(key_help(key.name), HasSubstr(key.name));
      EXPECT_THAT(key_help(section.path_of(key)), HasSubstr(key.name));
    }
  EXPECT_EQ(key_help("no_such_key"), "");
  EXPECT_EQ(key_help("clearance.F1.contact.restitution"), key_help("clearance.contact.restitution"));
}

TEST(Reference, ThePageHasEveryKey) {
  const std::string page = reference_page({{"run", "Usage: boresight run <FILE>"}});
  for (const Section& section : sections())
    for (const Key& key : section.keys->keys) {
      const std::string path = section.path().empty() ? "" : "-" + section.path();
      EXPECT_THAT(page, HasSubstr("id=\"file-" + section.file + path + "." + key.name + "\""));
    }
  EXPECT_THAT(page, HasSubstr("boresight run &lt;FILE&gt;"));
}

}  // namespace reference_test
}  // namespace boresight::app
