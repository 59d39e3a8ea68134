#include "boresight_analyses/study/study.hpp"

#include <gmock/gmock.h>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/study/rung_choice.hpp"

namespace boresight {
namespace {

using testing::HasSubstr;

Study study_of(const std::string& text, const std::string& file = "folder/study.toml") {
  Document document = Document::from_text(text, file);
  Cursor root(document);
  return read_study(root, document.content_hash());
}

std::string fault_of(const std::string& text) {
  try {
    study_of(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no fault";
}

TEST(Study, TakesTheMechanismFromTheFolderOfTheStudy) {
  EXPECT_EQ(study_of("format = 1\nmechanism = \"../a/b.toml\"\n").mechanism_file, "a/b.toml");
  EXPECT_EQ(study_of("format = 1\nmechanism = \"/abs/b.toml\"\n").mechanism_file, "/abs/b.toml");
  EXPECT_EQ(study_of("format = 1\nmechanism = \"b.toml\"\n", "study.toml").mechanism_file, "b.toml");
}

TEST(Study, ReadsAccuracyAndIndex) {
  const Study study = study_of(
      "format = 1\nmechanism = \"m.toml\"\naccuracy = \"2 %\"\n[index]\nquantity = "
      "\"boresight_error\"\nstatistic = \"p99.73\"\n");
  EXPECT_DOUBLE_EQ(*study.accuracy, 0.02);
  EXPECT_EQ(study.index.quantity, "boresight_error");
  EXPECT_EQ(study.index.si_unit(), "rad");
  PointingIndices indices;
  indices.boresight_error.p9973 = 3.0;
  EXPECT_EQ(study.index.of(indices), 3.0);
}

TEST(Study, LeavesTheTablesOfOtherVerbsAlone) {
  EXPECT_NO_THROW(study_of(
      "format = 1\nmechanism = \"m.toml\"\n[montecarlo]\nsamples = 10\n[[random]]\nparameter = \"x\"\n"));
}

TEST(Study, NamesLineKeyAndNearestName) {
  EXPECT_THAT(fault_of("format = 1\nmechanism = \"m.toml\"\n[index]\nquantity = \"position_eror\"\n"),
              testing::AllOf(HasSubstr("folder/study.toml:4: index.quantity"),
                             HasSubstr("did you mean position_error?")));
  EXPECT_THAT(fault_of("format = 1\nmechanism = \"m.toml\"\nacuracy = \"1 %\"\n"),
              HasSubstr("did you mean accuracy?"));
  EXPECT_THAT(fault_of("format = 1\nmechanism = \"m.toml\"\naccuracy = \"-1 %\"\n"),
              HasSubstr("accuracy: found"));
  EXPECT_THAT(fault_of("format = 2\nmechanism = \"m.toml\"\n"), HasSubstr("format: found"));
}

TEST(Study, TellsAMechanismFileFromAStudy) {
  EXPECT_THAT(fault_of("format = 1\nname = \"x\"\n[[body]]\nname = \"b\"\n"),
              HasSubstr("found a mechanism file, expected a study file"));
}

TEST(RungChoice, RefusesANameWithTheNearestOne) {
  try {
    check_rung_name("multybody");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.nearest, "multibody");
  }
}

}  // namespace
}  // namespace boresight
