// Parameters that are drawn together as the rows of a table.
#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "boresight/io/mechanism_file.hpp"
#include "boresight/mechanism/error.hpp"
#include "boresight_analyses/random/parameter_groups.hpp"
#include "boresight_analyses/random/random_inputs.hpp"
#include "boresight_analyses/random/random_keys.hpp"
#include "boresight_analyses/random/read_distribution.hpp"
#include "boresight_analyses/random/sample_rows.hpp"
#include "boresight_analyses/random/sampling_design.hpp"

namespace boresight {
namespace rows_inputs_test {

using testing::HasSubstr;

const std::string kTwo = "parameters = [\"clearance.F1.radial\", \"clearance.F1.friction.coefficient\"]\n";

const KeyTable& table_with_groups() {
  static const KeyTable keys{.name = "grouped",
                             .says = "A table with groups.",
                             .keys = {keys::table("groups", groups_keys).sometimes("").says("Groups.")}};
  return keys;
}

class RowsInputs : public testing::Test {
 protected:
  void SetUp() override {
    // Two modes, each with a dependence of its own, and ties.
    std::ofstream(file_)
        << "chain,clearance.F1.radial,clearance.F1.friction.coefficient,gap [um]\n"
           "1,1e-4,0.02,100\n1,1.1e-4,0.03,110\n2,2e-4,0.06,200\n2,2.1e-4,0.05,210\n2,2.1e-4,0.05,210\n";
  }
  void TearDown() override { std::filesystem::remove(file_); }
  Document document(const std::string& text) const {
    return Document::from_text(text, (std::filesystem::path(testing::TempDir()) / "study.toml").string());
  }
  RandomInputs read(const std::string& text) const {
    Document study = document(text);
    Cursor root(study);
    return read_random_inputs(root, mechanism_->description(), [](const Setting&) {});
  }
  std::string fault(const std::string& text) const {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "none";
  }
  std::string random(const std::string& inside) const {
    return "[[random]]\n" + kTwo + "distribution = { rows = { file = \"" + name_ + "\"" + inside + " } }\n";
  }

  const std::string name_ = testing::UnitTest::GetInstance()->current_test_info()->name() + std::string("_rows.csv");
  const std::string file_ = testing::TempDir() + name_;
  const std::shared_ptr<const Mechanism> mechanism_ =
      std::make_shared<const Mechanism>(read_mechanism(BORESIGHT_EXAMPLES "/3-rrcpr/3-rrcpr.toml"));
};

TEST_F(RowsInputs, TakeTheirValuesFromOneRowEachAsOftenAsAnyOther) {
  const RandomInputs inputs = read(random(""));
  ASSERT_EQ(inputs.size(), 2u);
  const std::map<double, double> rows = {{1e-4, 0.02}, {1.1e-4, 0.03}, {2e-4, 0.06}, {2.1e-4, 0.05}};
  for (const SamplingKind kind : {SamplingKind::random, SamplingKind::lhs, SamplingKind::sobol}) {
    const SamplingDesign design({.kind = kind, .seed = 4, .replicates = 4}, 2);
    std::map<double, int> count;
    constexpr int kDraws = 4000;
    for (int k = 0; k < kDraws; ++k) {
      std::vector<double> point(2);
      design.point(static_cast<std::uint64_t>(k), point);
      inputs.values(point);
      ASSERT_EQ(rows.at(point[0]), point[1]);
      ++count[point[0]];
    }
    // 800 of each row, with a standard deviation of 25 where draws are independent.
    EXPECT_NEAR(count[1e-4], kDraws / 5, 100);
    EXPECT_NEAR(count[2.1e-4], 2 * kDraws / 5, 125);
  }
}

TEST_F(RowsInputs, MayStandBesideOthers) {
  const RandomInputs inputs = read(
      "[[random]]\nparameter = \"payload.mass\"\ndistribution = { uniform = { min = \"1 kg\", max = "
      "\"2 kg\" } }\n" +
      random("") +
      "[[random]]\nparameter = \"gravity.x\"\ndistribution = { uniform = { min = \"1 m/s^2\", "
      "max = \"2 m/s^2\" } }\n");
  std::vector<double> point = {0.25, 0.01, 0.9, 0.75};
  inputs.values(point);
  EXPECT_THAT(point, testing::ElementsAre(1.25, 1e-4, 0.02, 1.75));
  EXPECT_THAT(inputs.text, HasSubstr("rows(5 of 2, "));
}

TEST_F(RowsInputs, MayNameOtherColumnsAndUnits) {
  const RandomInputs inputs =
      read(random(", columns = [\"gap [um]\", \"clearance.F1.friction.coefficient\"], units = [\"um\", \"1\"]"));
  std::vector<double> point = {0.01, 0.5};
  inputs.values(point);
  EXPECT_NEAR(point[0], 1e-4, 1e-18);
  EXPECT_EQ(point[1], 0.02);
}

TEST_F(RowsInputs, AreOneGroup) {
  const RandomInputs inputs = read(random(""));
  Document study = document("[grouped]\n");
  Cursor root(study);
  Cursor grouped = root.table("grouped");
  grouped.only(table_with_groups());
  const NamedGroups groups = read_parameter_groups(grouped, inputs);
  EXPECT_THAT(groups.members, testing::ElementsAre(testing::ElementsAre(0, 1)));
}

TEST_F(RowsInputs, OfAnotherTableAreAnotherStudy) {
  const std::string before = read(random("")).text;
  std::ofstream(file_, std::ios::app) << "2,2.2e-4,0.05,210\n";
  EXPECT_NE(read(random("")).text, before);
}

TEST_F(RowsInputs, AreRefusedWhereTheyDoNotFit) {
  EXPECT_THAT(fault("[[random]]\n" + kTwo + "distribution = { rows = { file = \"none.csv\" } }\n"),
              HasSubstr("none.csv"));
  EXPECT_THAT(fault(random(", columns = [\"gap [um]\"]")), HasSubstr("2 of them"));
  EXPECT_THAT(fault(random(", columns = [\"gap\", \"chain\"]")), HasSubstr("\"gap\""));
  EXPECT_THAT(fault(random(", units = [\"kg\", \"1\"]")), HasSubstr("units"));
  Document study = document("distribution = { rows = { file = \"" + name_ + "\" } }\n");
  Cursor root(study);
  Cursor alone = root.table("distribution");
  EXPECT_THROW(read_distribution(alone, kLength), InputError);  // of a budget's contributor, of a prior
  EXPECT_THAT(fault(random("") + "[[correlation]]\n" + kTwo + "coefficient = 0.5\n"), HasSubstr("a table's rows"));
}

}  // namespace rows_inputs_test
}  // namespace boresight
