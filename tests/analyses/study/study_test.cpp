#include "boresight_analyses/study/study.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "boresight/mechanism/error.hpp"
#include "boresight/rungs/rung.hpp"
#include "boresight_analyses/study/rung_choice.hpp"

namespace boresight {
namespace study_test {

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
  EXPECT_NO_THROW(
      study_of("format = 1\nmechanism = \"m.toml\"\n[montecarlo]\nsamples = 10\n[[random]]\nparameter = \"x\"\n"));
}

TEST(Study, NamesLineKeyAndNearestName) {
  EXPECT_THAT(
      fault_of("format = 1\nmechanism = \"m.toml\"\n[index]\nquantity = \"position_eror\"\n"),
      testing::AllOf(HasSubstr("folder/study.toml:4: index.quantity"), HasSubstr("did you mean position_error?")));
  EXPECT_THAT(fault_of("format = 1\nmechanism = \"m.toml\"\nacuracy = \"1 %\"\n"), HasSubstr("did you mean accuracy?"));
  EXPECT_THAT(fault_of("format = 1\nmechanism = \"m.toml\"\naccuracy = \"-1 %\"\n"), HasSubstr("accuracy: found"));
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

TEST(Study, AStartBelongsToTheIndexAndToWhatTheStudyIs) {
  const std::string head = "format = 1\nmechanism = \"m.toml\"\n[index]\nquantity = \"boresight_error\"\n";
  const Study whole = study_of(head), late = study_of(head + "start = \"50 ms\"\n");
  EXPECT_EQ(whole.index.start, 0.0);
  EXPECT_DOUBLE_EQ(late.index.start, 0.05);
  EXPECT_EQ(whole.index.text(), "boresight_error.max");
  EXPECT_NE(late.index.text(), whole.index.text());
  EXPECT_EQ(late.index.title(), "boresight error, maximum from 0.05 s on");
  EXPECT_THAT(fault_of(head + "start = \"-1 ms\"\n"), HasSubstr("folder/study.toml:5: index.start"));
  EXPECT_THAT(fault_of(head + "start = \"1 mm\"\n"), HasSubstr("expected a time"));
}

TEST(Study, AnIndexThatTheMotionDoesNotHaveIsRefusedWithItsLine) {
  MechanismDescription d;
  d.bodies = {{.name = "arm", .mass = 1.0, .boresight = Vec3(0, 0, 1), .origin = {}}};
  d.motion.duration = 0.5;
  d.origin.file = "m.toml";
  const auto fault = [&](const std::string& index) {
    try {
      check_index(study_of("format = 1\nmechanism = \"m.toml\"\n[index]\n" + index), Mechanism(d));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("no fault");
  };
  EXPECT_THAT(
      fault("quantity = \"line_of_sight_error\"\n"),
      testing::AllOf(HasSubstr("folder/study.toml:4: index.quantity"), HasSubstr("[pointing]"), HasSubstr("m.toml")));
  EXPECT_THAT(fault("start = \"0.5 s\"\n"), HasSubstr("folder/study.toml:4: index.start: found 0.5 s"));
  EXPECT_EQ(fault("start = \"0.4 s\"\n"), "no fault");
  d.line_of_sight = LineOfSightDescription{.from = Vec3::Zero(), .target = Vec3(0, 0, 1), .origin = {}};
  EXPECT_EQ(fault("quantity = \"line_of_sight_error\"\n"), "no fault");
}

TEST(Study, ALineOfSightThatIsNotThereIsNoNumber) {
  const IndexChoice index{"line_of_sight_error", "max"};
  PointingIndices indices;
  EXPECT_TRUE(std::isnan(index.of(indices)));
  indices.has_line_of_sight = true;
  EXPECT_EQ(index.of(indices), 0.0);
}

}  // namespace study_test
}  // namespace boresight
